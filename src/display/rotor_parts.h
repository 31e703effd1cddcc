// Elements common to the pictures of all rotors: limits about an orbit, and the text on a whirl.
#pragma once

#include <string>
#include <vector>

#include "display/system_display.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

constexpr Color kOrbitColor{0.35F, 0.85F, 1.0F};

/// Circles of the limits about an orbit that is drawn `scale` times as large, in the plane z = 0 of
/// the canvas [m]; those larger than the picture are not drawn.
void drawLimits(const std::vector<VibrationLimit>& limits, const OrderState* orders, double scale,
                MarkerCanvas& canvas);

/// Speed, whirl, orders, margins, limits.
std::vector<std::string> whirlLines(const WhirlState& state, const SystemStatus& status);

/// "whirl x 500"
std::string exaggerationText(double scale);

}  // namespace whirl_twin
