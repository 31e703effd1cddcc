// A sampled controller: at its own sampling instants it receives measured values and computes
// outputs. Sensors, delay and actuators are outside it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "control/shaft_angle.h"
#include "control/transfer_function.h"
#include "messages/controller_state.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// Input of a controller at a sampling instant.
struct ControlSample {
  const double* values;    ///< as many as it measures, in their units
  std::int64_t index;      ///< of the sample: k at k / rate after simulated time 0
  std::int64_t time;       ///< [ns], simulated
  ShaftAngle shaft_angle;  ///< of its reference shaft; 0 without one
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
  /// Bumpless transfer: continues, with its own parameters, from the state of another of the same
  /// kind and plan; its outputs do not jump where this is possible. One without a state to take
  /// over restarts.
  virtual void takeOver(const Controller& /*before*/) noexcept {}
  /// The controller behind a filter such as a notch; itself, where there is no filter.
  virtual const Controller& law() const noexcept { return *this; }
  /// State of a controller that brings a shaft through resonances.
  virtual state::Supervision supervision() const noexcept { return state::Supervision::kNone; }

  // Not real-time safe.

  /// Linearization from measurement to output, without limits and at a shaft speed [rad/s]; empty
  /// where the controller has none.
  virtual std::optional<DiscreteStateSpace> linear(double shaft_speed) const = 0;
  /// At this shaft speed [rad/s], while it changes by an acceleration [rad/s^2], the filter in
  /// front of law(), such as a notch, is frozen and does not adapt to the measurement: the
  /// linearization is that of law().
  virtual bool holds(double /*shaft_speed*/, double /*acceleration*/) const { return false; }
  /// Matrices that a design has computed, by name, for reports: a `feedback` K of u = -K x, an
  /// `estimator` M of x^ = x~ + M (y - c x~).
  struct Gain {
    const char* name;
    Eigen::MatrixXd matrix;
  };
  virtual std::vector<Gain> gains() const { return {}; }
  /// Operating point of linear(): at this measurement, with zero state, its outputs are 0. Empty:
  /// 0.
  virtual std::vector<double> setpoint() const { return {}; }

  // Real-time safe again.

  /// All state that determines its next outputs, except its construction parameters.
  virtual void exchange(StateImage& image) noexcept = 0;
};

}  // namespace whirl_twin
