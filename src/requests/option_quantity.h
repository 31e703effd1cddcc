// Physical numbers on the command line: "800 rpm", "5 mil", or a number in the SI unit of the
// option.
#pragma once

#include <limits>
#include <string>

namespace whirl_twin {

/// What the number of an option measures, with its range.
struct OptionQuantity {
  const char* what;  ///< "a shaft speed"
  const char* unit;  ///< of a number without one; "-" for a ratio
  double low;
  double high = std::numeric_limits<double>::infinity();
  bool above = false;  ///< low is excluded
};

inline constexpr double kMaxOptionSpeed = 1.0e6;  ///< [rad/s]
inline constexpr OptionQuantity kShaftSpeed{"a shaft speed", "rad/s", 0.0, kMaxOptionSpeed};
inline constexpr OptionQuantity kSignedShaftSpeed{"a shaft speed", "rad/s", -kMaxOptionSpeed,
                                                  kMaxOptionSpeed};
inline constexpr OptionQuantity kWhirlFrequency{"a frequency", "rad/s", 0.0, kMaxOptionSpeed};
inline constexpr OptionQuantity kListeningTime{"a time", "s", 0.0,
                                               std::numeric_limits<double>::infinity(), true};

/// "from 0 to 1e+06 rad/s", "> 0 W".
std::string rangeText(const OptionQuantity& quantity);

/// Throws InputError, "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '3 kg' (a
/// mass)".
double readQuantity(const std::string& option, const std::string& text,
                    const OptionQuantity& quantity);

/// " (a mass)", " (unknown unit 'rmp')" for a number with a unit that is none of `unit`, with the
/// one that was meant if it is known; else "".
std::string foundQuantity(const std::string& text, const std::string& unit);

}  // namespace whirl_twin
