// A controller as machines have them: at instants of its own it is shown what is measured, and
// gives outputs. What is around it, sensors, delay and actuators, is not its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "control/shaft_angle.h"
#include "control/transfer_function.h"
#include "messages/controller_state.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// What a controller is shown at one of its instants.
struct ControlSample {
  const double* values;    ///< as many as it measures, in their units
  std::int64_t index;      ///< of the sample: k at k / rate after simulated time 0
  std::int64_t time;       ///< [ns], simulated
  ShaftAngle shaft_angle;  ///< of the shaft it goes by; 0 without
  double shaft_speed;      ///< [rad/s]
};

class Controller {
 public:
  virtual ~Controller() = default;

  // Real-time safe: no allocation, no lock, no exception.

  /// Forgets the past.
  virtual void reset() noexcept = 0;
  /// Writes as many outputs as it has, in their units.
  virtual void update(const ControlSample& sample, double* outputs) noexcept = 0;
  /// Goes on, with its own parameters, from where another of the same kind and plan is: its outputs
  /// do not jump where there is a way. One that has nothing to take over begins anew.
  virtual void takeOver(const Controller& /*before*/) noexcept {}
  /// The law behind what is put before it, as a notch is; itself, where there is nothing.
  virtual const Controller& law() const noexcept { return *this; }
  /// Of one that brings a shaft through resonances.
  virtual state::Supervision supervision() const noexcept { return state::Supervision::kNone; }

  // Not real-time safe.

  /// How small changes of what it measures come out, without limits and at a shaft speed [rad/s];
  /// nothing where that is not linear.
  virtual std::optional<DiscreteStateSpace> linear(double shaft_speed) const = 0;
  /// At this shaft speed [rad/s], while it changes by an acceleration [rad/s^2], what is put before
  /// law() goes on as it is and does not follow what is measured: small changes are those of law().
  virtual bool holds(double /*shaft_speed*/, double /*acceleration*/) const { return false; }
  /// From where linear() counts what is measured: there, and with no past, its outputs are 0.
  /// Empty: from 0.
  virtual std::vector<double> setpoint() const { return {}; }

  // Real-time safe again.

  /// All that its next outputs hang on, but what it was made of.
  virtual void exchange(StateImage& image) noexcept = 0;
};

}  // namespace whirl_twin
