#include "twin/control_loop.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "scene/changed_controller.h"
#include "scene/controlled_plant.h"
#include "twin/record.h"

namespace whirl_twin {

namespace {

/// Maximum number of pending outputs.
std::size_t mostUnderWay(const ControllerSpec& spec) {
  return static_cast<std::size_t>(
             std::ceil(static_cast<double>(spec.delay + spec.jitter) * kNanosecond * spec.rate)) +
         2;
}

}  // namespace

RunningController::RunningController(const ControllerSpec& spec, const BuiltScene& built,
                                     std::vector<Inputs>& inputs)
    : law_(lawOf(built.scene, spec)),
      running_(law_.get()),
      external_(dynamic_cast<ExternalController*>(law_.get())),
      lockstep_(external_ != nullptr && external_->rules().lockstep),
      instants_(spec, built.scene.time),
      at_once_(spec.delay == 0),
      filtered_(spec.sensor.bandwidth > 0.0),
      drive_(built.systems[spec.measures.front().system]->drive),
      shown_(spec.measures.size()),
      outputs_(mostUnderWay(spec) * spec.acts_on.size()),
      under_way_(mostUnderWay(spec)),
      now_(spec.measures.size()),
      rates_(spec.measures.size()) {
  for (std::size_t i = 0; i < spec.measures.size(); ++i) {
    const SignalSpec& signal = spec.measures[i];
    const Dynamics& dynamics = *built.systems[signal.system]->dynamics;
    const SignalRow row = rowOf(signal, dynamics);
    channels_.push_back({signal.system,
                         static_cast<std::size_t>(dynamics.dof()),
                         row.of_rates,
                         {row.along.data(), row.along.data() + row.along.size()},
                         Sensor(spec.sensor, spec.seed, static_cast<std::uint32_t>(i))});
    motion_.resize(std::max(motion_.size(), 2 * channels_.back().dof));
  }
  if (lockstep_) {
    external_->keep(under_way_);
  }
  for (const ActedInput& acted : spec.acts_on) {
    acted_.push_back({acted.system, &inputs[acted.system], acted.input,
                      Actuator(spec.actuator, 1.0 / spec.rate)});
  }
}

void RunningController::start(std::int64_t time, const std::vector<Stepper*>& running) noexcept {
  running_ = law_.get();
  running_->reset();
  generation_ = 0;
  instants_.start(time);
  first_ = instants_.sample();
  count_ = {};
  std::fill(outputs_.begin(), outputs_.end(), 0.0);
  for (Acted& acted : acted_) {
    acted.actuator.reset();
    acted.inputs->release(acted.input);
  }
  read(running);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels_[i].value = shown_[i] = now_[i];
    channels_[i].rate = rates_[i];
    channels_[i].sensor.start(now_[i]);
  }
  followed_ = time;
}

void RunningController::exchange(StateImage& image, std::int64_t time) noexcept {
  const std::int64_t own = generation_;
  image(generation_);
  image.requireWithin(generation_, own, own);
  image(instants_, channels_, acted_, followed_, first_, shown_, outputs_, count_);
  image.require(followed_ <= time && first_ <= instants_.sample() && instants_.isAt(time));
  law_->exchange(image);
  if (running_ != law_.get()) {
    running_->exchange(image);
  }
}

/// Derivatives of rates are not available here and left unknown.
void RunningController::read(const std::vector<Stepper*>& running) noexcept {
  std::size_t read = static_cast<std::size_t>(-1);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    if (channel.system != read) {
      read = channel.system;
      running[read]->motion(motion_.data());
    }
    const double* const q = motion_.data();
    const double* const v = q + channel.dof;
    double along_q = 0.0;
    double along_v = 0.0;
    for (std::size_t k = 0; k < channel.dof; ++k) {
      along_q += channel.along[k] * q[k];
      along_v += channel.along[k] * v[k];
    }
    now_[i] = channel.of_rates ? along_v : along_q;
    rates_[i] = along_v;
  }
}

void RunningController::follow(std::int64_t time, const std::vector<Stepper*>& running) noexcept {
  if (!filtered_ || time == followed_) {
    return;
  }
  read(running);
  const double length = static_cast<double>(time - followed_) * kNanosecond;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    const double straight = (now_[i] - channel.value) / length;
    channel.sensor.pass({length, channel.value, now_[i], channel.of_rates ? straight : channel.rate,
                         channel.of_rates ? straight : rates_[i]});
    channel.value = now_[i];
    channel.rate = rates_[i];
  }
  followed_ = time;
}

void RunningController::actAt(std::int64_t time) noexcept {
  while (instants_.outputTime() <= time) {
    if (lockstep_ && instants_.output() >= first_) {
      giveAnswer(external_->answer(instants_.output()), time);
    } else if (!at_once_ && instants_.output() >= first_) {
      const auto place = static_cast<std::size_t>((instants_.output() - first_) %
                                                  static_cast<std::int64_t>(under_way_));
      give(outputs_.data() + place * acted_.size(), time);
    }
    instants_.passOutput();
  }
}

