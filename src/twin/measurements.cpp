#include "twin/measurements.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"

namespace whirl_twin {

MeasuredSource::MeasuredSource(const SensorSpec& spec, const BuiltScene& scene,
                               const Observer& observer)
    : spec_(spec),
      systems_(scene.systems),
      start_ns_(scene.scene.time),
      step_ns_(scene.scene.step),
      time_(scene.scene.time + observer.step() * scene.scene.step) {
  message_.source = spec.name;
  if (spec.keyphasor) {
    keyphasor_.emplace(*spec.keyphasor, spec.seed, 0);
    shaft_ = shaft(observer);
    block_end_ = time_ + std::llround(spec.block / kNanosecond);
    message_.channel = {"keyphasor"};
    message_.unit = {"-"};
    message_.deviation = {spec.keyphasor->jitter};
    return;
  }
  instants_.emplace(spec.rate);
  first_ = instants_->firstFrom(time_);
  block_ = std::max<std::int64_t>(1, std::llround(spec.block * spec.rate));
  for (std::size_t i = 0; i < spec.channels.size(); ++i) {
    const SensorChannelSpec& channel = spec.channels[i];
    Channel made{
        channel, std::nullopt, Sensor(channel.sensor, spec.seed, static_cast<std::uint32_t>(i)),
        {},      first_,       {}};
    if (channel.signal.kind == SignalSpec::Kind::kDisplacement) {
      made.station =
          scene.systems[channel.signal.system]->dynamics->places()[channel.signal.station];
    }
    made.last = signal(made, observer);
    made.sensor.start(made.last.value);
    sampleChannel(made, made.last, time_);
    channels_.push_back(std::move(made));
    message_.channel.push_back(channel.name);
    message_.unit.push_back(channel.signal.unit);
    message_.deviation.push_back(
        std::hypot(channel.sensor.noise, channel.sensor.resolution / std::sqrt(12.0)));
  }
  message_.period = instants_->period();
}

MeasuredSource::Point MeasuredSource::signal(const Channel& channel,
                                             const Observer& observer) const {
  const SignalSpec& at = channel.spec.signal;
  if (observer.status(at.system) != StepStatus::kOk) {
    return {kNaN, kNaN};
  }
  const double* q = observer.coordinates(at.system);
  const double* v = observer.rates(at.system);
  const EvaluationPoint<double> moment = observer.moment(at.system);
  if (at.kind == SignalSpec::Kind::kCoordinate) {
    return {q[at.coordinate], v[at.coordinate]};
  }
  const auto vector = [](const double* x, Eigen::Index n) {
    return Eigen::Map<const Eigen::VectorXd>(x, n);
  };
  if (at.kind == SignalSpec::Kind::kRate) {
    const Dynamics& dynamics = *systems_[at.system]->dynamics;
    const Eigen::Index n = dynamics.dof();
    return {v[at.coordinate],
            dynamics.acceleration(vector(q, n), vector(v, n),
                                  moment)[static_cast<Eigen::Index>(at.coordinate)]};
  }
  const double cosine = std::cos(at.direction);  // along y: removes the rounding of a right angle
  const Eigen::VectorXd along =
      (std::fabs(cosine) < 1.0e-16 ? 0.0 : cosine) * channel.station->along_x +
      std::sin(at.direction) * channel.station->along_y;
  const double high_spot = moment.angle + channel.spec.run_out.angle - at.direction;
  const double amplitude = channel.spec.run_out.amplitude;
  return {along.dot(vector(q, along.size())) + amplitude * std::cos(high_spot),
          along.dot(vector(v, along.size())) - amplitude * moment.speed * std::sin(high_spot)};
}

ShaftInstant MeasuredSource::shaft(const Observer& observer) const {
  const state::DriveState drive = observer.drive(spec_.drive);
  return {time_, {drive.turns, drive.remainder}, drive.speed};
}

void MeasuredSource::sampleChannel(Channel& channel, const Point& now, std::int64_t time) {
  const std::int64_t delay = std::llround(channel.spec.sensor.delay / kNanosecond);
  const CubicPiece piece{static_cast<double>(time - time_) * kNanosecond, channel.last.value,
                         now.value, channel.last.rate, now.rate};
  for (; instants_->at(channel.next) - delay <= time; ++channel.next) {
    const std::int64_t shown = instants_->at(channel.next) - delay;
    const double t = shown == time
                         ? piece.length
                         : static_cast<double>(std::max(shown, time_) - time_) * kNanosecond;
    channel.waiting.push_back(
        channel.sensor.sample(channel.sensor.filtered(piece, t), channel.next));
  }
  if (time > time_) {
    channel.sensor.pass(piece);
  }
  channel.last = now;
}

void MeasuredSource::observe(const Observer& observer, std::vector<state::Measurement>& out) {
  const std::int64_t time = start_ns_ + observer.step() * step_ns_;
  if (time <= time_) {
    return;
  }
  for (Channel& channel : channels_) {
    sampleChannel(channel, signal(channel, observer), time);
  }
  time_ = time;
  if (keyphasor_) {
    collectPulses(observer, out);
  } else {
    collectSamples(out);
  }
}

void MeasuredSource::collectSamples(std::vector<state::Measurement>& out) {
  const auto complete = [](const Channel& channel) { return !channel.waiting.empty(); };
  while (std::all_of(channels_.begin(), channels_.end(), complete)) {
    const std::int64_t instant = instants_->at(first_++);
    if (message_.valid.empty()) {
      message_.first_instant = instant;
    }
    if (message_.period == 0) {
      message_.instant.push_back(instant);
    }
    for (Channel& channel : channels_) {
      const Sample sample = channel.waiting.front();
      channel.waiting.pop_front();
      message_.value.push_back(sample.value);
      message_.valid.push_back(sample.valid ? 1 : 0);
    }
    if (static_cast<std::int64_t>(message_.valid.size() / channels_.size()) == block_) {
      send(out);
    }
  }
}

void MeasuredSource::collectPulses(const Observer& observer, std::vector<state::Measurement>& out) {
  const ShaftInstant now = shaft(observer);
  for (const std::int64_t instant : keyphasor_->pulses(shaft_, now)) {
    // Instants must increase: jitter may reorder pulses.
    last_pulse_ = std::max(instant, last_pulse_ + 1);
    message_.instant.push_back(last_pulse_);
    message_.value.push_back(1.0);
    message_.valid.push_back(1);
  }
  shaft_ = now;
  if (time_ >= block_end_) {
    send(out);
    block_end_ += std::llround(spec_.block / kNanosecond);
  }
}

void MeasuredSource::send(std::vector<state::Measurement>& out) {
  if (message_.valid.empty()) {
    return;  // no pulse, of a shaft at standstill
  }
  if (message_.period == 0) {
    message_.first_instant = message_.instant.front();
  }
  message_.samples = static_cast<std::int64_t>(message_.value.size() / message_.channel.size());
  message_.at.time = static_cast<double>(time_) * kNanosecond;
  message_.at.stamp = std::max<std::int64_t>(0, time_);
  out.push_back(message_);
  ++message_.at.step;
  message_.instant.clear();
  message_.value.clear();
  message_.valid.clear();
}

void MeasuredSource::finish(std::vector<state::Measurement>& out) {
  send(out);
}

Measurements::Measurements(const std::vector<SensorSpec>& sensors, const BuiltScene& scene,
                           const Observer& observer) {
  for (const SensorSpec& sensor : sensors) {
    sources_.emplace_back(sensor, scene, observer);
  }
}

std::vector<state::Measurement> Measurements::observe(const Observer& observer) {
  std::vector<state::Measurement> complete;
  for (MeasuredSource& source : sources_) {
    source.observe(observer, complete);
  }
  return complete;
}

std::vector<state::Measurement> Measurements::finish() {
  std::vector<state::Measurement> rest;
  for (MeasuredSource& source : sources_) {
    source.finish(rest);
  }
  return rest;
}

}  // namespace whirl_twin
