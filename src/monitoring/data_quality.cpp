#include "monitoring/data_quality.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace whirl_twin {

namespace {

constexpr double kGap = 10.0;  // periods of sampling: what moved before it may be at rest after it

}  // namespace

DataQuality::DataQuality(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)) {
  set(settings);
}

void DataQuality::set(const AlarmSettings& settings) {
  timeout_ = settings.data_timeout;
  const AmplitudeLevels* const levels = settingOf(settings.amplitude, system_);
  range_ = levels == nullptr ? kInfinity : levels->range;
}

bool DataQuality::take(std::string unfit, double wall_time) {
  received_at_ = wall_time;
  unfit_ = std::move(unfit);
  return unfit_.empty();
}

bool DataQuality::take(const state::WhirlState& whirl, double wall_time) {
  for (const auto& [name, value] :
       {std::pair("x", whirl.x), std::pair("y", whirl.y), std::pair("x_rate", whirl.x_rate),
        std::pair("y_rate", whirl.y_rate), std::pair("radius", whirl.radius),
        std::pair("speed", whirl.speed)}) {
    if (!std::isfinite(value)) {
      return take(fmt::format("not finite: {}", name), wall_time);
    }
  }
  if (whirl.radius > range_) {
    return take(fmt::format("out of range: whirl {:.3g} mm 0-peak, above {:.3g} mm",
                            1.0e3 * whirl.radius, 1.0e3 * range_),
                wall_time);
  }
  return take(stuck(whirl), wall_time);
}

std::string DataQuality::stuck(const state::WhirlState& whirl) {
  const double since = whirl.at.time - sampled_at_;
  if (since == 0.0) {  // received again
    return unfit_;
  }
  if (!(since > 0.0) || (period_ > 0.0 && since > kGap * period_)) {
    x_ = y_ = StuckChannel();
    period_ = 0.0;
  } else {
    period_ = since;
  }
  sampled_at_ = whirl.at.time;
  x_.take(whirl.x);
  y_.take(whirl.y);
  if (!x_.stuck() && !y_.stuck()) {
    return "";
  }
  return fmt::format("stuck: {}", x_.stuck() ? (y_.stuck() ? "x, y" : "x") : "y");
}

bool DataQuality::take(const state::PendulumState& pendulum, double wall_time) {
  for (std::size_t i = 0; i < pendulum.angle.size(); ++i) {
    if (!std::isfinite(pendulum.angle[i]) || !std::isfinite(pendulum.rate[i])) {
      return take(fmt::format("not finite: {}", pendulum.name[i]), wall_time);
    }
  }
  return take("", wall_time);
}

bool DataQuality::isStale(double wall_time) const {
  return !(wall_time - received_at_ <= timeout_);
}

std::string DataQuality::problem(double wall_time, bool paused) const {
  if (!received()) {
    return "stale: no state received yet";
  }
  if (isStale(wall_time) && !paused) {
    return fmt::format("stale: no state for {:.1f} s", wall_time - received_at_);
  }
  return unfit_;
}

}  // namespace whirl_twin
