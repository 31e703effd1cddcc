#include "twin/order_observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/signal_names.h"
#include "signal/order_filter.h"

namespace whirl_twin {

namespace {

constexpr double kPeriod = 0.05;          // [s], simulated
constexpr std::size_t kAtOnce = 8;        // stations per period: an estimate takes 0.5 ms
constexpr std::size_t kMaxFollowed = 64;  // a window is 0.3 MB

}  // namespace

OrderObserver::OrderObserver(const Twin& twin)
    : period_(std::max<std::int64_t>(1, std::llround(kPeriod / twin.scene().stepSeconds()))) {
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    const BuiltSystem& system = *twin.systems()[i];
    if (!system.dynamics->isRotor()) {
      continue;
    }
    const std::size_t stations = publishedStations(system.spec.name, *system.dynamics).size();
    for (std::size_t k = 0; k < stations && followed_.size() < kMaxFollowed; ++k) {
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
  // Many stations are published in groups by turns; by the step, so that runs are reproducible.
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
  state::OrderState s = reportedOrders(followed.filter.estimate());
  s.at = observer.instant();
  s.system = observer.stations(followed.system)[followed.station];
  return s;
}

}  // namespace whirl_twin
