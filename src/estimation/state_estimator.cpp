#include "estimation/state_estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {

namespace {

constexpr std::int64_t kMaxMotionGap = 1'000'000'000;   // ns, over which a motion is extrapolated
constexpr std::int64_t kTelling = 100'000'000;          // ns, from one FollowState to the next
constexpr std::int64_t kLost = 250'000'000;             // ns, with rejected samples only
constexpr std::int64_t kNewParameters = 1'000'000'000;  // ns, from one generation to the next
constexpr std::int64_t kShaftWait = 1'000'000'000;      // ns, for the first pulses

ShaftInstant instantOf(std::int64_t instant, const ShaftEstimate& at) {
  return {instant, at.angle, at.speed};
}

}  // namespace

const ExtendedKalmanFilter* StateEstimator::filter(std::size_t system) const {
  return systems_[system] ? &systems_[system]->filter : nullptr;
}

const Eigen::VectorXd& StateEstimator::deviationFactors(std::size_t system) const {
  return systems_[system]->robust.factors();
}

std::vector<double> StateEstimator::residualRms(std::size_t system) const {
  const EstimatorTrack& followed = *systems_[system];
  std::vector<double> rms;
  for (std::size_t c = 0; c < followed.squares.size(); ++c) {
    rms.push_back(std::sqrt(followed.squares[c] / static_cast<double>(followed.counts[c])));
  }
  return rms;
}

std::int64_t StateEstimator::machineInstant(std::int64_t step) const {
  return origin_ + step * twin_.scene().step;
}

void StateEstimator::take(const state::Measurement& message) {
  if (!queue_.take(message)) {
    began_ = false;
    ++restarts_;
    ++clock_settings_;
  }
  process();
}

void StateEstimator::finish() {
  queue_.finish();
  process();
  for (const auto& system : systems_) {
    if (system && system->runs) {
      system->endInstant();
      system->endBlock(true);
    }
    if (system && began_) {
      tellState(*system);
    }
  }
}

void StateEstimator::process() {
  while (const std::optional<MeasuredSample> sample = queue_.next()) {
    if (!began_) {
      begin(sample->time);
    }
    if (const auto drive = pulses_[sample->source]) {
      takePulse(*drive, *sample);
      continue;
    }
    stepUntil(sample->time - longest_delay_ - 1);
    takeSample(*sample);
  }
  if (began_) {
    stepUntil(queue_.completeUntil() - longest_delay_);
  }
}

/// Starts, or restarts: the next step is at this instant of the machine.
void StateEstimator::begin(std::int64_t instant) {
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
      std::fill(system->heard.begin(), system->heard.end(), instant);
      system->next_telling = instant;
      system->next_generation = instant + kNewParameters;
    }
  }
}

void StateEstimator::takePulse(std::size_t drive, const MeasuredSample& pulse) {
  if (pulse.valid) {
    shafts_[drive].motion.take(pulse.time);
  }
}

ShaftEstimate StateEstimator::shaftAt(std::size_t drive, std::int64_t instant) {
  Shaft& shaft = shafts_[drive];
  while (shaft.motion.needsPulse(instant)) {
    const MeasuredSample* pulse = queue_.front(*shaft.source);
    if (pulse == nullptr) {
      break;
    }
    takePulse(drive, *pulse);
    queue_.pop(*shaft.source);
  }
  return shaft.motion.at(instant, twin_.scene().time - origin_);
}

void StateEstimator::takeSample(const MeasuredSample& sample) {
  const Channel& channel = channels_[sample.source][sample.channel];
  EstimatorTrack& system = *systems_[channel.system];
  const std::int64_t instant = sample.time - channel.delay;
  state::FollowState& report = system.report;
  const auto set_status = [&](state::ChannelStatus status) {
    report.channel_status[channel.place] = static_cast<std::uint8_t>(status);
  };
  system.heard[channel.place] = sample.time;
  if (!sample.valid) {
    ++report.invalid;
    set_status(state::ChannelStatus::kInvalid);
    return;
  }
  if (channel.input) {
    takeInput(channel, sample);
    set_status(state::ChannelStatus::kUsed);
    return;
  }
  const bool has_shaft = twin_.systems()[channel.system]->dynamics->hasShaft();
  const ShaftEstimate shaft = shaftOf(system, instant);
  report.shaft_known = has_shaft && shaft.known;
  report.shaft_angle_deviation =
      has_shaft && shaft.known ? shaft.deviation : state::FollowState::kNone;
  if (!shaft.known && !system.runs && instant - first_ < kShaftWait) {
    return;
  }
  const ShaftInstant there = instantOf(instant, shaft);
  if (!system.runs || instant - system.at > kMaxMotionGap) {
    restarts_ += system.runs ? 1 : 0;
    system.filter.begin(there, twin_.scene().time - origin_, shaft.deviation);
    system.runs = true;
    system.block_began = instant;
    system.at = instant;
    system.beginMotion(instant);
  }
  if (instant < system.filter.shaft().time) {
    ++system.overtaken;  // newer samples of a channel with less delay came first
    return;
  }
  if (instant != system.at) {
    system.endInstant();
    system.at = instant;
  }
  takeNextInputs(system);
  system.filter.goTo(there, shaft.deviation);
  if (system.beganWrong(instant)) {
    system.filter.forgetMotion();
    system.beginMotion(instant, true);
    ++restarts_;
  }
  const Innovation innovation = system.filter.take(channel.place, sample.value, sample.deviation);
  if (!system.filter.isFinite()) {  // a diverged estimate is useless
    system.filter.startOver();
    system.forgetFactors();
    system.runs = false;
    ++restarts_;
    return;
  }
  report.residual[channel.place] = innovation.value;
  report.residual_deviation[channel.place] = innovation.deviation;
  if (innovation.used) {
    ++report.used;
    set_status(state::ChannelStatus::kUsed);
    if (!system.filter.byProbes()) {  // else they are of a different model
      system.innovations[channel.place] = innovation.normalized();
      system.surest[channel.place] = innovation.normalizedSurest();
    }
    system.last_used = instant;
    if (system.settled(instant)) {
      system.squares[channel.place] += innovation.value * innovation.value;
      ++system.counts[channel.place];
    }
    return;
  }
  ++report.refused;
  set_status(state::ChannelStatus::kRefused);
  if (instant - system.last_used > kLost) {
    // No measurement is consistent with the motion any more: restart the motion.
    system.filter.forgetMotion();
    system.beginMotion(instant);
    ++restarts_;
  }
}

