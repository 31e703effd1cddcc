#include "twin/twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "messages/checksum.h"
#include "messages/input_error.h"
#include "scene/scene_error.h"

namespace whirl_twin {

Twin::Twin(const Scene& scene) : Twin(build(scene)) {}

Twin::Twin(BuiltScene built)
    : built_(std::move(built)),
      drives_(built_.drives()),
      turned_by_(drives_.size(), kNoSystem),
      replacements_(systems().size()),
      running_(systems().size()),
      generation_(systems().size()),
      ensembles_(systems().size()),
      status_(systems().size()),
      layout_(layoutOf(built_)) {
  for (const SharedSystem& system : systems()) {
    inputs_.push_back(built_.inputsOf(*system));
  }
  for (Inputs& inputs : inputs_) {
    if (inputs.count() > 0) {
      begun_inputs_.push_back(&inputs);
      accompanied_ = true;
    }
  }
  control_ = ControlLoop(built_, inputs_);
  for (std::size_t i = 0; i < systems().size(); ++i) {
    const BuiltSystem& system = *systems()[i];
    if (system.drive < scene().drives.size() && scene().drives[system.drive].motor) {
      turned_by_[system.drive] = i;
    }
    try {
      steppers_.push_back(stepperOf(system));
    } catch (const RunFailure& error) {
      throw SceneError(
          {fmt::format("{}: systems.{}: {}", scene().source, system.spec.name, error.what())});
    }
    state_.resize(std::max(state_.size(), SystemView::motionSize(steppers_.back()->dof())));
  }
  reset();
}

RecordLayout layoutOf(const BuiltScene& scene) {
  std::vector<std::size_t> dofs;
  for (const SharedSystem& system : scene.systems) {
    dofs.push_back(system->spec.q.size());
  }
  std::vector<ControllerSize> controllers;
  for (const ControllerSpec& controller : scene.scene.controllers) {
    controllers.push_back({controller.measures.size(), controller.acts_on.size()});
  }
  return {scene.drives().size(), dofs, controllers};
}

void Twin::buildEnsembles() {
  stepped_ensembles_.clear();
  stepped_of_.clear();
  for (std::size_t i = 0; i < systems().size(); ++i) {
    const BuiltSystem& system = *systems()[i];
    if (system.spec.ensemble.count == 0) {
      continue;
    }
    const auto refused = [&](const std::exception& error) {
      return SceneError({fmt::format("{}: systems.{}.spread: {}", scene().source, system.spec.name,
                                     error.what())});
    };
    try {
      ensembles_[i] = std::make_unique<Ensemble>(scene(), system,
                                                 StepContext(drives_[system.drive], &inputs_[i]));
    } catch (const InputError& error) {
      throw refused(error);
    } catch (const RunFailure& error) {  // its steps cannot be prepared
      throw refused(error);
    }
    stepped_ensembles_.push_back(ensembles_[i].get());
    stepped_of_.push_back(i);
    accompanied_ = true;
  }
  reset();
}

std::unique_ptr<Stepper> Twin::stepperOf(const BuiltSystem& system) const {
  const auto place =
      std::find_if(systems().begin(), systems().end(),
                   [&](const SharedSystem& known) { return known->spec.name == system.spec.name; });
  const Inputs& inputs = inputs_.at(static_cast<std::size_t>(place - systems().begin()));
  return system.setup().system(system.integrator, {drives_[system.drive], &inputs},
                               scene().stepSeconds(), system.spec.substeps);
}

double Twin::seconds(std::int64_t steps) const noexcept {
  return static_cast<double>(scene().time + steps * scene().step) / 1.0e9;
}

// A rotor's own step is so short that the code around it counts: optional parts of a scene are kept
// out of line.
void Twin::step() noexcept {
  stepMarked(NoMarks{});
}

std::int64_t Twin::steps(std::int64_t count) noexcept {
  std::int64_t taken = 0;
  bool all_went_on = true;
  do {
    all_went_on = stepMarked(NoMarks{});
    ++taken;
  } while (taken < count && all_went_on);
  return taken;
}

[[gnu::noinline]] void Twin::step(StepTimes& times) noexcept {
  times.beginStep();
  stepMarked(TimingMarks{times});
  times.endStep();
}

/// True if every system that was running completed the step.
template <class Marks>
inline bool Twin::stepMarked(const Marks& marks) noexcept {
  const double time = this->time();
  if (__builtin_expect(control_.any(), 0)) {
    return stepControlled(time, marks);
  }
  bool all_went_on = true;
  Stepper* const* const running = running_.data();
  StepStatus* const status = status_.data();
  for (std::size_t i = 0, count = running_.size(); i < count; ++i) {
    if (status[i] == StepStatus::kOk) {
      status[i] = running[i]->step(time);
      all_went_on = all_went_on && status[i] == StepStatus::kOk;
    }
    marks(i);
  }
  if (accompanied_) {
    advanceAccompanied(time, marks);
  } else {
    ++steps_;
    beginDrives();
  }
  return all_went_on;
}

/// From sample instant to sample instant for controlled systems; in one step for the others.
template <class Marks>
[[gnu::noinline]] bool Twin::stepControlled(double time, const Marks& marks) noexcept {
  const auto running = [this] {
    return std::count(status_.begin(), status_.end(), StepStatus::kOk);
  };
  const auto before = running();
  control_.stop(status_);
  const std::int64_t start = now();
  const std::int64_t length = scene().step;
  for (std::int64_t from = 0; from < length;) {
    control_.act(start + from, static_cast<double>(from) / 1e9, running_, drives_);
    const std::int64_t to = std::min(control_.nextInstant() - start, length);
    marks(running_.size());
    const bool whole = from == 0 && to == length;
    for (std::size_t i = 0; i < running_.size(); ++i) {
      if (status_[i] == StepStatus::kOk && (from == 0 || control_.controls(i))) {
        status_[i] = whole || !control_.controls(i) ? running_[i]->step(time)
                                                    : running_[i]->stepPart(time, from, to);
      }
      marks(i);
    }
    control_.follow(start + to, running_);
    marks(running_.size());
    from = to;
  }
  advanceAccompanied(time, marks);
  return running() == before;
}

template <class Marks>
void Twin::advanceAccompanied(double time, const Marks& marks) noexcept {
  for (std::size_t k = 0; k < stepped_ensembles_.size(); ++k) {
    stepped_ensembles_[k]->step(time);
    marks(stepped_of_[k]);
  }
  ++steps_;
  beginStep();
  for (Ensemble* const ensemble : stepped_ensembles_) {
    ensemble->publish(steps_);
  }
}

void Twin::beginStep() noexcept {
  beginDrives();
  for (Inputs* const inputs : begun_inputs_) {
    inputs->begin(now());
  }
}

inline void Twin::beginDrives() noexcept {
  const std::int64_t time = now();
  Drive* drive = drives_.data();
  for (Drive* const end = drive + drives_.size(); drive != end; ++drive) {
    drive->begin(time);
  }
}

void Twin::reset() noexcept {
  steps_ = 0;
  for (Drive& drive : drives_) {
    drive.reset();
  }
  for (Inputs& inputs : inputs_) {
    inputs.reset();
  }
  beginStep();
  for (std::size_t i = 0; i < steppers_.size(); ++i) {
    running_[i] = steppers_[i].get();
    generation_[i] = 0;
    running_[i]->set(systems()[i]->spec.q.data(), systems()[i]->spec.v.data());
    status_[i] = StepStatus::kOk;
    if (ensembles_[i]) {
      ensembles_[i]->reset();
      ensembles_[i]->publish(0);
    }
  }
  control_.start(now(), running_);
}

void Twin::exchange(StateImage& image) noexcept {
  image(steps_);
  image.requireWithin(
      steps_, std::int64_t{0},
      (std::numeric_limits<std::int64_t>::max() / 2 - std::abs(scene().time)) / scene().step);
  // A fingerprint of the generations, because a copy would allocate.
  const auto ofGenerations = [this] {
    return fingerprint(generation_.data(), generation_.size() * sizeof generation_[0]);
  };
  const std::uint64_t own = ofGenerations();
  image(drives_, inputs_, generation_, status_);
  if (!image.require(ofGenerations() == own)) {
    std::fill(generation_.begin(), generation_.end(), 0);
  }
  for (StepStatus& status : status_) {
    image.requireWithin(status, StepStatus::kOk, StepStatus::kNoGap);
  }
  for (const Drive& drive : drives_) {
    image.require(drive.nanoseconds() == now());
  }
  for (Stepper* const stepper : running_) {
    stepper->exchange(image);
  }
  for (Ensemble* const ensemble : stepped_ensembles_) {
    ensemble->exchange(image);
    if (image.puts()) {
      ensemble->publish(steps_);
    }
  }
  control_.exchange(image, now());
}

std::unique_ptr<Stepper> Twin::replace(std::size_t system, std::unique_ptr<Stepper> next,
                                       std::int64_t generation) noexcept {
  running_[system]->write(state_.data());
  next->set(state_.data(), state_.data() + next->dof());
  running_[system] = next.get();
  generation_[system] = generation;
  replacements_[system].swap(next);
  return next;
}

void Twin::write(double* record) const noexcept {
  RecordLayout::setStep(record, steps_);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const ShaftPlace<double> place = RecordLayout::shaft(record, i);
    ShaftState turned;
    if (isMotor(i) && running_[turned_by_[i]]->shaft(turned)) {
      place.setAngle(turned.angle);
      place.setMotion(turned.speed, turned.acceleration, 0.0, turned.speed);
    } else {
      const ShaftMotion motion = drives_[i].at(0.0);
      place.setAngle(drives_[i].angle());
      place.setMotion(motion.speed, motion.acceleration, motion.jerk, drives_[i].targetSpeed());
    }
  }
  for (std::size_t i = 0; i < steppers_.size(); ++i) {
    const SystemPlace<double> place = layout_.system(record, i);
    place.setStatus(status_[i]);
    running_[i]->write(place.motion());
    place.setGeneration(generation_[i]);
    const double own = running_[i]->errorSum();
    place.setErrorSum(ensembles_[i] ? std::fmax(own, ensembles_[i]->errorSum()) : own);
  }
  for (std::size_t i = 0; i < control_.controllers().size(); ++i) {
    const RunningController& controller = control_.controllers()[i];
    const ControllerPlace<double> place = layout_.controller(record, i);
    const ControlCount& count = controller.count();
    place.setCount(count.samples, count.saturated, count.missed);
    place.setGeneration(controller.generation());
    const ExternalController* const external = controller.external();
    place.setAnswers(external != nullptr ? external->age() : ExternalController::kNoAge,
                     external != nullptr && external->lost());
    place.setSupervision(static_cast<std::int64_t>(controller.supervision()));
    std::copy_n(controller.shown(), controller.measured(), place.values());
    for (std::size_t k = 0; k < controller.outputs(); ++k) {
      place.outputs()[k] = controller.acting(k);
    }
  }
}

bool Twin::setSpeed(std::size_t drive, double speed, double max_acceleration,
                    double max_jerk) noexcept {
  return drive < scene().drives.size() && !isMotor(drive) &&
         drives_[drive].setSpeed(speed, max_acceleration, max_jerk);
}

bool Twin::setInput(std::size_t system, std::size_t input, double value,
                    std::int64_t duration) noexcept {
  const std::int64_t time = now();
  if (system >= inputs_.size() || duration <= 0 || duration > Inputs::kNever - time ||
      !inputs_[system].set(input, value, time + duration)) {
    return false;
  }
  inputs_[system].begin(time);
  return true;
}

}  // namespace whirl_twin
