// A picture of a Sketch (mechanics/sketch.h), to scale, with a scale bar: plane ones from the
// front, spatial ones from slightly above and from the left.
#pragma once

#include <string>
#include <vector>

#include "mechanics/sketch.h"
#include "plots/canvas.h"

namespace whirl_twin {

struct SketchPicture {
  std::string title;
  Sketch sketch;
  std::vector<Sketch> ghosts;                         ///< later positions, drawn faintly behind it
  std::vector<SketchPoint> trace;                     ///< past path of the tracer; may be empty
  std::vector<std::vector<SketchPoint>> orbits = {};  ///< closed paths, drawn as the trace is
  std::string note = "";                              ///< at the foot
};

/// Can it be drawn? All its elements must be at positions within 1e100 m, and it must have an
/// extent.
bool fitsASheet(const SketchPicture& picture);

/// The contents of the file. The picture is 800 px wide or, in portrait format, 620 px high. Throws
/// RunFailure.
std::string sketchImage(const SketchPicture& picture, ImageFormat format);

}  // namespace whirl_twin
