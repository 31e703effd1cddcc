// follow_node: a twin that follows its machine. Measurements in, from ROS or LCM; out the topics
// and channels of a simulation, so that monitor, rviz and logs need no change, with what was
// measured and what has been learned beside them. The scene is the model, and its sensors say what
// is measured. Private parameters:
//   ~machine       namespace of the machine's topics measured/... (default /machine)
//   ~input         ros or lcm (default ros): where measurements come from
//   ~machine_prefix  what the machine's LCM channels begin with (default: its namespace in
//   capitals) ~publish_rate  Hz (default 0: every step of the scene) ~lcm_url, ~lcm_prefix  of the
//   twin, as of simulation_node ~follow        what to follow beside the motion, as in the file of
//   `twin follow --settings`
// Says what it has taken and what not on /diagnostics once a second. It has one thread: what it
// tells depends on the messages and their order alone.
#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <whirl_twin/Measurement.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "estimation/clock_watch.h"
#include "estimation/follow_settings_reader.h"
#include "estimation/follower.h"
#include "nodes/private_parameter.h"
#include "nodes/run_node.h"
#include "nodes/state_publisher.h"
#include "plugins/plugin_models.h"
#include "scene/scene_reader.h"
#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_receiver.h"
#include "transport/master_watch.h"
#include "transport/ros_converters.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"
#include "twin/observer.h"
#include "twin/order_observer.h"

namespace whirl_twin {
namespace {

constexpr double kSlowestRate = 1.0e-3;  // Hz, of publication
constexpr std::uint32_t kQueue = 1000;   // blocks
constexpr std::chrono::milliseconds kPoll{2};
const ros::WallDuration kReportPeriod(1.0);
const ros::WallDuration kSilence(1.0);         // of the machine, from which on it is told
const ros::WallDuration kSilenceTelling(0.2);  // from one such message to the next

std::int64_t stepsFor(double rate, const Scene& scene) {
  if (!(rate == 0.0 || (rate >= kSlowestRate && std::isfinite(rate)))) {
    throw Refusal(fmt::format("publish_rate: must be 0 (every step), or at least {} Hz, found {}",
                              kSlowestRate, rate));
  }
  return rate == 0.0 ? 1
                     : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
}

FollowSettings readSettings(const BuiltScene& scene) {
  const ros::NodeHandle node("~");
  if (!node.hasParam("follow")) {
    return {};
  }
  const ParameterTree given = parameterTree(node, "follow");
  return readFollowSettings(given.tree, given.source, scene);
}

/// All that leaves the node.
class FollowPublisher {
 public:
  FollowPublisher(Twin& twin, std::shared_ptr<SystemGenerations> generations, ros::NodeHandle node,
                  LcmPublisher lcm)
      : observer_(twin, std::move(generations)),
        orders_(twin),
        states_(twin, EnsembleObserver(twin), node, std::move(lcm), false) {
    for (const SystemSpec& system : twin.scene().systems) {
      states_.advertise<state::FollowState>(system.name);
    }
    for (const SensorSpec& sensor : twin.scene().sensors) {
      states_.advertise<state::Measurement>(sensor.name);
    }
  }

  void setStamp(std::int64_t stamp) { stamp_ = stamp; }
  void publish(const double* record) {
    observer_.observe(record);
    orders_.take(record, observer_);
    observer_.setStamp(stamp_);
    states_.publish(observer_, !observer_.tellsOnlyChange());
    if (orders_.dueAt(observer_.step())) {
      states_.publishOrders(observer_, orders_);
    }
  }
  void publish(state::FollowState told) {
    told.at.stamp = stamp_;
    states_.tell(told);
    told_[told.system] = told;
  }
  void publish(const state::Measurement& raw) { states_.tell(raw); }
  /// Nothing has come for so long [s]: what is known, and that every channel is silent.
  void publishSilence(double silent, double step_seconds) {
    for (const auto& [system, last] : told_) {
      state::FollowState told = last;
      told.at.time += silent;
      told.at.step += std::llround(silent / step_seconds);
      told.at.stamp += std::llround(1.0e9 * silent);
      std::fill(told.channel_status.begin(), told.channel_status.end(),
                static_cast<std::uint8_t>(state::ChannelStatus::kSilent));
      std::fill(told.residual.begin(), told.residual.end(), state::FollowState::kNone);
      states_.tell(told);
    }
  }
  const std::map<std::string, state::FollowState>& told() const { return told_; }

 private:
  Observer observer_;
  OrderObserver orders_;
  StatePublisher states_;
  std::int64_t stamp_ = 0;  // [ns]
  std::map<std::string, state::FollowState> told_;
};

/// A machine's measurements, from wherever they come.
class MachineInput {
 public:
  using Handler = std::function<void(const state::Measurement&)>;

  MachineInput(const Scene& scene, const std::string& machine, bool by_lcm,
               const std::string& lcm_url, const std::string& prefix, Handler handler)
      : handler_(std::move(handler)) {
    if (by_lcm) {
      receiver_ = std::make_unique<LcmReceiver>(
          openLcm(lcm_url), Kinds{&state::Measurement::kKind},
          [this](const Message& message) { take(std::get<state::Measurement>(message)); }, prefix);
      return;
    }
    ros::NodeHandle node(machine);
    for (const SensorSpec& sensor : scene.sensors) {
      const boost::function<void(const boost::shared_ptr<const Measurement>&)> callback =
          [this](const boost::shared_ptr<const Measurement>& message) {
            try {
              take(fromRos(*message));
            } catch (const RejectedMessage& why) {
              ++rejected_;
              last_rejection_ = why.what();
            }
          };
      subscribers_.push_back(node.subscribe<Measurement>(
          topicName(state::Measurement::kKind, sensor.name), kQueue, callback, ros::VoidConstPtr(),
          ros::TransportHints().tcpNoDelay()));
    }
  }

