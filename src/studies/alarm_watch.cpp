#include "studies/alarm_watch.h"

#include <algorithm>
#include <iterator>

#include "messages/alert.h"

namespace whirl_twin {

namespace {

const std::string kAlarms = "alarms";
constexpr double kTick = 0.1;  // [s], longest tick period of the monitor's node

/// Passes messages to the monitor.
struct Listener {
  TwinMonitor& monitor;
  double now;  // s

  template <class Make>
  void operator()(const std::string& /*subject*/, Make make) {
    if constexpr (IsWatchedState<decltype(make())>::value) {
      monitor.take(make(), now);
    }
  }
  void change(const state::ParameterChange& change) { monitor.take(change); }
  void again(const state::ParameterChange& /*change*/) {}
};

}  // namespace

std::optional<std::string> countedAlarm(const std::string& path) {
  if (path == kAlarms) {
    return "";
  }
  const auto type = std::find_if(std::begin(alert_type::kAll), std::end(alert_type::kAll),
                                 [&](const char* name) { return path == kAlarms + "." + name; });
  return type != std::end(alert_type::kAll) ? std::optional<std::string>(*type) : std::nullopt;
}

std::vector<std::string> alarmPaths() {
  std::vector<std::string> paths{kAlarms};
  for (const char* type : alert_type::kAll) {
    paths.push_back(kAlarms + "." + type);
  }
  return paths;
}

AlarmWatch::AlarmWatch(const Twin& twin, const AlarmSettings& settings)
    : twin_(twin),
      observer_(twin),
      orders_(twin),
      messages_(twin.built()),
      monitor_(twin.built(), settings),
      record_(twin.layout().size) {}

void AlarmWatch::look() {
  twin_.write(record_.data());
  observer_.observe(record_.data());
  orders_.take(record_.data(), observer_);
  const double time = observer_.instant().time;
  started_ = started_.value_or(time);
  const double now = time - *started_;  // the monitor's clock starts at 0
  for (; now - ticked_ >= kTick; ticked_ += kTick) {
    monitor_.tick(ticked_ + kTick, false);
  }
  Listener listener{monitor_, now};
  messages_.tell(observer_, true, listener);
  messages_.tellOrders(observer_, orders_, listener);
  for (const state::Alert& event : monitor_.alerts().takeEvents()) {
    if (ids_.insert(event.id).second) {
      ++counts_[event.type];
    }
  }
  monitor_.takeMargins();  // discarded; they would accumulate
  monitor_.takeLoopMargins();
  monitor_.takeOrders();
}

double AlarmWatch::raised(const std::string& type) const {
  if (type.empty()) {
    return static_cast<double>(ids_.size());
  }
  const auto found = counts_.find(type);
  return found != counts_.end() ? static_cast<double>(found->second) : 0.0;
}

}  // namespace whirl_twin
