// Units of measurement in the grammar of UDUNITS-2 ("mm/s", "N s/m", "lbf/in", "kg m^2"), with the
// prefixes of the SI.
//
// Angle is a separate dimension, with one turn = 2 pi rad: 3000 rpm and 50 Hz are 314.16 rad/s, and
// a stiffness in N m/rad cannot be converted to N m.
#pragma once

#include <string>

namespace whirl_twin {

/// Conversion factor from `unit` to `wanted`. 1 where no unit is given: the values are already in
/// `wanted`. 0: the unit has a different dimension, or is unknown.
double unitScale(const std::string& unit, const std::string& wanted);

/// Is the unit known, of any dimension?
bool isUnit(const std::string& text);

}  // namespace whirl_twin