void RunningController::sampleAt(std::int64_t time, double offset,
                                 const std::vector<Stepper*>& running,
                                 const Drive& drive) noexcept {
  if (instants_.sampleTime() > time) {
    return;
  }
  const std::int64_t k = instants_.sample();
  follow(time, running);
  if (!filtered_) {
    read(running);
  }
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Sensor& sensor = channels_[i].sensor;
    shown_[i] = sensor.sample(filtered_ ? sensor.passed() : now_[i], k).value;
  }
  ShaftState turned;
  if (!running[channels_.front().system]->shaft(turned)) {
    const ShaftMotion motion = drive.at(offset);
    turned = {shaftAngle(motion.angle), motion.speed, motion.acceleration};
  }
  const auto place = static_cast<std::size_t>((k - first_) % static_cast<std::int64_t>(under_way_));
  double* const outputs = outputs_.data() + place * acted_.size();
  const bool was_lost = external_ != nullptr && external_->lost();
  running_->update({shown_.data(), k, time, turned.angle, turned.speed}, outputs);
  ++count_.samples;
  if (external_ != nullptr && external_->givesNothing() && !was_lost) {
    giveNothing(time);
  }
  if (!lockstep_ && !isNumber(outputs)) {
    ++count_.missed;
    for (std::size_t i = 0; i < acted_.size(); ++i) {
      outputs[i] = acted_[i].actuator.value();
    }
  }
  if (at_once_) {
    give(outputs, time);
  }
  instants_.passSample();
}

std::unique_ptr<Controller> RunningController::replace(std::unique_ptr<Controller> next,
                                                       std::int64_t generation) noexcept {
  next->takeOver(*running_);
  running_ = next.get();
  generation_ = generation;
  replacement_.swap(next);
  return next;
}

bool RunningController::isNumber(const double* outputs) const noexcept {
  return std::all_of(outputs, outputs + acted_.size(), [](double u) { return std::isfinite(u); });
}

/// nullptr: no answer yet, the last output is held.
void RunningController::giveAnswer(const double* outputs, std::int64_t time) noexcept {
  if (outputs == nullptr) {
    return;
  }
  if (isNumber(outputs)) {
    give(outputs, time);
  } else {
    ++count_.missed;
  }
}

/// Zero output, also for pending ones.
void RunningController::giveNothing(std::int64_t time) noexcept {
  std::fill(outputs_.begin(), outputs_.end(), 0.0);
  give(outputs_.data(), time);
}

bool RunningController::mayGoOn(std::int64_t until, std::int64_t elapsed) noexcept {
  if (!lockstep_) {
    return true;
  }
  external_->listen();
  bool awaited = false;
  for (ControlInstants ahead = instants_; ahead.outputTime() < until; ahead.passOutput()) {
    awaited = awaited || (ahead.output() >= first_ && external_->isAwaited(ahead.output()));
  }
  if (!awaited) {
    external_->waitsNoMore();
    return true;
  }
  if (!external_->waitsTooLong(elapsed)) {
    return false;
  }
  if (external_->givesNothing()) {
    giveNothing(acted_.front().inputs->begun());
  }
  return true;
}

void RunningController::stop(std::vector<StepStatus>& status) const noexcept {
  if (external_ == nullptr || !external_->stops()) {
    return;
  }
  for (const Acted& acted : acted_) {
    if (status[acted.system] == StepStatus::kOk) {
      status[acted.system] = StepStatus::kControllerLost;
    }
  }
}

void RunningController::give(const double* outputs, std::int64_t time) noexcept {
  bool all = true;
  for (std::size_t i = 0; i < acted_.size(); ++i) {
    Acted& acted = acted_[i];
    all = acted.actuator.take(outputs[i]) && all;
    acted.inputs->control(acted.input, acted.actuator.value(), time);
  }
  count_.saturated += all ? 0 : 1;
}

ControlLoop::ControlLoop(const BuiltScene& built, std::vector<Inputs>& inputs) {
  for (const ControllerSpec& spec : built.scene.controllers) {
    controllers_.emplace_back(spec, built, inputs);
  }
  for (std::size_t i = 0; i < built.systems.size(); ++i) {
    controlled_.push_back(isControlled(built.scene, i) ? 1 : 0);
  }
}

void ControlLoop::start(std::int64_t time, const std::vector<Stepper*>& running) noexcept {
  for (RunningController& controller : controllers_) {
    controller.start(time, running);
  }
}

void ControlLoop::stop(std::vector<StepStatus>& status) const noexcept {
  for (const RunningController& controller : controllers_) {
    controller.stop(status);
  }
}

std::int64_t ControlLoop::nextInstant() const noexcept {
  std::int64_t next = ControlInstants::kNever;
  for (const RunningController& controller : controllers_) {
    next = std::min(next, controller.nextInstant());
  }
  return next;
}

void ControlLoop::act(std::int64_t time, double offset, const std::vector<Stepper*>& running,
                      const std::vector<Drive>& drives) noexcept {
  for (RunningController& controller : controllers_) {
    controller.actAt(time);
  }
  for (RunningController& controller : controllers_) {
    controller.sampleAt(time, offset, running, drives[controller.drive()]);
  }
}

bool ControlLoop::mayGoOn(std::int64_t until, std::int64_t elapsed) noexcept {
  bool may = true;
  for (RunningController& controller : controllers_) {
    may = controller.mayGoOn(until, elapsed) && may;
  }
  return may;
}

void ControlLoop::follow(std::int64_t time, const std::vector<Stepper*>& running) noexcept {
  for (RunningController& controller : controllers_) {
    controller.follow(time, running);
  }
}

}  // namespace whirl_twin
