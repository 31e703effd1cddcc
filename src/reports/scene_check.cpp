#include "reports/scene_check.h"

#include <algorithm>
#include <utility>

#include "accuracy/step_choice.h"
#include "accuracy/trajectory.h"
#include "reports/step_cost.h"
#include "transport/channels.h"

namespace whirl_twin {

namespace {

constexpr double kWholeBudget = 0.02;   // s, to measure the scene
constexpr double kSystemBudget = 0.01;  // s, to measure one system,
constexpr double kSystemsBudget = 0.5;  // and all of them one by one

SystemCheck checkSystem(const BuiltSystem& system) {
  SystemCheck check;
  const std::string& name = system.spec.name;
  check.name = name;
  check.model = system.model;
  check.coordinates = system.dynamics->coordinates();
  check.note = system.setup().note;
  check.integrator = system.integrator;
  check.reason = system.integrator_reason.empty() ? "named in the scene" : system.integrator_reason;
  check.substeps = system.spec.substeps;
  check.drive = system.spec.drive;
  check.speed = system.spec.speed;
  const bool rotor = system.dynamics->isRotor();
  check.topics = {rotor ? PublishedTopic{"/twin/" + name + "/whirl", "whirl_twin/WhirlState"}
                        : PublishedTopic{"/twin/" + name + "/pendulum", "whirl_twin/PendulumState"},
                  {"/twin/" + name + "/joint_states", "sensor_msgs/JointState"},
                  {"/twin/" + name + "/stability", "whirl_twin/StabilityMargin"},
                  {"/twin/" + name + "/parameters", "whirl_twin/ParameterChange"}};
  check.channels = {channelName(rotor ? ChannelKind::kWhirl : ChannelKind::kPendulum, name),
                    channelName(ChannelKind::kStability, name),
                    channelName(ChannelKind::kParameter, name)};
  if (system.spec.ensemble.count > 0) {
    check.topics.push_back({"/twin/" + name + "/ensemble", "whirl_twin/EnsembleState"});
    check.channels.push_back(channelName(ChannelKind::kEnsemble, name));
  }
  return check;
}

}  // namespace

std::vector<PublishedTopic> driveTopics(const DriveSpec& drive) {
  std::vector<PublishedTopic> topics{{"/twin/drives/" + drive.name, "whirl_twin/DriveState"}};
  if (drive.motor) {
    topics.push_back({"/twin/drives/" + drive.name + "/motor", "whirl_twin/MotorState"});
  }
  return topics;
}

std::vector<std::string> driveChannels(const DriveSpec& drive) {
  std::vector<std::string> channels{channelName(ChannelKind::kDrive, drive.name)};
  if (drive.motor) {
    channels.push_back(channelName(ChannelKind::kMotor, drive.name));
  }
  return channels;
}

SceneCheck checkScene(const Scene& scene, const std::vector<std::size_t>& systems) {
  SceneCheck check;
  check.scene = scene;
  check.scene.systems.clear();
  for (const std::size_t i : systems) {
    check.scene.systems.push_back(scene.systems[i]);
  }
  check.scene = withStepsChosen(check.scene);
  const BuiltScene built = build(check.scene);
  const double budget =
      std::min(kSystemBudget, kSystemsBudget / static_cast<double>(built.systems.size()));
  for (std::size_t i = 0; i < built.systems.size(); ++i) {
    check.systems.push_back(checkSystem(*built.systems[i]));
    SystemCheck& system = check.systems.back();
    const RunningCost cost = runningCost(sceneOfOne(check.scene, i), budget);
    system.step_cost = cost.step;
    system.memory = cost.memory;
    system.ensemble = cost.ensembles.front();
  }
  if (check.systems.size() == 1) {
    check.step_cost = check.systems[0].step_cost;
    check.memory = check.systems[0].memory;
  } else {
    const RunningCost cost = runningCost(check.scene, kWholeBudget);
    check.step_cost = cost.step;
    check.memory = cost.memory;
  }
  check.record = layoutOf(built).size * sizeof(double);
  return check;
}

}  // namespace whirl_twin
