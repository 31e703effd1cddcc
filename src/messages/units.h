// Units of measurement in the grammar of UDUNITS-2 ("mm/s", "N s/m", "lbf/in", "kg m^2"), with the
// prefixes of the SI.
//
// Angle is a separate dimension, with one turn = 2 pi rad: 3000 rpm and 50 Hz are 314.16 rad/s (Hz
// is a turn per second, also where a number is in rad/s), and a stiffness in N m/rad cannot be
// converted to N m.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

/// Conversion factor from `unit` to `wanted`; both may end in "/sqrt(Hz)", of a noise. 1 where no
/// unit is given: the values are already in `wanted`. 0: the unit has a different dimension, or is
/// unknown.
double unitScale(const std::string& unit, const std::string& wanted);

/// Is the unit known, of any dimension?
bool isUnit(const std::string& text);

struct QuantityUnits {
  const char* name;                ///< with its article: "a mass"
  const char* unit;                ///< in the SI
  std::vector<const char*> units;  ///< others; prefixes, products and quotients are known as well
};
const std::vector<QuantityUnits>& unitsByQuantity();

/// "a mass" for "lb"; "" for an unknown unit and for one of none of these quantities.
std::string quantityName(const std::string& unit);

/// The unit that was meant in place of one that cannot be converted or is unknown: "lbf/in" for
/// "lb/in" in N/m, "Hz" for "hz"; "" if none is known.
std::string unitMeant(const std::string& unit, const std::string& wanted);

}  // namespace whirl_twin
