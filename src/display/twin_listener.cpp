#include "display/twin_listener.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <type_traits>

#include "messages/message_check.h"
#include "messages/names.h"
#include "transport/ros_converters.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {
namespace {

// Two seconds of a 1 kHz topic: the spinner's thread also waits for answers of the master.
constexpr std::uint32_t kQueue = 2000;

template <class Message>
bool isType(const std::string& type) {
  return type == ros::message_traits::datatype<Message>();
}

/// [s] without a message: statistics and the monitor's status come once a second.
constexpr double kSilence = 2.5;

bool isState(const TwinTopic& topic) {
  return isType<WhirlState>(topic.type) || isType<PendulumState>(topic.type);
}

}  // namespace

std::vector<TwinTopic> twinTopics(const ros::master::V_TopicInfo& all,
                                  const std::string& twin_namespace) {
  const std::string prefix = twin_namespace + "/";
  std::vector<TwinTopic> topics;
  for (const auto& info : all) {
    if (info.name.rfind(prefix, 0) != 0) {
      continue;
    }
    const std::string rest = info.name.substr(prefix.size());
    const std::size_t slash = rest.find('/');
    if ((isType<AlertArray>(info.datatype) || isType<MonitorStatus>(info.datatype) ||
         isType<LoopStatistics>(info.datatype)) &&
        slash == std::string::npos) {
      topics.push_back({info.name, info.datatype, ""});
      continue;
    }
    const std::size_t second = slash == std::string::npos ? slash : rest.find('/', slash + 1);
    if ((isType<ControllerMargins>(info.datatype) || isType<MotorState>(info.datatype)) &&
        second != std::string::npos) {
      topics.push_back({info.name, info.datatype, rest.substr(slash + 1, second - slash - 1)});
    } else if (slash == std::string::npos || second != std::string::npos) {
      continue;
    } else if (isType<DriveState>(info.datatype) || isType<Measurement>(info.datatype) ||
               isType<ControllerState>(info.datatype)) {
      topics.push_back({info.name, info.datatype, rest.substr(slash + 1)});
    } else if (isType<WhirlState>(info.datatype) || isType<PendulumState>(info.datatype) ||
               isType<StabilityMargin>(info.datatype) || isType<ParameterChange>(info.datatype) ||
               isType<OrderState>(info.datatype) || isType<FollowState>(info.datatype) ||
               isType<EnsembleState>(info.datatype)) {
      topics.push_back({info.name, info.datatype, rest.substr(0, slash)});
    }
  }
  return topics;
}

void TwinListener::discover() {
  if (ros::SteadyTime::now().toSec() - others_at_ > 2.0 * kSilence) {
    others_.clear();
  }
  ros::master::V_TopicInfo all;
  if (!ros::master::getTopics(all)) {
    return;
  }
  const auto topics = twinTopics(all, twinNamespace());
  if (std::any_of(topics.begin(), topics.end(), isState)) {
    for (auto it = subscriptions_.begin(); it != subscriptions_.end();) {
      const bool published = std::any_of(topics.begin(), topics.end(), [&](const TwinTopic& topic) {
        return topic.topic == it->first && topic.type == it->second.topic.type;
      });
      if (!published) {
        forget(it->second.topic);
      }
      it = published ? std::next(it) : subscriptions_.erase(it);
    }
  }
  for (const auto& topic : topics) {
    const bool has_handler =
        message_handler_ || !(isType<MotorState>(topic.type) || isType<EnsembleState>(topic.type));
    if (has_handler && subscriptions_.count(topic.topic) == 0) {
      subscriptions_[topic.topic] = {topic, subscribe(topic)};
    }
  }
}

template <class Type>
ros::Subscriber TwinListener::listen(const TwinTopic& topic,
                                     std::function<void(const typename Type::ConstPtr&)> take) {
  using Event = ros::MessageEvent<const Type>;
  const boost::function<void(const Event&)> checked = [this, take = std::move(take),
                                                       name = topic.topic](const Event& event) {
    const typename Type::ConstPtr message = event.getConstMessage();
    if constexpr (std::is_same_v<Type, AlertArray>) {  // of which all is text
      if (isOfHolder(name, event.getPublisherName())) {
        take(message);
      }
    } else {
      try {
        const auto state = fromRos(*message);
        if (isOfHolder(name, event.getPublisherName())) {
          take(message);
          if (message_handler_) {
            message_handler_(state);
          }
        }
      } catch (const RejectedMessage& why) {
        ROS_WARN_THROTTLE(5.0, "%s: rejected: %s", name.c_str(), why.what());
      }
    }
  };
  return node_.subscribe<const Event&>(topic.topic, kQueue, checked, ros::VoidConstPtr(),
                                       ros::TransportHints().tcpNoDelay());
}

bool TwinListener::isOfHolder(const std::string& topic, const std::string& publisher) {
  const double now = ros::SteadyTime::now().toSec();
  std::string& holder = holders_.try_emplace(topic, publisher).first->second;
  if (holder != publisher && now - heard_[holder] > kSilence) {
    holder = publisher;
  }
  if (holder == publisher) {
    heard_[publisher] = now;
    return true;
  }
  others_ = printable(publisher) + " also publishes as this twin, beside " + printable(holder);
  others_at_ = now;
  ROS_WARN_THROTTLE(5.0, "%s: its messages are ignored", others_.c_str());
  return false;
}

