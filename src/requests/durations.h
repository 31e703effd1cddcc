// Simulated times as typed, in seconds, and as whole nanoseconds.
#pragma once

#include <cstdint>
#include <string>

namespace whirl_twin {

inline constexpr std::int64_t kSecond = 1'000'000'000;  ///< [ns]

/// Parses seconds, or a number with a unit of time, and rounds to the nearest whole number of
/// `unit`s [ns]; result in nanoseconds, from `low` to `high` [ns]. Exact: without intermediate
/// binary fractions. A value that is not a whole number is reported on standard error with the
/// value used instead. `option` names it there. Throws InputError.
std::int64_t parseNanoseconds(const std::string& option, const std::string& text, std::int64_t low,
                              std::int64_t high, std::int64_t unit = 1);

/// Nanoseconds as seconds, for a message: "0.0005 s".
std::string inSeconds(std::int64_t nanoseconds);

}  // namespace whirl_twin
