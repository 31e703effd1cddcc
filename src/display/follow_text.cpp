#include "display/follow_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace whirl_twin {
namespace {

/// A value to the second digit of its deviation, "0.000289 +- 5.9e-05".
std::string withDeviation(double value, double deviation) {
  if (!(deviation > 0.0) || value == 0.0 || !std::isfinite(value) || !std::isfinite(deviation)) {
    return fmt::format("{:.4g}", value);
  }
  const double digits = std::log10(std::fabs(value)) - std::log10(deviation);
  const int shown = std::clamp(static_cast<int>(std::floor(digits)) + 2, 1, 8);
  return fmt::format("{:.{}g} +- {:.2g}", value, shown, deviation);
}

const char* troubleOf(std::uint8_t status) {
  switch (status) {
    case FollowState::SILENT:
      return "no samples";
    case FollowState::REFUSED:
      return "rejected";
    case FollowState::INVALID:
      return "invalid";
    default:
      return "";
  }
}

}  // namespace

std::vector<std::string> followLines(const FollowState& follow) {
  std::vector<std::string> lines;
  const std::size_t parameters = std::min({follow.parameter.size(), follow.parameter_unit.size(),
                                           follow.value.size(), follow.deviation.size()});
  for (std::size_t i = 0; i < parameters; ++i) {
    const std::string& unit = follow.parameter_unit[i];
    lines.push_back(fmt::format("{} {}{}{}", follow.parameter[i],
                                withDeviation(follow.value[i], follow.deviation[i]),
                                unit.empty() ? "" : " ", unit));
  }
  for (std::size_t i = 0; i < std::min(follow.channel.size(), follow.channel_status.size()); ++i) {
    if (follow.channel_status[i] != FollowState::USED) {
      lines.push_back(fmt::format("{} {}", follow.channel[i], troubleOf(follow.channel_status[i])));
    }
  }
  if (std::isfinite(follow.mismatch)) {
    lines.push_back(fmt::format("residual {:.2f} of that expected", std::sqrt(follow.mismatch)));
  }
  return lines;
}

}  // namespace whirl_twin
