#include "signal/voltage_pulses.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

constexpr std::size_t kMinSamples = 20;
constexpr std::size_t kWildSamples = 8;               // that may be beyond the levels
constexpr double kNearALevel = 0.25, kMinNear = 0.8;  // of their distance; of the samples

}  // namespace

VoltageLevels levelsOf(std::vector<double> samples) {
  samples.erase(
      std::remove_if(samples.begin(), samples.end(), [](double v) { return std::isnan(v); }),
      samples.end());
  VoltageLevels levels;
  if (samples.size() < kMinSamples) {
    return levels;
  }
  const std::size_t wild = std::min(kWildSamples, samples.size() / kMinSamples);
  const auto nth = [&](std::size_t n) {
    const auto place = samples.begin() + static_cast<std::ptrdiff_t>(n);
    std::nth_element(samples.begin(), place, samples.end());
    return *place;
  };
  levels.low = nth(wild);
  levels.high = nth(samples.size() - 1 - wild);
  const double near = kNearALevel * (levels.high - levels.low);
  const double middle = 0.5 * (levels.low + levels.high);
  const auto share = [&](auto&& holds) {
    return static_cast<double>(std::count_if(samples.begin(), samples.end(), holds)) /
           static_cast<double>(samples.size());
  };
  levels.mostly_high = share([&](double v) { return v > middle; }) > 0.5;
  levels.two = levels.high > levels.low && share([&](double v) {
                                             return v < levels.low + near || v > levels.high - near;
                                           }) > kMinNear;
  return levels;
}

std::optional<std::int64_t> VoltagePulses::take(std::int64_t instant, double volts) {
  if (std::isnan(volts)) {
    return std::nullopt;
  }
  const double beyond = (falling_ ? -1.0 : 1.0) * (volts - threshold_);
  std::optional<std::int64_t> pulse;
  if (armed_ && beyond >= 0.0) {
    const double part = before_ / (before_ - beyond);
    pulse = last_ + std::llround(part * static_cast<double>(instant - last_));
  }
  armed_ = beyond < -hysteresis_ || (armed_ && beyond < 0.0);
  before_ = beyond;
  last_ = instant;
  return pulse;
}

}  // namespace whirl_twin
