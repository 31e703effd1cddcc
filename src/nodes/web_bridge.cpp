#include "nodes/web_bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "transport/ros_converters.h"
#include "transport/twin_namespace.h"
#include "web/offered_services.h"
#include "web/scene_description.h"

namespace whirl_twin {

namespace {

constexpr double kPicturePeriod = 1.0 / 30.0;    // s
constexpr double kTwinSilence = 3.0;             // s, without a message: loop comes once a second
constexpr std::int64_t kJumpBack = 500'000'000;  // ns, of stamps: played again, or the clock is set

std::int64_t stepsOf(const Scene& scene, double rate) {
  return rate == 0.0 ? 1
                     : std::max<std::int64_t>(1, std::llround(1.0 / (rate * scene.stepSeconds())));
}

}  // namespace

WebBridge::WebBridge(const BuiltScene& scene, const WebBridgeSettings& settings)
    : server_(settings.access, {}, settings.files),
      commands_(server_, settings.simulation, settings.monitor),
      protocol_(server_, commands_, "whirl_twin " + scene.scene.name, settings.read_only,
                offeredServices()),
      channels_(server_, protocol_, twinNamespace()),
      every_(stepsOf(scene.scene, settings.rate)),
      heard_(ros::SteadyTime::now().toSec()) {
  commands_.answerBy(protocol_);
  scene_.refresh();
  addTwinChannels(channels_, scene, StepMessages(scene));
  for (const SharedSystem& system : scene.systems) {
    shown_.try_emplace(system->spec.name, *system->dynamics);
  }
  const Json description = sceneDescription(scene, settings.read_only);
  addParameters(protocol_, description);
  channels_.sendForPage(kSceneTopic, description);
  listener_.onMessage([this](const Message& message) {
    std::visit([this](const auto& state) { take(state); }, message);
  });
  listener_.onParameters([this](const ParameterChange& change) { setParameters(change); });
  listener_.onAlerts([this](const AlertArray& alerts) { channels_.sendAlerts(fromRos(alerts)); });
  channels_.flush();
  server_.start(protocol_);
}

WebBridge::~WebBridge() {
  server_.stop();
}

template <class State>
void WebBridge::take(const State& state) {
  if constexpr (!std::is_same_v<State, state::Alert>) {
    if (!State::kKind.has(MessageKind::kJudged)) {
      heard_ = ros::SteadyTime::now().toSec();
    }
    if constexpr (State::kKind.has(MessageKind::kSeries)) {
      setStamp(state.at.stamp);
    }
    note(state);
    if (!State::kKind.has(MessageKind::kSeries) || isDue(topicOf(state), state.at.step)) {
      channels_.send(state);
    }
    if constexpr (std::is_same_v<State, state::WhirlState> ||
                  std::is_same_v<State, state::PendulumState>) {
      show(state);
    }
  }
}

bool WebBridge::isDue(const std::string& topic, std::int64_t step) {
  const auto [last, is_new] = sent_.try_emplace(topic, step / every_);
  return is_new || std::exchange(last->second, step / every_) != step / every_;
}

void WebBridge::setStamp(std::int64_t stamp) {
  if (stamp + behind_ < channels_.stamp() - kJumpBack) {
    behind_ = channels_.stamp() - stamp;
  }
  channels_.setStamp(std::max(channels_.stamp(), stamp + behind_));
}

void WebBridge::moved(const std::string& system, const state::Instant& at, Shown& shown) {
  if (at.time < shown.motion.at.time) {
    shown.picture.restart();
  }
  shown.motion.at = at;
  if (const auto dynamics = scene_.dynamics(system);
      dynamics && channels_.wanted(pictureTopic(system))) {
    shown.picture.sample(shown.motion, *dynamics);
  }
}

void WebBridge::show(const state::WhirlState& whirl) {
  const auto [known, is_new] = system_of_.try_emplace(whirl.system);
  if (is_new) {
    known->second = scene_.systemOf(whirl.system);
  }
  const std::string& system = known->second;
  const auto found = shown_.find(system);
  if (found == shown_.end()) {
    return;
  }
  Shown& shown = found->second;
  shown.whirls[whirl.system] = whirl;
  if (whirl.system != system) {
    return;
  }
  shown.motion.shaft = {whirl.at.time, whirl.shaft_angle, whirl.speed, 0.0};
  shown.motion.whirl = {whirl.x, whirl.y, whirl.x_rate, whirl.y_rate};
  moved(system, whirl.at, shown);
}

void WebBridge::show(const state::PendulumState& pendulum) {
  const auto found = shown_.find(pendulum.system);
  const auto dynamics = scene_.dynamics(pendulum.system);
  const auto count = static_cast<Eigen::Index>(pendulum.angle.size());
  if (found == shown_.end() || !dynamics || count != dynamics->dof()) {
    return;
  }
  Shown& shown = found->second;
  shown.motion.q = Eigen::Map<const Eigen::VectorXd>(pendulum.angle.data(), count);
  shown.motion.shaft = scene_.shaft(pendulum.system, pendulum.at.time,
                                    listener_.drive(scene_.driveOf(pendulum.system)));
  moved(pendulum.system, pendulum.at, shown);
}

void WebBridge::note(const state::LoopStatistics& loop) {
  for (std::size_t i = 0; i < loop.system.size(); ++i) {
    const auto found = shown_.find(loop.system[i]);
    if (found != shown_.end()) {
      found->second.motion.stopped = loop.stopped_why[i];
    }
  }
}

void WebBridge::setParameters(const ParameterChange& change) {
  if (scene_.take(change)) {
    if (const auto found = shown_.find(change.header.frame_id); found != shown_.end()) {
      found->second.shape.reset();
    }
  }
  std::vector<ParameterValue> values;
  for (std::size_t i = 0; i < change.names.size(); ++i) {
    values.emplace_back(parameterName(change.header.frame_id, change.names[i]), change.values[i]);
  }
  server_.post([this, values] { protocol_.updateParameters(values); });
}

/// The coordinates of a rotor from the whirl at its stations.
void WebBridge::drawRotor(const std::string& system, Shown& shown) const {
  const auto dynamics = scene_.dynamics(system);
  if (!shown.has_shape || shown.whirls.count(system) == 0) {
    return;
  }
  try {
    const std::vector<std::string> names = publishedStations(system, *dynamics);
    if (!shown.shape) {
      std::vector<Station> stations = dynamics->stations();
      stations.erase(std::remove_if(stations.begin() + 1, stations.end(),
                                    [](const Station& station) { return !station.published; }),
                     stations.end());
      shown.shape = std::make_unique<ShapeExpansion>(dynamics->linearRotor(), stations);
    }
    Eigen::VectorXd whirl(2 * static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const state::WhirlState& at = shown.whirls[names[i]];
      whirl.segment<2>(2 * static_cast<Eigen::Index>(i)) << at.x, at.y;
    }
    const state::WhirlState& first = shown.whirls[system];
    shown.motion.q = shown.shape->at(first.shaft_angle, first.speed, whirl);
    shown.has_shape = shown.motion.q.size() == dynamics->dof();
  } catch (const std::logic_error&) {  // not a linear rotor
    shown.has_shape = false;
  }
  if (!shown.has_shape) {
    shown.motion.q.resize(0);
  }
}

void WebBridge::sendPictures() {
  for (auto& [system, shown] : shown_) {
    const auto dynamics = scene_.dynamics(system);
    if (!dynamics || !channels_.wanted(pictureTopic(system))) {
      continue;
    }
    if (dynamics->isRotor() && !dynamics->stations().empty()) {
      drawRotor(system, shown);
    }
    channels_.sendForPage(pictureTopic(system), shown.picture.take(shown.motion, *dynamics));
  }
  server_.post([this, stamp = channels_.stamp()] { protocol_.publishTime(stamp); });
}

std::string WebBridge::silence(double now) const {
  if (now - heard_ > kTwinSilence) {
    return fmt::format("no message from the twin for {:.0f} s", now - heard_);
  }
  return listener_.monitor() ? listener_.monitorSilence() : "no message from a monitor yet";
}

void WebBridge::update(double now) {
  if (now >= next_picture_) {
    sendPictures();
    next_picture_ = now + kPicturePeriod;
  }
  channels_.flush();
}

void WebBridge::discover(double now) {
  listener_.discover();
  channels_.sendServer(silence(now));
}

}  // namespace whirl_twin
