#include "estimation/follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr double kNanosecond = 1.0e-9;                  // s
constexpr std::int64_t kLongestGap = 1'000'000'000;     // ns, that a motion is believed through
constexpr std::int64_t kTelling = 100'000'000;          // ns, from one FollowState to the next
constexpr std::int64_t kLost = 250'000'000;             // ns, of nothing but refused samples
constexpr std::int64_t kNewParameters = 1'000'000'000;  // ns, from one generation to the next
constexpr double kPatience = 0.25;                      // s, beside the longest block
constexpr std::int64_t kShaftWait = 1'000'000'000;      // ns, for the first pulses

ShaftInstant instantOf(std::int64_t instant, const ShaftEstimate& at) {
  return {instant, at.angle, at.speed};
}

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds / kNanosecond);
}

/// [s]
double patienceFor(const Scene& scene) {
  double longest = 0.0;
  for (const SensorSpec& sensor : scene.sensors) {
    longest = std::max(longest, sensor.block);
  }
  return kPatience + longest;
}

/// [s]; of the anti-alias filter what it delays by well below its bandwidth.
double delayOf(const SensorSettings& sensor) {
  return sensor.delay +
         (sensor.bandwidth > 0.0 ? 1.0 / (ShaftAngle::kTurn * sensor.bandwidth) : 0.0);
}

double noiseOf(const SensorSettings& sensor) {
  return std::hypot(sensor.noise, sensor.resolution / std::sqrt(12.0));
}

}  // namespace

