// Validity checks of a received message before the twin uses it: valid names, numbers in range,
// arrays of equal length. A message that fails is rejected as a whole, with an error text. LCM and
// ROS messages pass the same checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

/// The latest stamp [ns] that fits into a ROS header: it has 32 bits of seconds.
inline constexpr std::int64_t kMaxStamp = 4294967295LL * 1000000000LL + 999999999LL;

/// A message that must not be used; what() gives the reason.
class RejectedMessage : public InputError {
 public:
  using InputError::InputError;
};

/// The 64-bit utime of LCM [us] for a simulated time [s].
std::int64_t utimeOf(double time);

// Each throws RejectedMessage unless its condition is true; `field` is the message's own name for
// it.
void requireName(const char* field, const std::string& name);
/// The path of a number among parameters: a name followed by `[row]`, `[column]` or `.name`, as in
/// discs[1].mass.
void requirePath(const char* field, const std::string& path);
/// UTF-8 without control characters, at most 1000 bytes.
void requireText(const char* field, const std::string& text);
/// "forward" or "backward".
void requireDirection(const char* field, const std::string& direction);
/// "m" or "rad".
void requireCoordinateUnit(const char* field, const std::string& unit);
void requireFlag(const char* field, int flag);
void requireRange(const char* field, std::int64_t value, std::int64_t low, std::int64_t high);
void requireLength(const char* field, std::size_t length, std::int64_t expected);
void requireStep(std::int64_t step);
/// Finite [s].
void requireTime(const char* field, double time);
/// 0 to kMaxStamp [ns].
void requireStamp(std::int64_t stamp);

}  // namespace whirl_twin
