// The elements of a sketch, drawn from the rearmost to the foremost.
#pragma once

#include "mechanics/sketch.h"
#include "plots/canvas.h"
#include "plots/sketch_view.h"

namespace whirl_twin {

/// `pale`: share of white in every colour.
void drawParts(const Sketch& sketch, const SketchView& view, double pale, Canvas& canvas);

}  // namespace whirl_twin
