// Finds the systems that a twin publishes, from the ROS master, and subscribes to all of them, so
// that a live twin, a log playback and any scene are handled alike. It needs no scene.
#pragma once

#include <ros/ros.h>

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "messages/message.h"
#include "messages/monitor_status.h"
#include "monitoring/whirl_vibration.h"
#include "whirl_twin/AlertArray.h"
#include "whirl_twin/ControllerMargins.h"
#include "whirl_twin/ControllerState.h"
#include "whirl_twin/DriveState.h"
#include "whirl_twin/FollowState.h"
#include "whirl_twin/LoopStatistics.h"
#include "whirl_twin/Measurement.h"
#include "whirl_twin/MonitorStatus.h"
#include "whirl_twin/OrderState.h"
#include "whirl_twin/ParameterChange.h"
#include "whirl_twin/PendulumState.h"
#include "whirl_twin/StabilityMargin.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

/// The latest data of one system; null before the first message.
struct SystemReadout {
  WhirlState::ConstPtr whirl;
  WhirlVibration followed;                                      ///< of the whirl
  double vibration = std::numeric_limits<double>::quiet_NaN();  ///< [m], what that measures
  OrderState::ConstPtr orders;
  PendulumState::ConstPtr pendulum;
  StabilityMargin::ConstPtr margin;
  double margin_heard = 0.0;  ///< [s], wall time
  FollowState::ConstPtr follow;
};

/// A topic of the twin: its full name, message type and its system or drive.
struct TwinTopic {
  std::string topic;
  std::string type;
  std::string subject;  ///< also a source or a controller; empty for the whole twin
};

/// The topics of the twin in a namespace, such as /twin, among all those registered at the master.
std::vector<TwinTopic> twinTopics(const ros::master::V_TopicInfo& all,
                                  const std::string& twin_namespace);

class TwinListener {
 public:
  using WhirlHandler = std::function<void(const std::string& system, const WhirlState&)>;
  using PendulumHandler = std::function<void(const std::string& system, const PendulumState&)>;
  using ParameterHandler = std::function<void(const ParameterChange&)>;
  using MeasurementHandler = std::function<void(const std::string& source, const Measurement&)>;
  using ControllerHandler =
      std::function<void(const std::string& controller, const ControllerState&)>;
  using ControllerMarginsHandler =
      std::function<void(const std::string& controller, const ControllerMargins::ConstPtr&)>;
  using LoopHandler = std::function<void(const LoopStatistics&)>;
  using AlertHandler = std::function<void(const AlertArray&)>;
  using MessageHandler = std::function<void(const Message&)>;

  /// Called with every state, in the spinner's thread; must be set before the first discover().
  void onWhirl(WhirlHandler handler) { whirl_handler_ = std::move(handler); }
  void onPendulum(PendulumHandler handler) { pendulum_handler_ = std::move(handler); }
  void onParameters(ParameterHandler handler) { parameter_handler_ = std::move(handler); }
  void onMeasurement(MeasurementHandler handler) { measurement_handler_ = std::move(handler); }
  void onController(ControllerHandler handler) { controller_handler_ = std::move(handler); }
  void onControllerMargins(ControllerMarginsHandler handler) {
    controller_margins_handler_ = std::move(handler);
  }
  void onLoop(LoopHandler handler) { loop_handler_ = std::move(handler); }
  void onAlerts(AlertHandler handler) { alert_handler_ = std::move(handler); }
  /// Every message of the twin and its monitor but the alerts, also of kinds that no other handler
  /// takes.
  void onMessage(MessageHandler handler) { message_handler_ = std::move(handler); }

  /// Queries the master and updates the subscriptions. A vanished topic is dropped only when
  /// another appears, so a stopped twin stays on the screen until the next one starts.
  void discover();

  const std::map<std::string, SystemReadout>& systems() const { return systems_; }

  /// The latest alerts about a system, most severe first.
  std::vector<Alert> alertsOf(const std::string& system) const;

  /// All of them; null before the first list.
  const AlertArray::ConstPtr& alerts() const { return alerts_; }

  /// The monitor's latest heartbeat; null before the first.
  const MonitorStatus::ConstPtr& monitor() const { return monitor_; }

  /// The latest state of a drive; null when there is none.
  const DriveState* drive(const std::string& name) const;

  /// "no message from the monitor for ..."; "" without a timeout. After one, margins and alerts are
  /// out of date.
  std::string monitorSilence() const;

  /// Other nodes that publish on the subscribed topics (duplicate publishers); "": none.
  const std::string& others() const { return others_; }

  /// [s], latest simulated time of any system.
  double time() const;

 private:
  ros::Subscriber subscribe(const TwinTopic& topic);
  template <class Type>
  ros::Subscriber listen(const TwinTopic& topic,
                         std::function<void(const typename Type::ConstPtr&)> take);
  void forget(const TwinTopic& topic);
  /// Each topic is bound to one node, the first publisher received, until its timeout.
  bool isOfHolder(const std::string& topic, const std::string& publisher);

  ros::NodeHandle node_;
  WhirlHandler whirl_handler_;
  PendulumHandler pendulum_handler_;
  ParameterHandler parameter_handler_;
  MeasurementHandler measurement_handler_;
  ControllerHandler controller_handler_;
  ControllerMarginsHandler controller_margins_handler_;
  LoopHandler loop_handler_;
  AlertHandler alert_handler_;
  MessageHandler message_handler_;
  struct Subscription {
    TwinTopic topic;
    ros::Subscriber subscriber;
  };
  std::map<std::string, Subscription> subscriptions_;
  std::map<std::string, SystemReadout> systems_;
  std::map<std::string, DriveState::ConstPtr> drives_;
  AlertArray::ConstPtr alerts_;
  MonitorStatus::ConstPtr monitor_;
  MonitorPulse pulse_;
  std::map<std::string, std::string> holders_;  // of each topic
  std::map<std::string, double> heard_;         // [s], last reception from a node on any
  std::string others_;
  double others_at_ = 0.0;  // [s], last reception from one of them
};

}  // namespace whirl_twin
