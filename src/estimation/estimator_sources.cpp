#include "estimation/estimator_sources.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "control/shaft_angle.h"

namespace whirl_twin {

namespace {

/// Samples further apart are not interpolated: the first of them is held.
constexpr double kMaxLine = 0.25;  // s

double secondsBetween(std::int64_t from, std::int64_t to) {
  return 1.0e-9 * static_cast<double>(to - from);
}

}  // namespace

void EstimatorInput::take(const InputSample& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) {
    return;
  }
  spacing_ = samples_.empty() ? 0.0 : secondsBetween(samples_.back().time, sample.time);
  samples_.push_back(sample);
}

void EstimatorInput::forgetBefore(std::int64_t instant) {
  while (samples_.size() > 1 && samples_[1].time <= instant) {
    samples_.pop_front();
  }
}

double EstimatorInput::at(std::int64_t instant, double offset) const {
  const auto next = std::find_if(
      std::next(samples_.begin()), samples_.end(),
      [&](const InputSample& sample) { return secondsBetween(instant, sample.time) > offset; });
  const InputSample& last = *std::prev(next);
  if (hold_ || next == samples_.end()) {
    return last.value;
  }
  const double length = secondsBetween(last.time, next->time);
  const double part = std::max(0.0, (secondsBetween(last.time, instant) + offset) / length);
  return length > kMaxLine ? last.value : last.value + part * (next->value - last.value);
}

void EstimatorInput::addCorners(std::int64_t from, std::int64_t to,
                                std::vector<std::int64_t>& corners) const {
  for (const InputSample& sample : samples_) {
    if (sample.time > from && sample.time < to) {
      corners.push_back(sample.time);
    }
  }
}

namespace {

/// [s], including the low-frequency delay of the anti-alias filter.
double delayOf(const SensorSettings& sensor) {
  return sensor.delay +
         (sensor.bandwidth > 0.0 ? 1.0 / (ShaftAngle::kTurn * sensor.bandwidth) : 0.0);
}

double noiseOf(const SensorSettings& sensor) {
  return std::hypot(sensor.noise, sensor.resolution / std::sqrt(12.0));
}

void addInput(const InputFollowing& input, std::size_t system, std::vector<EstimatorSource>& all) {
  auto source = std::find_if(all.begin(), all.end(),
                             [&](const EstimatorSource& s) { return s.name == input.source; });
  if (source == all.end()) {
    EstimatorSource further;
    further.name = input.source;
    source = all.insert(all.end(), further);
  }
  EstimatorSource::Channel channel;
  channel.name = input.channel;
  channel.unit = input.unit;
  channel.deviation = input.deviation;
  channel.system = system;
  channel.input = input;
  source->channels.push_back(channel);
}

}  // namespace

std::vector<std::string> EstimatorSource::names() const {
  std::vector<std::string> all;
  for (const Channel& channel : channels) {
    all.push_back(channel.name);
  }
  return all;
}

std::vector<std::string> EstimatorSource::units() const {
  std::vector<std::string> all;
  for (const Channel& channel : channels) {
    all.push_back(channel.unit);
  }
  return all;
}

std::vector<EstimatorSource> estimatorSources(const Scene& scene, const FollowSettings& settings) {
  std::vector<EstimatorSource> all;
  for (const SensorSpec& sensor : scene.sensors) {
    EstimatorSource source;
    source.name = sensor.name;
    source.keyphasor = sensor.keyphasor;
    source.drive = sensor.drive;
    for (const SensorChannelSpec& c : sensor.channels) {
      source.channels.push_back({c.name, c.signal.unit, noiseOf(c.sensor), delayOf(c.sensor),
                                 c.signal.system, c.signal, std::nullopt});
    }
    all.push_back(source);
  }
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    for (const InputFollowing& input : settings.of(scene.systems[i].name).inputs) {
      addInput(input, i, all);
    }
  }
  return all;
}

}  // namespace whirl_twin
