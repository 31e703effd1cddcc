// A picture of a system at the start of a run, with some later positions and the path of a point;
// of a rotor with places along its shaft where it is bent most (shaft_picture.h).
#pragma once

#include <optional>
#include <string>

#include "mechanics/dynamics.h"
#include "plots/sketch_picture.h"
#include "reports/plot_history.h"

namespace whirl_twin {

/// Nothing for a model that has no sketch.
std::optional<SketchPicture> motionPicture(const std::string& title, const Dynamics& dynamics,
                                           const PlotHistory& history);

}  // namespace whirl_twin
