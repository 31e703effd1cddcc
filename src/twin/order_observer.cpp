#include "twin/order_observer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/station_names.h"

namespace whirl_twin {

namespace {

constexpr double kPeriod = 0.05;           // [s], simulated
constexpr std::size_t kAtOnce = 8;         // stations told in a period: an estimate is some 0.5 ms
constexpr std::size_t kMostFollowed = 64;  // a window is 0.3 MB

}  // namespace

OrderObserver::OrderObserver(const Twin& twin)
    : period_(std::max<std::int64_t>(1, std::llround(kPeriod / twin.scene().stepSeconds()))) {
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    const BuiltSystem& system = *twin.systems()[i];
    if (!system.dynamics->isRotor()) {
      continue;
    }
    const std::size_t stations = publishedStations(system.spec.name, *system.dynamics).size();
    for (std::size_t k = 0; k < stations && followed_.size() < kMostFollowed; ++k) {
      followed_.push_back({i, k, OrderFilter()});
    }
  }
}

void OrderObserver::take(const double* record, const Observer& observer) {
  for (Followed& followed : followed_) {
    followed.filter.take(observer.orbitSample(record, followed.system, followed.station));
  }
}

bool OrderObserver::dueAt(std::int64_t step) const {
  return !followed_.empty() && step > 0 && step % period_ == 0;
}

std::vector<const OrderObserver::Followed*> OrderObserver::turnOf(const Observer& observer) const {
  std::vector<const Followed*> turn;
  if (!dueAt(observer.step())) {
    return turn;
  }
  // Where there are many, groups take turns: by the step, so that a run repeats itself.
  const std::size_t groups = (followed_.size() + kAtOnce - 1) / kAtOnce;
  const auto group = static_cast<std::size_t>(observer.step() / period_) % groups;
  for (std::size_t i = group; i < followed_.size(); i += groups) {
    if (observer.status(followed_[i].system) == StepStatus::kOk) {
      turn.push_back(&followed_[i]);
    }
  }
  return turn;
}

state::OrderState OrderObserver::orderState(const Observer& observer, const Followed& followed) {
  const OrbitEstimate e = followed.filter.estimate();
  state::OrderState s;
  s.at = observer.instant();
  s.system = observer.stations(followed.system)[followed.station];
  s.valid = e.valid;
  s.delay = e.delay;
  s.window = e.window;
  s.speed = e.speed;
  s.mean_x = e.mean.real();
  s.mean_y = e.mean.imag();
  s.peak_to_peak = e.peak_to_peak;
  s.precession = e.precession;
  s.forward = e.precession >= 0.0;
  s.noise = e.noise;
  for (const OrderVector& order : e.orders) {
    s.order.push_back(order.order);
    s.forward_amplitude.push_back(std::abs(order.forward));
    s.forward_lag.push_back(order.forwardLag());
    s.backward_amplitude.push_back(std::abs(order.backward));
    s.backward_lag.push_back(order.backwardLag());
    s.deviation.push_back(order.deviation);
  }
  for (const SpectralLine& line : e.lines) {
    s.line_frequency.push_back(line.frequency);
    s.line_ratio.push_back(e.speed == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                          : line.frequency / std::fabs(e.speed));
    s.line_forward.push_back(e.speed < 0.0 ? line.backward : line.forward);
    s.line_backward.push_back(e.speed < 0.0 ? line.forward : line.backward);
    s.line_growth.push_back(line.growth);
  }
  return s;
}

}  // namespace whirl_twin
