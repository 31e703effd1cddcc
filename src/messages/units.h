// Units, as they are written: by the grammar of UDUNITS-2 ("mm/s", "N s/m", "lbf/in", "kg m^2"),
// with the prefixes of the SI.
//
// Angles are a kind of their own, and a turn is 2 pi of them: 3000 rpm and 50 Hz are 314.16 rad/s,
// and a stiffness in N m/rad is none in N m.
#pragma once

#include <string>

namespace whirl_twin {

/// What values in a unit are to be multiplied by to be in the wanted one. 1 where no unit is said:
/// values are as wanted. 0: the unit is of another kind, or not known.
double unitScale(const std::string& unit, const std::string& wanted);

/// A unit that is known, of whatever kind.
bool isUnit(const std::string& text);

}  // namespace whirl_twin
