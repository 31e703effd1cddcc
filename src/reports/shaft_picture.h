// A picture of a rotor's whole shaft where it is bent most in a run, exaggerated, with the orbits
// of the places that are published.
#pragma once

#include <optional>

#include "mechanics/dynamics.h"
#include "plots/sketch_picture.h"
#include "reports/plot_history.h"

namespace whirl_twin {

/// Nothing for what has no picture, not several places along a shaft, or no motion. The title is
/// left to be written.
std::optional<SketchPicture> shaftPicture(const Dynamics& dynamics, const PlotHistory& history);

}  // namespace whirl_twin
