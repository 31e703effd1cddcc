// Set-up of a state estimator: the sensors of its scene, and the measured systems.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algebra/constants.h"
#include "estimation/state_estimator.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kPatience = 0.25;  // s, in addition to the longest block

std::int64_t durationInNanoseconds(double seconds) {
  return std::llround(seconds / kNanosecond);
}

/// Reordering delay [s].
double patienceFor(const Scene& scene) {
  double longest = 0.0;
  for (const SensorSpec& sensor : scene.sensors) {
    longest = std::max(longest, sensor.block);
  }
  return kPatience + longest;
}

}  // namespace

StateEstimator::StateEstimator(const Twin& twin, std::shared_ptr<SystemGenerations> generations,
                               const FollowSettings& settings, std::int64_t every,
                               EstimatorListener listener)
    : twin_(twin),
      generations_(std::move(generations)),
      listener_(std::move(listener)),
      every_(every),
      queue_(settings.patience.value_or(patienceFor(twin.scene()))),
      record_(twin.layout().size) {
  for (std::size_t i = 0; i < twin.driveCount(); ++i) {
    shafts_.push_back({EstimatorShaft(twin.drive(i)), std::nullopt});
  }
  systems_.resize(twin.systems().size());
  addSensors(settings);
  twin.write(record_.data());
  RecordLayout::setScheduled(record_.data(), 0);
  for (const auto& system : systems_) {
    if (system) {
      system->first_energy = heldEnergy(*system);
    }
  }
}

StateEstimator::~StateEstimator() = default;

void StateEstimator::addSensors(const FollowSettings& settings) {
  const Scene& scene = twin_.scene();
  std::map<std::size_t, std::vector<EstimatorChannel>> followed;
  for (const EstimatorSource& source : estimatorSources(scene, settings)) {
    channels_.emplace_back();
    pulses_.emplace_back();
    if (source.keyphasor) {
      pulses_.back() = source.drive;
      shafts_[source.drive].motion.listenTo(*source.keyphasor);
      shafts_[source.drive].source = queue_.addSource(source.name, {"keyphasor"}, {""});
      channels_.back().emplace_back();
      continue;
    }
    const std::size_t number = queue_.addSource(source.name, source.names(), source.units());
    for (const EstimatorSource::Channel& c : source.channels) {
      const SystemFollowing& of = settings.of(scene.systems[c.system].name);
      std::vector<EstimatorChannel>& channels = followed[c.system];
      EstimatorChannel channel;
      channel.name = source.name + "/" + c.name;
      channel.signal = c.signal;
      channel.signal.unit = c.unit;
      channel.deviation = c.deviation;
      channel.input = c.input;
      if (!c.input && !(channel.deviation > 0.0)) {
        throw InputError(
            fmt::format("{}: sensors.{}.{}: needs noise or resolution (its uncertainty)",
                        scene.source, source.name, c.name));
      }
      const auto offset = of.offset.find(channel.name);
      channel.offset = offset == of.offset.end() ? 0.0 : offset->second;
      const bool displacement = !c.input && c.signal.kind == SignalSpec::Kind::kDisplacement;
      channel.run_out = displacement ? of.run_out : 0.0;
      if (c.input) {
        inputs_.push_back({c.system, number, channels_.back().size()});
      }
      channels_.back().push_back(
          {c.system, channels.size(), durationInNanoseconds(c.delay), c.input});
      longest_delay_ = std::max(longest_delay_, channels_.back().back().delay);
      channels.push_back(channel);
    }
  }
  for (auto& [system, channels] : followed) {
    const std::string& name = scene.systems[system].name;
    const std::size_t drive = twin_.systems()[system]->drive;
    if (drive < twin_.driveCount() && twin_.isMotor(drive)) {
      throw InputError(
          fmt::format("{}: systems.{}: the torque of its motor is not measured: give its shaft a "
                      "keyphasor or another drive",
                      scene.source, name));
    }
    if (std::all_of(channels.begin(), channels.end(),
                    [](const EstimatorChannel& c) { return c.input.has_value(); })) {
      throw InputError(
          fmt::format("{}: sensors: must measure the motion of {}, whose inputs are measured",
                      scene.source, name));
    }
    systems_[system] = std::make_unique<EstimatorTrack>(twin_, system, settings.of(name),
                                                        std::move(channels), settings.false_alarms);
  }
  if (followed.empty()) {
    throw InputError(
        scene.source +
        ": sensors: must measure the motion of at least one system, found none (a keyphasor "
        "alone is not enough)");
  }
}

}  // namespace whirl_twin
