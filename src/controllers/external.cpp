#include "controllers/external.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "controllers/controllers.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kCapacity = 1024;  // maximum number of waiting samples, or commands

}  // namespace

ExternalLink::ExternalLink(std::size_t measured, std::size_t outputs)
    : sent_(kValues + measured, kCapacity),
      received_(kValues + outputs, kCapacity),
      sending_(sent_.recordSize()),
      hearing_(received_.recordSize()),
      receiving_(sent_.recordSize()),
      answering_(received_.recordSize()) {}

void ExternalLink::tell(std::int64_t run, std::int64_t sample, double time,
                        const double* values) noexcept {
  sending_[kRun] = static_cast<double>(run);
  sending_[kSample] = static_cast<double>(sample);
  sending_[kTime] = time;
  std::copy_n(values, measured(), sending_.begin() + kValues);
  sent_.push(sending_.data());
}

bool ExternalLink::pop(RecordRing& ring, std::vector<double>& record,
                       ExternalSample& out) noexcept {
  if (!ring.pop(record.data())) {
    return false;
  }
  out.run = static_cast<std::int64_t>(record[kRun]);
  out.sample = static_cast<std::int64_t>(record[kSample]);
  out.time = record[kTime];
  std::copy(record.begin() + kValues, record.end(), out.values.begin());
  return true;
}

bool ExternalLink::hear(ExternalSample& command) noexcept {
  return pop(received_, hearing_, command);
}

bool ExternalLink::take(ExternalSample& sample) {
  sample.values.resize(measured());
  return pop(sent_, receiving_, sample);
}

bool ExternalLink::answer(const ExternalSample& command) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;  // whole numbers in a double
  if (command.values.size() != outputs() || command.sample > kMost || command.sample < -kMost ||
      command.run > kMost || command.run < 0) {
    return false;
  }
  answering_[kRun] = static_cast<double>(command.run);
  answering_[kSample] = static_cast<double>(command.sample);
  answering_[kTime] = command.time;
  std::copy(command.values.begin(), command.values.end(), answering_.begin() + kValues);
  return received_.push(answering_.data());
}

ExternalController::ExternalController(const Rules& rules, std::size_t measured,
                                       std::size_t outputs)
    : rules_(rules),
      link_(std::make_unique<ExternalLink>(measured, outputs)),
      newest_(outputs),
      answers_(outputs),
      answered_(1, kNone) {
  command_.values.resize(outputs);
}

void ExternalController::keep(std::size_t samples) {
  answers_.assign(samples * newest_.size(), 0.0);
  answered_.assign(samples, kNone);
}

/// The other process is not reset: in lockstep already the first sample waits for it.
void ExternalController::reset() noexcept {
  ++run_;
  sent_ = received_ = kNone;
  ages_.reset();
  std::fill(newest_.begin(), newest_.end(), 0.0);
  std::fill(answered_.begin(), answered_.end(), kNone);
  awaited_from_ = connected_ ? kNone + 1 : kNone;
  waiting_ = false;
}

void ExternalController::exchange(StateImage& image) noexcept {
  image(newest_, answers_, answered_, run_, sent_, heard_at_);
  if (image.puts()) {
    ++run_;
    received_ = awaited_from_ = kNone;
    connected_ = lost_ = waiting_ = false;
  }
}

/// False for a command that answers no sample of this run.
bool ExternalController::take(const ExternalSample& command) noexcept {
  if ((command.run != 0 && command.run != run_) || command.sample > sent_) {
    return false;
  }
  received_ = std::max(received_, command.sample);
  connected_ = true;
  lost_ = false;
  return true;
}

void ExternalController::update(const ControlSample& sample, double* outputs) noexcept {
  sent_ = sample.index;
  link_->tell(run_, sample.index, static_cast<double>(sample.time) / 1e9, sample.values);
  if (!rules_.lockstep) {
    giveNewest(sample.time, outputs);
  }
  if (received_ != kNone) {
    ages_.add(age());
  }
}

void ExternalController::giveNewest(std::int64_t time, double* outputs) noexcept {
  while (link_->hear(command_)) {
    const std::int64_t before = received_;
    if (take(command_) && command_.sample >= before) {
      std::copy(command_.values.begin(), command_.values.end(), newest_.begin());
      heard_at_ = time;
    }
  }
  // No time-out before the first connection.
  if (connected_ && received_ == kNone && time < heard_at_) {
    heard_at_ = time;  // after a reset
  }
  if (connected_ && time - heard_at_ >= rules_.timeout) {
    connected_ = false;
    lost_ = true;
    if (givesNothing()) {
      std::fill(newest_.begin(), newest_.end(), 0.0);
    }
  }
  std::copy(newest_.begin(), newest_.end(), outputs);
}

void ExternalController::listen() noexcept {
  while (link_->hear(command_)) {
    const bool restarted = !connected_;
    if (!take(command_)) {
      continue;
    }
    if (restarted) {
      awaited_from_ = command_.sample;
    }
    const std::size_t place = placeOf(command_.sample);
    if (command_.sample >= answered_[place]) {
      answered_[place] = command_.sample;
      std::copy(command_.values.begin(), command_.values.end(),
                answers_.begin() + static_cast<std::ptrdiff_t>(place * newest_.size()));
    }
  }
}

const double* ExternalController::answer(std::int64_t sample) const noexcept {
  const std::size_t place = placeOf(sample);
  return answered_[place] == sample ? answers_.data() + place * newest_.size() : nullptr;
}

bool ExternalController::isAwaited(std::int64_t sample) const noexcept {
  return awaited_from_ != kNone && sample >= awaited_from_ && answer(sample) == nullptr;
}

bool ExternalController::waitsTooLong(std::int64_t elapsed) noexcept {
  waited_ = waiting_ ? waited_ + elapsed : 0;
  waiting_ = true;
  if (waited_ < rules_.timeout) {
    return false;
  }
  waiting_ = connected_ = false;
  awaited_from_ = kNone;
  lost_ = true;
  return true;
}

namespace {

std::unique_ptr<Controller> makeExternal(const ParameterValues& values, const Settings& settings,
                                         const ControllerPlan& plan) {
  ExternalController::Rules rules;
  rules.lockstep = settings.choices.at("mode") == "lockstep";
  rules.timeout = std::llround(values.at("timeout") * 1e9);
  const std::string& then = settings.choices.at("on_timeout");
  rules.on_timeout = then == "zero"   ? ExternalController::OnTimeout::kZero
                     : then == "stop" ? ExternalController::OnTimeout::kStop
                                      : ExternalController::OnTimeout::kHold;
  return std::make_unique<ExternalController>(rules, plan.measured, plan.outputs);
}

}  // namespace

ControllerInfo externalInfo() {
  ControllerInfo info;
  info.name = "external";
  info.summary = "in another process, by ROS or LCM: acts only live";
  info.parameters = {
      {"timeout", "s", Range::kPositive,
       "without an answer before on_timeout applies: wall time in lockstep, else simulated time",
       std::nullopt, ""}};
  SettingInfo mode{"mode", SettingKind::kChoice, "",
                   "simulated time waits for each answer, or the newest command acts"};
  mode.choices = {"lockstep", "free_running"};
  SettingInfo on_timeout{
      "on_timeout", SettingKind::kChoice, "",
      "without an answer: keep the last output, output 0, or stop the systems that it acts on"};
  on_timeout.choices = {"hold", "zero", "stop"};
  info.settings = {mode, on_timeout};
  info.make = makeExternal;
  return info;
}

}  // namespace whirl_twin
