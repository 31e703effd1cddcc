// Units of measured values: what a sensor may say, and what that is in the unit that is wanted.
#pragma once

#include <string>

namespace whirl_twin {

/// What values in a unit are to be multiplied by to be in the wanted one: of lengths m, mm, um, of
/// angles rad, mrad, deg, of forces N, kN, of torques N m, mN m, and of their rates (mm/s). 1 where
/// no unit is said: values are as wanted. 0: the unit is of another kind, or not known.
double unitScale(const std::string& unit, const std::string& wanted);

}  // namespace whirl_twin
