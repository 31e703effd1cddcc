#include "nodes/state_publisher.h"

#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "transport/ros_converters.h"

namespace whirl_twin {

namespace {

constexpr std::uint32_t kQueue = 2000;            // two seconds at 1 kHz
constexpr std::int64_t kClockPeriod = 4'000'000;  // ns, simulated: 250 Hz
constexpr double kParameterPeriod = 10.0;         // s, simulated, on LCM

}  // namespace

StatePublisher::StatePublisher(const Twin& twin, EnsembleObserver ensembles, ros::NodeHandle node,
                               const std::string& lcm_url, bool clock)
    : twin_(twin), ensembles_(std::move(ensembles)), lcm_(lcm_url) {
  for (const SharedSystem& system : twin.systems()) {
    const std::string& name = system->spec.name;
    Topics topics;
    topics.state = system->dynamics->isRotor()
                       ? node.advertise<WhirlState>(name + "/whirl", kQueue)
                       : node.advertise<PendulumState>(name + "/pendulum", kQueue);
    topics.joint_states = node.advertise<sensor_msgs::JointState>(name + "/joint_states", kQueue);
    topics.parameters = node.advertise<ParameterChange>(name + "/parameters", kQueue, true);
    systems_.push_back(topics);
  }
  for (const DriveSpec& drive : twin.scene().drives) {
    drives_.push_back(node.advertise<DriveState>("drives/" + drive.name, kQueue));
    motors_.push_back(drive.motor
                          ? node.advertise<MotorState>("drives/" + drive.name + "/motor", kQueue)
                          : ros::Publisher());
  }
  for (const std::size_t system : ensembles_.systems()) {
    const std::string& name = twin.systems()[system]->spec.name;
    ensemble_topics_.push_back({system, node.advertise<EnsembleState>(name + "/ensemble", kQueue)});
  }
  if (clock) {
    clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  }
}

void StatePublisher::publish(const Observer& observer) {
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    if (observer.status(i) == StepStatus::kOk) {
      publishSystem(observer, i);
    }
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const bool wanted = drives_[i].getNumSubscribers() > 0;
    if (wanted || lcm_.on()) {
      const state::DriveState drive = observer.drive(i);
      lcm_.publish(drive);
      if (wanted) {
        drives_[i].publish(toRos(drive));
      }
    }
    if (motors_[i] && observer.status(twin_.turnedBy(i)) == StepStatus::kOk) {
      publishMotor(observer, i);
    }
  }
  const std::int64_t time = clockTime(observer);
  if (clock_ && std::abs(time - last_clock_) >= kClockPeriod) {
    publishClock(observer);
    last_clock_ = time;
  }
}

void StatePublisher::publishMotor(const Observer& observer, std::size_t drive) {
  const bool wanted = motors_[drive].getNumSubscribers() > 0;
  if (!wanted && !lcm_.on()) {
    return;
  }
  const state::MotorState motor = observer.motor(drive);
  lcm_.publish(motor);
  if (wanted) {
    motors_[drive].publish(toRos(motor));
  }
}

void StatePublisher::publishEnsembles(const Observer& observer) {
  state::EnsembleState ensemble;
  for (const EnsembleTopic& topic : ensemble_topics_) {
    const bool wanted = topic.publisher.getNumSubscribers() > 0;
    if ((!wanted && !lcm_.on()) || !ensembles_.take(topic.system, observer.instant(), ensemble)) {
      continue;
    }
    lcm_.publish(ensemble);
    if (wanted) {
      topic.publisher.publish(toRos(ensemble));
    }
  }
}

void StatePublisher::publishParameters(const Observer& observer) {
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    Topics& topics = systems_[i];
    const double time = observer.moment(i).time;
    if (observer.generation(i) != topics.generation) {
      topics.generation = observer.generation(i);
      const state::ParameterChange& now = observer.parameters(i);
      // A system made ready for other speeds is a new generation with the same parameters.
      if (topics.parameters_sent.system.empty() || now.values != topics.parameters_sent.values) {
        topics.parameters_sent = now;
        topics.parameters_sent.at = observer.instant();
        topics.parameters.publish(toRos(topics.parameters_sent));
        lcm_.publish(topics.parameters_sent);
        topics.parameters_sent_at = time;
      }
    }
    if (std::fabs(time - topics.parameters_sent_at) >= kParameterPeriod) {
      lcm_.publish(topics.parameters_sent);
      topics.parameters_sent_at = time;
    }
  }
}

std::int64_t StatePublisher::clockTime(const Observer& observer) const {
  return twin_.scene().time + observer.step() * twin_.scene().step;
}

void StatePublisher::publishClock(const Observer& observer) {
  rosgraph_msgs::Clock message;
  message.clock.fromNSec(static_cast<std::uint64_t>(clockTime(observer)));
  clock_.publish(message);
}

void StatePublisher::publishSystem(const Observer& observer, std::size_t system) {
  const Topics& topics = systems_[system];
  const bool state_wanted = topics.state.getNumSubscribers() > 0;
  const bool joints_wanted = topics.joint_states.getNumSubscribers() > 0;
  if (!state_wanted && !joints_wanted && !lcm_.on()) {
    return;
  }
  const auto send = [&](const auto& state) {
    lcm_.publish(state);
    if (state_wanted) {
      topics.state.publish(toRos(state));
    }
    if (joints_wanted) {
      topics.joint_states.publish(toJointState(state));
    }
  };
  if (observer.isRotor(system)) {
    send(observer.whirl(system));
  } else {
    send(observer.pendulum(system));
  }
}

}  // namespace whirl_twin
