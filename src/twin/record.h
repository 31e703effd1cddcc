// Record: the fixed-size snapshot of one step that is passed from the real-time thread to the
// publisher, a flat row of doubles with integers stored as their bits. The layout is fixed by the
// scene and defined only here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "control/shaft_angle.h"
#include "integration/motion_state.h"

namespace whirl_twin {

/// An integer stored in a double.
inline double packed(std::int64_t value) noexcept {
  double bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline std::int64_t unpacked(double bits) noexcept {
  std::int64_t value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// A drive in a record. For a motor the jerk is 0 and the target is the current speed. Number is
/// double for writing, const double for reading.
template <class Number>
class ShaftPlace {
 public:
  static constexpr std::size_t kSize = 6;

  explicit ShaftPlace(Number* place) noexcept : place_(place) {}

  std::int64_t turns() const noexcept { return unpacked(place_[kTurns]); }
  double remainder() const noexcept { return place_[kRemainder]; }  ///< [rad]
  ShaftAngle angle() const noexcept { return {turns(), remainder()}; }
  double speed() const noexcept { return place_[kSpeed]; }                ///< [rad/s]
  double acceleration() const noexcept { return place_[kAcceleration]; }  ///< [rad/s^2]
  double jerk() const noexcept { return place_[kJerk]; }                  ///< [rad/s^3]
  double targetSpeed() const noexcept { return place_[kTargetSpeed]; }    ///< [rad/s]

  void setAngle(const ShaftAngle& angle) const noexcept {
    place_[kTurns] = packed(angle.turns);
    place_[kRemainder] = angle.remainder;
  }
  void setMotion(double speed, double acceleration, double jerk,
                 double target_speed) const noexcept {
    place_[kSpeed] = speed;
    place_[kAcceleration] = acceleration;
    place_[kJerk] = jerk;
    place_[kTargetSpeed] = target_speed;
  }

 private:
  enum { kTurns, kRemainder, kSpeed, kAcceleration, kJerk, kTargetSpeed };
  Number* place_;
};
using ShaftView = ShaftPlace<const double>;

/// A system in a record.
template <class Number>
class SystemPlace {
 public:
  /// Size of Stepper::write(): q, v and the work.
  static constexpr std::size_t motionSize(std::size_t dof) noexcept { return dof + dof + 1; }
  static constexpr std::size_t size(std::size_t dof) noexcept {
    return kMotion + motionSize(dof) + kAfterMotion;
  }

  SystemPlace(Number* place, std::size_t dof) noexcept
      : place_(place), after_(place + kMotion + motionSize(dof)), dof_(dof) {}

  operator SystemPlace<const double>() const noexcept { return {place_, dof_}; }

  StepStatus status() const noexcept { return static_cast<StepStatus>(unpacked(place_[kStatus])); }
  std::size_t dof() const noexcept { return dof_; }
  Number* motion() const noexcept { return place_ + kMotion; }  ///< of motionSize()
  Number* q() const noexcept { return motion(); }               ///< [rad] or [m]
  Number* v() const noexcept { return q() + dof_; }             ///< [rad/s] or [m/s]
  double work() const noexcept { return *(v() + dof_); }        ///< [J], since the system was set
  /// 0: the scene's (system_generations.h).
  std::int64_t generation() const noexcept { return unpacked(after_[kGeneration]); }
  /// [-], sum of its step errors since it was set.
  double errorSum() const noexcept { return after_[kErrorSum]; }

  void setStatus(StepStatus status) const noexcept {
    place_[kStatus] = packed(static_cast<std::int64_t>(status));
  }
  void setGeneration(std::int64_t generation) const noexcept {
    after_[kGeneration] = packed(generation);
  }
  void setErrorSum(double sum) const noexcept { after_[kErrorSum] = sum; }

 private:
  enum { kStatus, kMotion };
  enum { kGeneration, kErrorSum, kAfterMotion };
  Number* place_;
  Number* after_;
  std::size_t dof_;
};
using SystemView = SystemPlace<const double>;

/// A controller in a record.
template <class Number>
class ControllerPlace {
 public:
  static constexpr std::size_t size(std::size_t signals, std::size_t inputs) noexcept {
    return kValues + signals + inputs;
  }

  ControllerPlace(Number* place, std::size_t signals) noexcept : place_(place), signals_(signals) {}

  std::int64_t samples() const noexcept { return unpacked(place_[kSamples]); }
  std::int64_t saturated() const noexcept { return unpacked(place_[kSaturated]); }
  std::int64_t missed() const noexcept { return unpacked(place_[kMissed]); }
  /// Of an external one: ExternalController::age(), lost().
  std::int64_t age() const noexcept { return unpacked(place_[kAge]); }
  bool lost() const noexcept { return unpacked(place_[kLost]) != 0; }
  /// 0: the scene's (system_generations.h).
  std::int64_t generation() const noexcept { return unpacked(place_[kGeneration]); }
  std::int64_t supervision() const noexcept { return unpacked(place_[kSupervision]); }
  Number* values() const noexcept { return place_ + kValues; }      ///< of the signals
  Number* outputs() const noexcept { return values() + signals_; }  ///< of the inputs

  void setCount(std::int64_t samples, std::int64_t saturated, std::int64_t missed) const noexcept {
    place_[kSamples] = packed(samples);
    place_[kSaturated] = packed(saturated);
    place_[kMissed] = packed(missed);
  }
  void setAnswers(std::int64_t age, bool lost) const noexcept {
    place_[kAge] = packed(age);
    place_[kLost] = packed(lost ? 1 : 0);
  }
  void setGeneration(std::int64_t generation) const noexcept {
    place_[kGeneration] = packed(generation);
  }
  void setSupervision(std::int64_t supervision) const noexcept {
    place_[kSupervision] = packed(supervision);
  }

 private:
  enum { kSamples, kSaturated, kMissed, kAge, kLost, kGeneration, kSupervision, kValues };
  Number* place_;
  std::size_t signals_;
};

/// Number of measured signals and inputs of a controller.
struct ControllerSize {
  std::size_t signals, inputs;
};

/// Offsets in the records of a scene's twin.
class RecordLayout {
 public:
  std::size_t size = kDrives;  ///< [doubles]

  RecordLayout() = default;
  RecordLayout(std::size_t drives, const std::vector<std::size_t>& dofs,
               const std::vector<ControllerSize>& controllers = {}) {
    size += drives * ShaftView::kSize;
    for (const std::size_t dof : dofs) {
      systems_.push_back({size, dof});
      size += SystemView::size(dof);
    }
    for (const ControllerSize& controller : controllers) {
      controllers_.push_back({size, controller.signals});
      size += ControllerPlace<double>::size(controller.signals, controller.inputs);
    }
  }

  /// Steps since the start.
  static std::int64_t step(const double* record) noexcept { return unpacked(record[kStep]); }
  static void setStep(double* record, std::int64_t step) noexcept { record[kStep] = packed(step); }
  /// In place of the due time: not a new step, the twin's state was saved there.
  static constexpr std::int64_t kSaved = INT64_MIN;
  /// [ns], due time of the step; set by the loop.
  static std::int64_t scheduled(const double* record) noexcept {
    return unpacked(record[kScheduled]);
  }
  static void setScheduled(double* record, std::int64_t time) noexcept {
    record[kScheduled] = packed(time);
  }
  template <class Number>
  static ShaftPlace<Number> shaft(Number* record, std::size_t drive) noexcept {
    return ShaftPlace<Number>(record + kDrives + drive * ShaftView::kSize);
  }
  template <class Number>
  SystemPlace<Number> system(Number* record, std::size_t system) const noexcept {
    return {record + systems_[system].start, systems_[system].dof};
  }
  template <class Number>
  ControllerPlace<Number> controller(Number* record, std::size_t controller) const noexcept {
    return {record + controllers_[controller].start, controllers_[controller].signals};
  }

 private:
  enum { kStep, kScheduled, kDrives };
  struct Place {
    std::size_t start, dof;
  };
  struct ControllerStart {
    std::size_t start, signals;
  };
  std::vector<Place> systems_;
  std::vector<ControllerStart> controllers_;
};

}  // namespace whirl_twin
