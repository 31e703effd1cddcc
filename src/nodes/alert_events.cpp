#include "nodes/alert_events.h"

#include <ros/ros.h>

#include "messages/wall_clock.h"
#include "transport/master_watch.h"

namespace whirl_twin {

KeptHistory::KeptHistory(TwinMonitor& monitor, AlertEvents& events, const std::string& path)
    : monitor_(monitor), events_(events) {
  if (path.empty()) {
    return;
  }
  history_.emplace(path);
  monitor_.remember(history_->memory());
  if (const std::size_t lines = history_->unreadableLines(); lines > 0) {
    ROS_WARN("%s: %zu lines cannot be read and are left out", path.c_str(), lines);
  }
  run_ = history_->memory().run;
  reportProblem();
}

void KeptHistory::keep() {
  keepEvents();
  if (!history_) {
    return;
  }
  if (monitor_.run() && monitor_.run() != run_) {
    run_ = monitor_.run();
    history_->writeRun(*run_);
  }
  history_->retry();
  reportProblem();
}

void KeptHistory::keepReset() {
  keepEvents();
  if (history_) {
    history_->writeReset();
  }
}

void KeptHistory::keepSettings(const std::string& text) {
  keepEvents();
  if (history_) {
    history_->writeSettings(text);
  }
}

void KeptHistory::keepEvents() {
  for (state::Alert event : monitor_.alerts().takeEvents()) {
    if (history_) {
      event.stamp = wallClock();  // wall clock, in addition to the simulated time
      history_->write(event);
    }
    event.stamp = stampNow();
    events_.tell(event);
  }
}

/// Each problem once: the alarms continue without a history.
void KeptHistory::reportProblem() {
  if (history_->problem() == reported_) {
    return;
  }
  reported_ = history_->problem();
  if (reported_.empty()) {
    ROS_INFO("the alarm history is saved again");
  } else {
    ROS_WARN("%s", reported_.c_str());
  }
}

namespace {

constexpr double kPeriod = 5.0;  // s

}  // namespace

void AlertEvents::tell(const state::Alert& event) {
  lcm_.publish(event);
  newest_ = event.time;
  if (!event.raised || event.latched) {
    ROS_INFO("%s: %s %s: %s", event.system.c_str(), event.type.c_str(),
             event.latched ? "latched" : "cleared", event.text.c_str());
  } else if (event.acknowledged) {
    ROS_INFO("%s: %s acknowledged", event.system.c_str(), event.type.c_str());
  } else {
    ROS_WARN("%s", event.text.c_str());
  }
}

void AlertEvents::tellAgain(const std::vector<state::Alert>& active, double now) {
  if (!lcm_.on() || now < next_) {
    return;
  }
  next_ = now + kPeriod;
  for (state::Alert alert : active) {
    alert.time = newest_;  // an earlier time would indicate a restarted run
    lcm_.publish(alert);
  }
}

}  // namespace whirl_twin