Follower::Follower(const Twin& twin, std::shared_ptr<SystemGenerations> generations,
                   const FollowSettings& settings, std::int64_t every, FollowerListener listener)
    : twin_(twin),
      generations_(std::move(generations)),
      listener_(std::move(listener)),
      every_(every),
      queue_(settings.patience.value_or(patienceFor(twin.scene()))),
      record_(twin.layout().size) {
  for (std::size_t i = 0; i < twin.driveCount(); ++i) {
    shafts_.push_back({FollowedShaft(twin.drive(i)), std::nullopt});
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

Follower::~Follower() = default;

void Follower::addSensors(const FollowSettings& settings) {
  const Scene& scene = twin_.scene();
  std::map<std::size_t, std::vector<FollowedChannel>> followed;
  for (const SensorSpec& sensor : scene.sensors) {
    std::vector<std::string> names;
    channels_.emplace_back();
    pulses_.emplace_back();
    if (sensor.keyphasor) {
      pulses_.back() = sensor.drive;
      shafts_[sensor.drive].motion.listenTo(*sensor.keyphasor);
      shafts_[sensor.drive].source = queue_.addSource(sensor.name, {"keyphasor"});
      channels_.back().emplace_back();
      continue;
    }
    for (const SensorChannelSpec& c : sensor.channels) {
      const SystemFollowing& of = settings.of(scene.systems[c.signal.system].name);
      FollowedChannel channel;
      channel.name = sensor.name + "/" + c.name;
      channel.signal = c.signal;
      channel.deviation = noiseOf(c.sensor);
      if (!(channel.deviation > 0.0)) {
        throw Refusal(
            fmt::format("{}: sensors.{}.{}: needs noise or resolution: how far it can be trusted",
                        scene.source, sensor.name, c.name));
      }
      const auto offset = of.offset.find(channel.name);
      channel.offset = offset == of.offset.end() ? 0.0 : offset->second;
      channel.run_out = c.signal.kind == SignalSpec::Kind::kDisplacement ? of.run_out : 0.0;
      channels_.back().push_back(
          {c.signal.system, followed[c.signal.system].size(), nanoseconds(delayOf(c.sensor))});
      longest_delay_ = std::max(longest_delay_, channels_.back().back().delay);
      followed[c.signal.system].push_back(channel);
      names.push_back(c.name);
    }
    queue_.addSource(sensor.name, names);
  }
  if (followed.empty()) {
    throw Refusal(scene.source +
                  ": sensors: must name what is measured of a system to be followed");
  }
  for (auto& [system, channels] : followed) {
    const std::size_t drive = twin_.systems()[system]->drive;
    if (drive < twin_.driveCount() && twin_.isMotor(drive)) {
      throw Refusal(
          fmt::format("{}: systems.{}: is turned by a motor, whose torque nobody "
                      "measures: give it a drive, and a keyphasor",
                      scene.source, scene.systems[system].name));
    }
    systems_[system] =
        std::make_unique<FollowedTrack>(twin_, system, settings.of(scene.systems[system].name),
                                        std::move(channels), settings.false_alarms);
  }
}

const SystemFilter* Follower::filter(std::size_t system) const {
  return systems_[system] ? &systems_[system]->filter : nullptr;
}

std::vector<double> Follower::residualRms(std::size_t system) const {
  const FollowedTrack& followed = *systems_[system];
  std::vector<double> rms;
  for (std::size_t c = 0; c < followed.squares.size(); ++c) {
    rms.push_back(std::sqrt(followed.squares[c] / static_cast<double>(followed.counts[c])));
  }
  return rms;
}

std::int64_t Follower::machineInstant(std::int64_t step) const {
  return origin_ + step * twin_.scene().step;
}

void Follower::take(const state::Measurement& message) {
  if (!queue_.take(message)) {
    began_ = false;
    ++restarts_;
    ++clock_settings_;
  }
  process();
}

void Follower::finish() {
  queue_.finish();
  process();
  for (const auto& system : systems_) {
    if (system && system->runs) {
      system->endInstant();
    }
    if (system && began_) {
      tellState(*system);
    }
  }
}

void Follower::process() {
  while (const std::optional<MeasuredSample> sample = queue_.next()) {
    if (!began_) {
      begin(sample->time);
    }
    if (const auto drive = pulses_[sample->source]) {
      shafts_[*drive].motion.take(sample->time);
      continue;
    }
    stepUntil(sample->time - longest_delay_ - 1);
    takeSample(*sample);
  }
  if (began_) {
    stepUntil(queue_.completeUntil() - longest_delay_);
  }
}

/// The twin's next step is the first at or after this instant of the machine.
void Follower::begin(std::int64_t instant) {
  began_ = true;
  first_ = instant;
  origin_ = instant - next_step_ * twin_.scene().step;
  for (Shaft& shaft : shafts_) {
    shaft.motion.restart();
  }
  for (const auto& system : systems_) {
    if (system) {
      system->runs = false;
      system->residuals.restart();
      std::fill(system->heard.begin(), system->heard.end(),
                std::numeric_limits<std::int64_t>::min());
      system->next_telling = instant;
      system->next_generation = instant + kNewParameters;
    }
  }
}

ShaftEstimate Follower::shaftAt(std::size_t drive, std::int64_t instant) {
  Shaft& shaft = shafts_[drive];
  while (shaft.motion.needsPulse(instant)) {
    const MeasuredSample* pulse = queue_.front(*shaft.source);
    if (pulse == nullptr) {
      break;
    }
    shaft.motion.take(pulse->time);
    queue_.pop(*shaft.source);
  }
  return shaft.motion.at(instant, twin_.scene().time - origin_);
}

void Follower::takeSample(const MeasuredSample& sample) {
  const Channel& channel = channels_[sample.source][sample.channel];
  FollowedTrack& system = *systems_[channel.system];
  const std::int64_t instant = sample.time - channel.delay;
  state::FollowState& told = system.told;
  const auto set_status = [&](state::ChannelStatus status) {
    told.channel_status[channel.place] = static_cast<std::uint8_t>(status);
  };
  system.heard[channel.place] = sample.time;
  if (!sample.valid) {
    ++told.invalid;
    set_status(state::ChannelStatus::kInvalid);
    return;
  }
  const bool has_shaft = twin_.systems()[channel.system]->dynamics->hasShaft();
  ShaftEstimate shaft;
  shaft.known = !has_shaft;
  if (has_shaft) {
    shaft = shaftAt(system.drive, instant);
  }
  told.shaft_known = has_shaft && shaft.known;
  told.shaft_angle_deviation =
      has_shaft && shaft.known ? shaft.deviation : state::FollowState::kNone;
  if (!shaft.known && !system.runs && instant - first_ < kShaftWait) {
    return;
  }
  const ShaftInstant there = instantOf(instant, shaft);
  if (!system.runs || instant - system.at > kLongestGap) {
    restarts_ += system.runs ? 1 : 0;
    system.filter.begin(there, twin_.scene().time - origin_, shaft.deviation);
    system.runs = true;
    system.began = instant;
    system.at = instant;
    system.last_used = instant;
    system.residuals.restart();
  }
  if (instant < system.filter.shaft().time) {
    ++system.overtaken;  // by a channel with less delay
    return;
  }
  if (instant != system.at) {
    system.endInstant();
    system.at = instant;
  }
  system.filter.goTo(there, shaft.deviation);
  const Innovation innovation = system.filter.take(channel.place, sample.value);
  told.residual[channel.place] = innovation.value;
  told.residual_deviation[channel.place] = innovation.deviation;
  if (innovation.used) {
    ++told.used;
    set_status(state::ChannelStatus::kUsed);
    if (!system.filter.byProbes()) {  // else they are of another model
      system.innovations[channel.place] = innovation.normalized();
    }
    system.last_used = instant;
    if (system.settled(instant)) {
      system.squares[channel.place] += innovation.value * innovation.value;
      ++system.counts[channel.place];
    }
    return;
  }
  ++told.refused;
  set_status(state::ChannelStatus::kRefused);
  if (instant - system.last_used > kLost) {
    // Nothing agrees with the motion any more: it is the motion that is wrong.
    system.filter.forgetMotion();
    system.began = instant;
    system.last_used = instant;
    system.residuals.restart();
    ++restarts_;
  }
}

void Follower::stepUntil(std::int64_t instant) {
  for (; machineInstant(next_step_) <= instant; ++next_step_) {
    if (next_step_ % every_ == 0) {
      writeRecord(next_step_);
    }
  }
}

double Follower::heldEnergy(const FollowedTrack& followed) const {
  const auto place = twin_.layout().system(record_.data(), followed.index);
  const auto shaft = RecordLayout::shaft(record_.data(), followed.drive);
  const Moment<double> moment{twin_.seconds(RecordLayout::step(record_.data())), shaft.remainder(),
                              shaft.speed(), shaft.acceleration()};
  const auto n = static_cast<Eigen::Index>(place.dof());
  return followed.model->dynamics
      ->energies(Eigen::Map<const Eigen::VectorXd>(place.q(), n),
                 Eigen::Map<const Eigen::VectorXd>(place.v(), n), moment)
      .jacobi;
}

void Follower::writeRecord(std::int64_t step) {
  const std::int64_t instant = machineInstant(step);
  RecordLayout::setStep(record_.data(), step);
  for (std::size_t i = 0; i < shafts_.size(); ++i) {
    const ShaftEstimate at = shaftAt(i, instant);
    const auto place = RecordLayout::shaft(record_.data(), i);
    place.setAngle(at.angle);
    place.setMotion(at.speed, at.acceleration, 0.0, at.speed);
  }
  for (const auto& system : systems_) {
    if (!system) {
      continue;
    }
    FollowedTrack& followed = *system;
    SystemFilter& filter = followed.filter;
    if (followed.runs && filter.model().system() != followed.model &&
        instant >= followed.next_generation) {
      followed.model = filter.model().system();
      followed.forces = bearingForces(*followed.model);
      followed.next_generation = instant + kNewParameters;
      followed.generation = generations_->add(
          followed.index, {followed.model->dynamics, followed.model->parameters()});
    }
    const auto place = twin_.layout().system(record_.data(), followed.index);
    place.setGeneration(followed.generation);
    const auto n = static_cast<Eigen::Index>(place.dof());
    Eigen::Map<Eigen::VectorXd> q(place.q(), n), v(place.v(), n);
    if (followed.runs) {
      const bool goes_on = instant > filter.shaft().time && instant - followed.at <= kLongestGap;
      if (goes_on) {
        const Eigen::VectorXd motion =
            filter.motionAt(instantOf(instant, shaftAt(followed.drive, instant)));
        q = motion.head(n);
        v = motion.tail(n);
      } else {
        q = filter.q();
        v = filter.v();
      }
    }
    // A correction by a measurement is no work of the model: all it has gained counts as work.
    place.motion()[2 * n] = heldEnergy(followed) - followed.first_energy;
  }
  if (listener_.record) {
    listener_.record(record_.data());
  }
  for (const auto& system : systems_) {
    if (system && instant >= system->next_telling) {
      tellState(*system);
      system->next_telling = instant + kTelling;
    }
  }
}

void Follower::tellState(FollowedTrack& system) {
  state::FollowState& told = system.told;
  const std::int64_t step = RecordLayout::step(record_.data());
  const double time = twin_.seconds(step);
  const std::int64_t instant = machineInstant(step);
  told.at = {step, time, 0};
  told.late = system.overtaken;
  told.lost = told.repeated = 0;
  for (std::size_t s = 0; s < channels_.size(); ++s) {
    for (std::size_t c = 0; c < channels_[s].size(); ++c) {
      const Channel& channel = channels_[s][c];
      if (pulses_[s] || channel.system != system.index) {
        continue;
      }
      told.late += queue_.counts(s).late;
      told.lost += queue_.counts(s).lost;
      told.repeated += queue_.counts(s).repeated;
      if (instant - system.heard[channel.place] > kLost) {
        told.channel_status[channel.place] =
            static_cast<std::uint8_t>(state::ChannelStatus::kSilent);
      }
    }
  }
  system.tellWhatIsKnown(time);
  if (listener_.follow) {
    listener_.follow(told);
  }
}

}  // namespace whirl_twin
