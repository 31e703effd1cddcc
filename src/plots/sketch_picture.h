// A picture of a Sketch (mechanics/sketch.h), to scale, with a length to compare: plane ones from
// the front, spatial ones from slightly above and from the left.
#pragma once

#include <string>
#include <vector>

#include "mechanics/sketch.h"
#include "plots/canvas.h"

namespace whirl_twin {

struct SketchPicture {
  std::string title;
  Sketch sketch;
  std::vector<Sketch> ghosts;      ///< later positions, drawn faintly behind it
  std::vector<SketchPoint> trace;  ///< where the tracer has been; may be empty
};

/// The file. The picture is 800 px wide or, where it is upright, 620 px high. Throws
/// std::runtime_error.
std::string sketchImage(const SketchPicture& picture, ImageFormat format);

}  // namespace whirl_twin
