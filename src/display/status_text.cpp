#include "display/status_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

/// A value rounded to the second digit of its standard deviation, "0.000289 +- 5.9e-05".
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

namespace {

bool isAngle(const std::string& coordinate) {
  for (const char* name : {"theta", "phi", "alpha", "beta", "spin"}) {
    if (coordinate.rfind(name, 0) == 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

double wrappedDegrees(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * M_PI) / kDegree;
  return wrapped <= -180.0 ? wrapped + 360.0 : wrapped;
}

std::string speedText(double speed) {
  return fmt::format("speed {:.2f} rad/s ({:.1f} rpm)", speed, speed / kRpm);
}

std::string vibrationText(double amplitude) {
  return std::isfinite(amplitude) ? fmt::format("vibration {:.1f} um 0-peak", amplitude * 1e6) : "";
}

std::string ordersText(const OrderState& orders) {
  // minimum offset of the orbit's centre, relative to the amplitude, to be mentioned
  constexpr double kAside = 0.2;
  std::vector<std::string> parts;
  double first = 0.0;
  if (orders.valid && !orders.order.empty()) {
    first = orders.forward_amplitude[0] + orders.backward_amplitude[0];
    parts.push_back(fmt::format("1X {:.1f} um", first * 1e6));
    // Below the resolution of the estimate the angle is undefined.
    if (orders.forward_amplitude[0] > 3.0 * orders.deviation[0]) {
      parts.push_back(fmt::format("lag {:.1f} deg", wrappedDegrees(orders.forward_lag[0])));
    }
  }
  parts.emplace_back(orders.forward ? "forward" : "backward");
  // Static deflection, by sag or bearing load: not vibration.
  const double aside = std::hypot(orders.mean_x, orders.mean_y);
  if (orders.valid && aside > kAside * first) {
    parts.push_back(fmt::format("mean {:.1f} um from the axis", aside * 1e6));
  }
  if (!orders.line_frequency.empty()) {
    const double line = orders.line_forward[0] + orders.line_backward[0];
    if (line > first) {
      parts.push_back(fmt::format("{:.1f} rad/s {:.1f} um", orders.line_frequency[0], line * 1e6));
    }
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<CoordinateInfo> coordinatesByName(const std::vector<std::string>& name) {
  std::vector<CoordinateInfo> coordinates;
  for (const std::string& n : name) {
    coordinates.push_back({n, isAngle(n) ? "rad" : "m"});
  }
  return coordinates;
}

std::string coordinateText(const std::vector<CoordinateInfo>& coordinates,
                           const std::vector<double>& value) {
  std::string text;
  for (std::size_t i = 0; i < std::min(coordinates.size(), value.size()); ++i) {
    const CoordinateInfo& c = coordinates[i];
    text += i == 0 ? "" : ", ";
    text += c.isAngle() ? fmt::format("{} {:.1f} deg", c.name, wrappedDegrees(value[i]))
                        : fmt::format("{} {:.4g} m", c.name, value[i]);
  }
  return text;
}

std::string energyText(const PendulumState& state) {
  return fmt::format("kinetic {:.3g} J, potential {:.3g} J", state.kinetic, state.potential);
}

int nearestCriticalSpeed(const StabilityMargin& margin) {
  int nearest = -1;
  double least = INFINITY;
  const double speed = std::isfinite(margin.speed) ? std::abs(margin.speed) : 0.0;
  for (std::size_t i = 0; i < margin.critical_speed.size(); ++i) {
    const double distance = std::abs(margin.critical_speed[i] - speed);
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

std::string criticalSpeedText(const StabilityMargin& margin, int index) {
  const auto i = static_cast<std::size_t>(index);
  if (index < 0 || i >= margin.critical_speed.size()) {
    return {};
  }
  return fmt::format("critical {:.1f} rad/s{}", margin.critical_speed[i],
                     i < margin.direction.size() ? " " + margin.direction[i] : "");
}

std::string separationText(const StabilityMargin& margin, int index) {
  const auto i = static_cast<std::size_t>(index);
  if (index < 0 || i >= margin.separation_margin.size() ||
      !std::isfinite(margin.separation_margin[i])) {
    return {};
  }
  std::string text = fmt::format("margin {:.1f} %", margin.separation_margin[i]);
  if (i < margin.required_separation_margin.size() &&
      std::isfinite(margin.required_separation_margin[i])) {
    text += fmt::format(" ({:.1f} % required)", margin.required_separation_margin[i]);
  }
  return text;
}

std::string verdictText(const StabilityMargin& margin) {
  std::string text = margin.verdict_name;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string decayText(const StabilityMargin& margin) {
  std::string text;
  if (std::isfinite(margin.decay_rate)) {
    text = margin.decay_rate < 0.0 ? fmt::format("growth rate {:.3g} 1/s", -margin.decay_rate)
                                   : fmt::format("decay rate {:.3g} 1/s", margin.decay_rate);
  }
  if (std::isfinite(margin.log_decrement)) {
    text += fmt::format("{}log decrement {:.3g}", text.empty() ? "" : ", ", margin.log_decrement);
  }
  return text;
}

std::vector<std::string> marginLines(const StabilityMargin& margin) {
  // Only critical speeds around the present speed: all of them would fill the picture.
  constexpr int kShown = 3;
  std::vector<std::string> lines;
  const int count = static_cast<int>(margin.critical_speed.size());
  const int first = std::clamp(nearestCriticalSpeed(margin) - 1, 0, std::max(0, count - kShown));
  for (int i = first; i < std::min(count, first + kShown); ++i) {
    lines.push_back(criticalSpeedText(margin, i));
    if (const std::string separation = separationText(margin, i); !separation.empty()) {
      lines.push_back("  " + separation);
    }
  }
  lines.push_back(verdictText(margin));
  if (const std::string decay = decayText(margin); !decay.empty()) {
    lines.push_back(decay);
  }
  if (margin.instability_speed_valid) {
    lines.push_back(fmt::format("unstable above {:.1f} rad/s", margin.instability_speed));
  }
  return lines;
}

std::string severityName(int severity) {
  return severity >= Alert::DANGER ? "DANGER" : severity == Alert::WARNING ? "WARNING" : "INFO";
}

std::vector<std::string> wrapText(const std::string& sentence, std::size_t width) {
  std::vector<std::string> lines;
  const std::string indent(std::min(sentence.find_first_not_of(' '), sentence.size()), ' ');
  std::istringstream words(sentence);
  for (std::string word; words >> word;) {
    if (lines.empty()) {
      lines.push_back(indent + word);
    } else if (lines.back().size() + 1 + word.size() > width) {
      lines.push_back(indent + "  " + word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

std::string joinedLines(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace whirl_twin