void StateEstimator::takeInput(const Channel& channel, const MeasuredSample& sample) {
  const InputFollowing& input = *channel.input;
  systems_[channel.system]->filter.takeInput(
      channel.place, {sample.time - channel.delay, input.scale * sample.value + input.offset});
}

/// Passes the next sample of each input ahead of its turn, for linear interpolation. It has come,
/// or is no longer waited for.
void StateEstimator::takeNextInputs(EstimatorTrack& system) {
  for (const Input& input : inputs_) {
    const MeasuredSample* next =
        input.system == system.index ? queue_.front(input.source, input.channel) : nullptr;
    if (next != nullptr && next->valid) {
      takeInput(channels_[input.source][input.channel], *next);
    }
  }
}

/// For a system without a shaft: known, zero.
ShaftEstimate StateEstimator::shaftOf(const EstimatorTrack& system, std::int64_t instant) {
  if (twin_.systems()[system.index]->dynamics->hasShaft()) {
    return shaftAt(system.drive, instant);
  }
  ShaftEstimate none;
  none.known = true;
  return none;
}

void StateEstimator::stepUntil(std::int64_t instant) {
  if (instant - machineInstant(next_step_) > kClockJump) {  // set between two samples of a block
    ++restarts_;
    ++clock_settings_;
    begin(instant);
  }
  for (; machineInstant(next_step_) <= instant; ++next_step_) {
    if (next_step_ % every_ == 0) {
      writeRecord(next_step_);
    }
  }
}

double StateEstimator::heldEnergy(const EstimatorTrack& followed) const {
  const auto place = twin_.layout().system(record_.data(), followed.index);
  const auto shaft = RecordLayout::shaft(record_.data(), followed.drive);
  const EvaluationPoint<double> moment{twin_.seconds(RecordLayout::step(record_.data())),
                                       shaft.remainder(), shaft.speed(), shaft.acceleration()};
  const auto n = static_cast<Eigen::Index>(place.dof());
  return followed.model->dynamics
      ->energies(Eigen::Map<const Eigen::VectorXd>(place.q(), n),
                 Eigen::Map<const Eigen::VectorXd>(place.v(), n), moment)
      .jacobi;
}

void StateEstimator::writeRecord(std::int64_t step) {
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
    EstimatorTrack& followed = *system;
    IteratedInitializer& filter = followed.filter;
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
      const bool goes_on = instant > filter.shaft().time && instant - followed.at <= kMaxMotionGap;
      if (goes_on) {
        takeNextInputs(followed);
        const Eigen::VectorXd motion =
            filter.motionAt(instantOf(instant, shaftOf(followed, instant)));
        q = motion.head(n);
        v = motion.tail(n);
      } else {
        q = filter.q();
        v = filter.v();
      }
    }
    // Corrections by measurements are no work of the model: the whole energy change counts as work.
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

void StateEstimator::tellState(EstimatorTrack& system) {
  state::FollowState& report = system.report;
  const std::int64_t step = RecordLayout::step(record_.data());
  const double time = twin_.seconds(step);
  const std::int64_t instant = machineInstant(step);
  report.at = {step, time, 0};
  report.late = system.overtaken;
  report.lost = report.repeated = 0;
  for (std::size_t s = 0; s < channels_.size(); ++s) {
    for (std::size_t c = 0; c < channels_[s].size(); ++c) {
      const Channel& channel = channels_[s][c];
      if (pulses_[s] || channel.system != system.index) {
        continue;
      }
      report.late += queue_.counts(s).late;
      report.lost += queue_.counts(s).lost;
      report.repeated += queue_.counts(s).repeated;
      if (instant - system.heard[channel.place] > kLost) {
        report.channel_status[channel.place] =
            static_cast<std::uint8_t>(state::ChannelStatus::kSilent);
      }
    }
  }
  system.publishKnown(time);
  if (listener_.follow) {
    listener_.follow(report);
  }
}

}  // namespace whirl_twin
