// A figure as the drawing part of the Python package has it: JSON text.
#pragma once

#include <string>

#include "plots/chart.h"

namespace whirl_twin {

std::string figureText(const Figure& figure);

}  // namespace whirl_twin
