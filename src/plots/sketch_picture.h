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
  std::vector<Sketch> ghosts;                         ///< later positions, drawn faintly behind it
  std::vector<SketchPoint> trace;                     ///< where the tracer has been; may be empty
  std::vector<std::vector<SketchPoint>> orbits = {};  ///< closed paths, drawn as the trace is
  std::string note = "";                              ///< at the foot
};

/// Whether a sheet can show it: all its parts are at places within 1e100 m, and it has an extent.
bool fitsASheet(const SketchPicture& picture);

/// The file. The picture is 800 px wide or, where it is upright, 620 px high. Throws
/// RunFailure.
std::string sketchImage(const SketchPicture& picture, ImageFormat format);

}  // namespace whirl_twin
