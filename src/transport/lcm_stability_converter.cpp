#include <cmath>

#include "transport/lcm_converters.h"
#include "transport/lcm_instant.h"

namespace whirl_twin {
namespace {

std::int32_t lengthOf(std::size_t size) {
  return static_cast<std::int32_t>(size);
}

}  // namespace

stability_margin_t toLcm(const state::StabilityMargin& margin) {
  stability_margin_t message;
  putInstant(margin.at, message);
  message.system = margin.system;
  message.model = margin.model;
  message.verdict = static_cast<std::int8_t>(margin.verdict);
  message.verdict_name = margin.verdict_name;
  message.coordinates = lengthOf(margin.coordinate.size());
  message.coordinate = margin.coordinate;
  message.operating_point = margin.operating_point;
  message.operating_point.resize(margin.coordinate.size());
  message.speed = margin.speed;
  message.coefficients = lengthOf(margin.polynomial.size());
  message.polynomial = margin.polynomial;
  message.rows = lengthOf(margin.first_column.size());
  message.first_column = margin.first_column;
  message.right = static_cast<std::int32_t>(margin.right);
  message.imaginary = static_cast<std::int32_t>(margin.imaginary);
  message.left = static_cast<std::int32_t>(margin.left);
  message.decay_rate = margin.decay_rate;
  message.damping_ratio = margin.damping_ratio;
  message.log_decrement = margin.log_decrement;
  message.instability_speed = margin.instability_speed;
  message.instability_speed_valid = !std::isnan(margin.instability_speed);
  message.critical_speeds = lengthOf(margin.critical_speeds.size());
  for (const auto& critical : margin.critical_speeds) {
    message.critical_speed.push_back(critical.speed);
    message.direction.push_back(critical.direction);
    message.amplification_factor.push_back(critical.amplification_factor);
    message.separation_margin.push_back(critical.separation_margin);
    message.required_separation_margin.push_back(critical.required_separation_margin);
    message.band_low.push_back(critical.band_low);
    message.band_high.push_back(critical.band_high);
  }
  return message;
}

namespace {

state::CriticalSpeedMargin takeCriticalSpeed(const stability_margin_t& message, std::size_t i) {
  state::CriticalSpeedMargin critical;
  critical.speed = message.critical_speed[i];
  critical.direction = message.direction[i];
  critical.amplification_factor = message.amplification_factor[i];
  critical.separation_margin = message.separation_margin[i];
  critical.required_separation_margin = message.required_separation_margin[i];
  critical.band_low = message.band_low[i];
  critical.band_high = message.band_high[i];
  return critical;
}

void requireLengths(const stability_margin_t& message) {
  requireLength("coordinate", message.coordinate.size(), message.coordinates);
  requireLength("operating_point", message.operating_point.size(), message.coordinates);
  requireLength("polynomial", message.polynomial.size(), message.coefficients);
  requireLength("first_column", message.first_column.size(), message.rows);
  const std::int64_t critical_speeds = message.critical_speeds;
  requireLength("critical_speed", message.critical_speed.size(), critical_speeds);
  requireLength("direction", message.direction.size(), critical_speeds);
  requireLength("amplification_factor", message.amplification_factor.size(), critical_speeds);
  requireLength("separation_margin", message.separation_margin.size(), critical_speeds);
  requireLength("required_separation_margin", message.required_separation_margin.size(),
                critical_speeds);
  requireLength("band_low", message.band_low.size(), critical_speeds);
  requireLength("band_high", message.band_high.size(), critical_speeds);
}

}  // namespace

state::StabilityMargin fromLcm(const stability_margin_t& message) {
  requireName("system", message.system);
  requireName("model", message.model);
  requireName("verdict_name", message.verdict_name);
  requireRange("verdict", message.verdict, 0, 4);
  requireLengths(message);
  requireNames("coordinate", message.coordinate);
  requireNames("direction", message.direction);
  requireRange("right", message.right, 0, message.coefficients);
  requireRange("imaginary", message.imaginary, 0, message.coefficients);
  requireRange("left", message.left, 0, message.coefficients);
  // NaN and false say the same thing twice: none was found.
  const int found = std::isnan(message.instability_speed) ? 0 : 1;
  requireRange("instability_speed_valid", message.instability_speed_valid, found, found);
  state::StabilityMargin margin;
  margin.at = takeInstant(message);
  margin.system = message.system;
  margin.model = message.model;
  margin.verdict = static_cast<std::uint8_t>(message.verdict);
  margin.verdict_name = message.verdict_name;
  margin.coordinate = message.coordinate;
  margin.operating_point = message.operating_point;
  margin.speed = message.speed;
  margin.polynomial = message.polynomial;
  margin.first_column = message.first_column;
  margin.right = static_cast<std::uint32_t>(message.right);
  margin.imaginary = static_cast<std::uint32_t>(message.imaginary);
  margin.left = static_cast<std::uint32_t>(message.left);
  margin.decay_rate = message.decay_rate;
  margin.damping_ratio = message.damping_ratio;
  margin.log_decrement = message.log_decrement;
  margin.instability_speed = message.instability_speed;
  for (std::size_t i = 0; i < message.critical_speed.size(); ++i) {
    margin.critical_speeds.push_back(takeCriticalSpeed(message, i));
  }
  return margin;
}

}  // namespace whirl_twin
