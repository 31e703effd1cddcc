// A number with a unit as it is written: "800 rpm", 5e3, "250mm".
#pragma once

#include <optional>
#include <string>

namespace whirl_twin {

/// A number as it is written, and its unit, "" for none. Nothing if the text begins with no number.
struct WrittenQuantity {
  std::string number;
  double value = 0.0;
  std::string unit;
};
std::optional<WrittenQuantity> writtenQuantity(const std::string& text);

/// ": 'mm' cannot be converted to rad/s", ": unknown unit 'rmp'" for a number with such a unit,
/// with the unit that was meant if it is known; else "".
std::string unitDiagnostic(const std::string& text, const std::string& unit);

}  // namespace whirl_twin
