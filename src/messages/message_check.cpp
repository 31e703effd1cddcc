#include "messages/message_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {
namespace {

constexpr std::size_t kMaxTextLength = 1000;
/// Simulated times beyond this [s] have no microseconds in 64 bits.
constexpr double kMaxTime = 9.0e12;

}  // namespace

std::int64_t utimeOf(double time) {
  return std::abs(time) <= kMaxTime ? std::llround(time * 1e6) : 0;
}

void requireName(const char* field, const std::string& name) {
  if (!isLegalName(name)) {
    throw RejectedMessage(fmt::format(
        "{}: expected a letter and then letters, digits or _, at most {} of them, found {}", field,
        kMaxNameLength, inQuotes(name)));
  }
}

void requirePath(const char* field, const std::string& path) {
  const std::size_t end = std::min(path.find_first_of("[."), path.size());
  if (!isLegalName(path.substr(0, end)) || path.size() > 2 * kMaxNameLength ||
      !std::all_of(path.begin(), path.end(),
                   [](char c) { return isNameCharacter(c) || c == '[' || c == ']' || c == '.'; })) {
    throw RejectedMessage(
        fmt::format("{}: expected the path of a parameter such as discs[1].mass, found {}", field,
                    inQuotes(path)));
  }
}

void requireText(const char* field, const std::string& text) {
  if (text.size() > kMaxTextLength) {
    throw RejectedMessage(fmt::format("{}: expected at most {} bytes of text, found {}", field,
                                      kMaxTextLength, text.size()));
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = printableLength(text, at);
    if (length == 0) {
      throw RejectedMessage(fmt::format("{}: expected UTF-8 text, found the byte {:#04x}", field,
                                        static_cast<unsigned char>(text[at])));
    }
    at += length;
  }
}

void requireDirection(const char* field, const std::string& direction) {
  if (direction != "forward" && direction != "backward") {
    throw RejectedMessage(
        fmt::format("{}: expected forward or backward, found {}", field, inQuotes(direction)));
  }
}

void requireCoordinateUnit(const char* field, const std::string& unit) {
  if (unit != "m" && unit != "rad") {
    throw RejectedMessage(fmt::format("{}: expected m or rad, found {}", field, inQuotes(unit)));
  }
}

void requireFlag(const char* field, int flag) {
  requireRange(field, flag, 0, 1);
}

void requireRange(const char* field, std::int64_t value, std::int64_t low, std::int64_t high) {
  if (value < low || value > high) {
    throw RejectedMessage(fmt::format("{}: expected {} to {}, found {}", field, low, high, value));
  }
}

void requireStep(std::int64_t step) {
  if (step < 0) {
    throw RejectedMessage(fmt::format("step: expected at least 0, found {}", step));
  }
}

void requireTime(const char* field, double time) {
  if (!(std::abs(time) <= kMaxTime)) {
    throw RejectedMessage(fmt::format("{}: expected a finite number of s, found {}", field, time));
  }
}

void requireStamp(std::int64_t stamp) {
  requireRange("stamp [ns]", stamp, 0, kMaxStamp);
}

void requireLength(const char* field, std::size_t length, std::int64_t expected) {
  if (expected < 0 || length != static_cast<std::size_t>(expected)) {
    throw RejectedMessage(
        fmt::format("{}: expected {} entries, found {}", field, expected, length));
  }
}

}  // namespace whirl_twin
