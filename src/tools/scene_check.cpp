#include "tools/scene_check.h"

#include <algorithm>
#include <utility>

#include "scene/step_choice.h"
#include "scene/trajectory.h"
#include "tools/step_cost.h"
#include "transport/channels.h"

namespace whirl_twin {

namespace {

constexpr double kWholeBudget = 0.02;   // s, to measure the scene
constexpr double kSystemBudget = 0.01;  // s, to measure one system,
constexpr double kSystemsBudget = 0.5;  // and all of them one by one

SystemCheck checkSystem(const Twin::Member& member) {
  SystemCheck check;
  const std::string& name = member.spec.name;
  check.name = name;
  check.model = member.model;
  check.coordinates = member.dynamics->coordinates();
  check.note = member.setup.note;
  check.integrator = member.integrator;
  check.reason = member.integrator_reason.empty() ? "named in the scene" : member.integrator_reason;
  check.substeps = member.spec.substeps;
  check.drive = member.spec.drive;
  check.speed = member.spec.speed;
  const bool rotor = member.dynamics->isRotor();
  check.topics = {rotor ? PublishedTopic{"/twin/" + name + "/whirl", "whirl_twin/WhirlState"}
                        : PublishedTopic{"/twin/" + name + "/pendulum", "whirl_twin/PendulumState"},
                  {"/twin/" + name + "/joint_states", "sensor_msgs/JointState"},
                  {"/twin/" + name + "/stability", "whirl_twin/StabilityMargin"},
                  {"/twin/" + name + "/parameters", "whirl_twin/ParameterChange"}};
  check.channels = {channelName(rotor ? ChannelKind::kWhirl : ChannelKind::kPendulum, name),
                    channelName(ChannelKind::kStability, name),
                    channelName(ChannelKind::kParameter, name)};
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
  const Twin twin(check.scene);
  const double budget =
      std::min(kSystemBudget, kSystemsBudget / static_cast<double>(twin.members().size()));
  for (std::size_t i = 0; i < twin.members().size(); ++i) {
    check.systems.push_back(checkSystem(twin.members()[i]));
    check.systems.back().step_cost = stepCost(sceneOfOne(check.scene, i), budget);
  }
  check.step_cost = stepCost(check.scene, kWholeBudget);
  check.memory = twinMemory(check.scene);
  check.record = twin.layout().size * sizeof(double);
  return check;
}

}  // namespace whirl_twin