ros::Subscriber TwinListener::subscribe(const TwinTopic& topic) {
  const std::string subject = topic.subject;
  if (isType<WhirlState>(topic.type)) {
    return listen<WhirlState>(topic, [this, subject](const WhirlState::ConstPtr& state) {
      SystemReadout& readout = systems_[subject];
      readout.whirl = state;
      readout.vibration = readout.followed.take(fromRos(*state));
      if (whirl_handler_) {
        whirl_handler_(subject, *state);
      }
    });
  }
  if (isType<PendulumState>(topic.type)) {
    return listen<PendulumState>(topic, [this, subject](const PendulumState::ConstPtr& state) {
      systems_[subject].pendulum = state;
      if (pendulum_handler_) {
        pendulum_handler_(subject, *state);
      }
    });
  }
  if (isType<OrderState>(topic.type)) {
    return listen<OrderState>(topic, [this, subject](const OrderState::ConstPtr& orders) {
      systems_[subject].orders = orders;
    });
  }
  if (isType<StabilityMargin>(topic.type)) {
    return listen<StabilityMargin>(topic, [this, subject](const StabilityMargin::ConstPtr& margin) {
      systems_[subject].margin = margin;
      systems_[subject].margin_heard = ros::WallTime::now().toSec();
    });
  }
  if (isType<FollowState>(topic.type)) {
    return listen<FollowState>(topic, [this, subject](const FollowState::ConstPtr& follow) {
      systems_[subject].follow = follow;
    });
  }
  if (isType<Measurement>(topic.type)) {
    return listen<Measurement>(topic, [this, subject](const Measurement::ConstPtr& block) {
      if (measurement_handler_) {
        measurement_handler_(subject, *block);
      }
    });
  }
  if (isType<ControllerState>(topic.type)) {
    return listen<ControllerState>(topic, [this, subject](const ControllerState::ConstPtr& state) {
      if (controller_handler_) {
        controller_handler_(subject, *state);
      }
    });
  }
  if (isType<ControllerMargins>(topic.type)) {
    return listen<ControllerMargins>(topic,
                                     [this, subject](const ControllerMargins::ConstPtr& margins) {
                                       if (controller_margins_handler_) {
                                         controller_margins_handler_(subject, margins);
                                       }
                                     });
  }
  if (isType<ParameterChange>(topic.type)) {
    return listen<ParameterChange>(topic, [this](const ParameterChange::ConstPtr& change) {
      if (parameter_handler_) {
        parameter_handler_(*change);
      }
    });
  }
  if (isType<DriveState>(topic.type)) {
    return listen<DriveState>(
        topic, [this, subject](const DriveState::ConstPtr& drive) { drives_[subject] = drive; });
  }
  if (isType<MonitorStatus>(topic.type)) {
    return listen<MonitorStatus>(topic, [this](const MonitorStatus::ConstPtr& status) {
      monitor_ = status;
      pulse_.beat(ros::WallTime::now().toSec());
    });
  }
  if (isType<LoopStatistics>(topic.type)) {
    return listen<LoopStatistics>(topic, [this](const LoopStatistics::ConstPtr& loop) {
      if (loop_handler_) {
        loop_handler_(*loop);
      }
    });
  }
  if (isType<MotorState>(topic.type)) {
    return listen<MotorState>(topic, [](const MotorState::ConstPtr&) {});
  }
  if (isType<EnsembleState>(topic.type)) {
    return listen<EnsembleState>(topic, [](const EnsembleState::ConstPtr&) {});
  }
  return listen<AlertArray>(topic, [this](const AlertArray::ConstPtr& alerts) {
    alerts_ = alerts;
    if (alert_handler_) {
      alert_handler_(*alerts);
    }
  });
}

void TwinListener::forget(const TwinTopic& topic) {
  if (isState(topic)) {
    systems_.erase(topic.subject);
  } else if (isType<DriveState>(topic.type)) {
    drives_.erase(topic.subject);
  } else if (isType<AlertArray>(topic.type)) {
    alerts_.reset();
  }
}

std::string TwinListener::monitorSilence() const {
  return pulse_.silence(ros::WallTime::now().toSec());
}

std::vector<Alert> TwinListener::alertsOf(const std::string& system) const {
  std::vector<Alert> found;
  if (alerts_) {
    std::copy_if(alerts_->alerts.begin(), alerts_->alerts.end(), std::back_inserter(found),
                 [&](const Alert& alert) { return alert.system == system; });
  }
  return found;
}

const DriveState* TwinListener::drive(const std::string& name) const {
  const auto found = drives_.find(name);
  return found == drives_.end() ? nullptr : found->second.get();
}

double TwinListener::time() const {
  double latest = 0.0;
  for (const auto& [name, readout] : systems_) {
    latest = std::max({latest, readout.whirl ? readout.whirl->time : 0.0,
                       readout.pendulum ? readout.pendulum->time : 0.0});
  }
  return latest;
}

}  // namespace whirl_twin
