// A sketch as JSON, for figures and for the page of the web server.
#pragma once

#include "mechanics/sketch.h"
#include "reports/output.h"

namespace whirl_twin {

/// The members of the sketch under their names, points as [x, y, z], roles by their names; what is
/// not finite is null.
Json sketchJson(const Sketch& sketch);

}  // namespace whirl_twin