  void receive() {
    if (receiver_) {
      receiver_->receive(kPoll);
    }
    ros::getGlobalCallbackQueue()->callAvailable(
        ros::WallDuration(receiver_ ? 0.0 : std::chrono::duration<double>(kPoll).count()));
  }
  std::uint64_t taken() const { return taken_; }
  std::uint64_t rejected() const { return rejected_ + (receiver_ ? receiver_->rejected() : 0); }
  const std::string& lastRejection() const {
    return receiver_ ? receiver_->lastRejection() : last_rejection_;
  }

 private:
  void take(const state::Measurement& message) {
    ++taken_;
    handler_(message);
  }

  Handler handler_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<LcmReceiver> receiver_;
  std::uint64_t taken_ = 0, rejected_ = 0;
  std::string last_rejection_;
};

void report(const MachineInput& input, const FollowPublisher& publisher, const Follower& follower,
            diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(input.taken() == 0 ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                 input.taken() == 0 ? "nothing measured has come yet"
                                    : fmt::format("{} messages", input.taken()));
  if (input.rejected() > 0) {
    status.mergeSummary(DiagnosticStatus::WARN, fmt::format("{} refused", input.rejected()));
    status.add("last refused", input.lastRejection());
  }
  status.add("motion found anew", follower.restarts());
  for (const auto& [system, told] : publisher.told()) {
    status.add(system, fmt::format("{} used, {} refused, {} invalid, {} late, {} lost, {} repeated",
                                   told.used, told.refused, told.invalid, told.late, told.lost,
                                   told.repeated));
  }
}

void run() {
  requireKnownParameters(
      {"machine", "input", "machine_prefix", "publish_rate", "lcm_url", "lcm_prefix", "follow"});
  ros::NodeHandle node(twinNamespace());
  usePluginModels();
  const ParameterTree given = parameterTree(node, "scene");
  Twin twin(readScene(given.tree, given.source));
  const auto machine =
      privateParameter<std::string>("machine", "the machine's namespace", "/machine");
  const auto input = privateParameter<std::string>("input", "ros or lcm", "ros");
  if (input != "ros" && input != "lcm") {
    throw Refusal(fmt::format("input: must be ros or lcm, found '{}'", printable(input)));
  }
  const auto lcm_url =
      privateParameter<std::string>("lcm_url", "an LCM url, or nothing", kDefaultLcmUrl);
  const auto prefix = privateParameter<std::string>("machine_prefix", "letters, digits and _",
                                                    lcmPrefixOf(machine));
  requireLcmPrefix(prefix);
  const std::string own_prefix = lcmPrefixParameter();
  if (machine == twinNamespace() || (input == "lcm" && prefix == own_prefix)) {
    throw Refusal(
        "machine: must be another namespace and prefix than the twin's, which tells what "
        "was measured under its own");
  }
  const std::int64_t every =
      stepsFor(privateParameter("publish_rate", "a number in Hz", 0.0), twin.scene());

  const auto generations = std::make_shared<SystemGenerations>(twin);
  FollowPublisher publisher(twin, generations, node, LcmPublisher(lcm_url, own_prefix));
  std::int64_t ahead = 0;  // [ns], of the wall clock before the machine's
  Follower* following = nullptr;
  FollowerListener listener;
  listener.record = [&](const double* record) {
    publisher.setStamp(following->machineInstant(RecordLayout::step(record)) + ahead);
    publisher.publish(record);
  };
  ClockWatch clocks;
  std::int64_t restarts = 0;
  listener.follow = [&](state::FollowState told) {
    told.clock_offset = clocks.offset();
    told.clock_offset_deviation = clocks.deviation();
    told.clock_drift = clocks.drift();
    publisher.publish(told);
  };
  Follower follower(twin, generations, readSettings(twin.built()), every, listener);
  following = &follower;
  ros::WallTime heard = ros::WallTime::now();  // the last message
  MachineInput measurements(twin.scene(), machine, input == "lcm", lcm_url, prefix,
                            [&](const state::Measurement& message) {
                              heard = ros::WallTime::now();
                              const auto now = static_cast<std::int64_t>(heard.toNSec());
                              ahead = now - lastInstant(message);
                              clocks.take(lastInstant(message), now);
                              publisher.publish(message);
                              follower.take(message);
                              if (follower.clockSettings() != restarts) {
                                restarts = follower.clockSettings();
                                clocks.restart();
                              }
                            });

  MasterWatch master({node.resolveName("scene"), node.resolveName("scene_file")});
  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID(machine);
  diagnostics.add("measurements", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    report(measurements, publisher, follower, status);
  });
  ROS_INFO("follows %s by %s", machine.c_str(), input.c_str());
  ros::WallTime next_report = ros::WallTime::now();
  ros::WallTime next_silence = next_report;
  while (ros::ok() && !stopRequested()) {
    measurements.receive();
    const ros::WallTime now = ros::WallTime::now();
    if (now - heard > kSilence && now >= next_silence) {
      next_silence = now + kSilenceTelling;
      publisher.publishSilence((now - heard).toSec(), twin.scene().stepSeconds());
    }
    if (now >= next_report) {
      next_report = now + kReportPeriod;
      diagnostics.force_update();
    }
  }
  master.stop();
  ros::shutdown();
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "follow_node", whirl_twin::run);
}
