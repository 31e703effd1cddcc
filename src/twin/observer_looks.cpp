// Processing of steps that are not published.
#include <algorithm>
#include <cmath>
#include <limits>

#include "twin/observer.h"

namespace whirl_twin {

namespace {

/// Maximum number of steps between observed energies: the residual is relative to the largest
/// energy. Steps of linear rotors cost less than their energies: for these it is larger.
constexpr std::int64_t kMaxPassed = 64;
constexpr std::int64_t kMaxPassedOfLinearRotors = 512;
constexpr double kQuarterTurn = 0.5 * 3.14159265358979323846;

bool isLinearRotor(const BuiltSystem& system) {
  return system.dynamics->isRotor() && system.dynamics->linear() &&
         system.integrator == "exponential";
}

}  // namespace

void Observer::prepareLooks() {
  most_passed_ = kMaxPassedOfLinearRotors;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const BuiltSystem& system = *twin_.systems()[i];
    if (isRotor(i)) {
      rotors_.push_back(i);
    }
    if (!isLinearRotor(system)) {
      most_passed_ = kMaxPassed;
    }
  }
  for (std::size_t i = 0; i < twin_.driveCount(); ++i) {
    if (twin_.isMotor(i)) {
      has_motors_ = true;
    } else {
      const auto [lowest, highest] = twin_.drive(i).speedRange();
      fastest_ = std::max({fastest_, -lowest, highest});
    }
  }
}

bool Observer::errorFound(std::size_t system, double sum) {
  const bool another = sum != looked_errors_[system] && !std::isnan(sum);
  looked_errors_[system] = sum;
  return another;
}

bool Observer::look(const double* record) {
  const std::int64_t now = RecordLayout::step(record);
  const std::int64_t passed = now - step();
  if (passed <= 0 || passed >= most_passed_) {
    return false;
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const SystemView system = twin_.layout().system(record, i);
    if (system.generation() != tracks_[i].generation || system.status() != status(i)) {
      return false;
    }
  }
  for (std::size_t i = 0; i < controller_tracks_.size(); ++i) {
    if (twin_.layout().controller(record, i).generation() != controllerGeneration(i)) {
      return false;
    }
  }
  const double h = twin_.scene().stepSeconds();
  for (const std::size_t i : rotors_) {
    if (status(i) != StepStatus::kOk) {
      continue;
    }
    const SystemView system = twin_.layout().system(record, i);
    const ShaftView shaft = RecordLayout::shaft(record, twin_.systems()[i]->drive);
    const double turned = (std::fabs(shaft.speed()) + std::fabs(shaft.acceleration()) * h) * h;
    if (!(turned < kQuarterTurn) || errorFound(i, system.errorSum()) ||
        !tracks_[i].whirl.follow(now, system.q())) {
      return false;
    }
  }
  followMotors(record);
  return true;
}

bool Observer::look(const Twin& now) {
  if (has_motors_) {
    now.write(looked_.data());
    return look(looked_.data());
  }
  const bool coarse = !(fastest_ * twin_.scene().stepSeconds() < kQuarterTurn);
  for (const std::size_t i : rotors_) {
    if (now.status(i) != StepStatus::kOk) {
      continue;
    }
    const Stepper& running = now.running(i);
    running.motion(looked_.data());
    if (coarse || errorFound(i, running.errorSum()) ||
        !tracks_[i].whirl.follow(now.stepCount(), looked_.data())) {
      return false;
    }
  }
  return true;
}

void Observer::followMotors(const double* record) {
  if (!has_motors_) {
    return;
  }
  const double time = twin_.seconds(RecordLayout::step(record));
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const std::size_t system = twin_.turnedBy(i);
    if (system == Twin::kNoSystem) {
      continue;
    }
    const SystemView now = twin_.layout().system(record, system);
    if (now.status() != StepStatus::kOk) {
      continue;
    }
    Track& track = tracks_[system];
    if (track.motor_generation != track.generation) {
      track.motor_generation = track.generation;
      motors_[i].restart();
    }
    const ShaftView turned = RecordLayout::shaft(record, i);
    motors_[i].observe(*twin_.scene().drives[i].motor, time, turned.speed(), turned.acceleration(),
                       now.work());
  }
}

}  // namespace whirl_twin
