// Spin of a motor-driven shaft over one step: the torque balance of mechanics/spin_coupling.h, for
// a rotor whose whirl can be stepped along a given function of the speed.
//
// With the momentum P = J w + s . q' that balance needs no accelerations,
//
//   P' = T(w) - d w + w (ds/dtheta) . q' + q^T N_1 q' - w q^T S q + m
//
// (m: inputs and friction), so that stiff modes, whose accelerations no step resolves, have no
// effect. Radau IIA with three nodes (order 5): the speeds at the nodes are iterated until they are
// consistent with the rotor stepped along the cubic through them. The coupling to the whirl is weak
// (m e^2 / J), and the motor characteristic is treated by Newton's method, so that one or two
// iterations correct the speed course extrapolated from the last step.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "integration/linear_stepper.h"
#include "integration/motion_state.h"
#include "integration/shaft_phasor.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/spin_coupling.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// Where the nodes of Radau IIA with three stages are, in parts of a step.
inline constexpr double kRoot6 = 2.44948974278317809820;
inline constexpr std::array<double, 3> kRadauNodes{0.4 - 0.1 * kRoot6, 0.4 + 0.1 * kRoot6, 1.0};

/// The state of a spin.
struct SpinMotion {
  std::int64_t turns = 0;
  CompensatedSum angle;  ///< [rad], beyond the turns, within 0 ... 2 pi
  CompensatedSum speed;  ///< [rad/s]
  /// Of the course at the end of the last step: acceleration, jerk and snap.
  double acceleration = 0.0, jerk = 0.0, snap = 0.0;

  // Real-time safe.

  void set(double total_angle, double speed_now, double acceleration_now) noexcept;
  ShaftAngle shaftAngle() const noexcept { return {turns, angle.high}; }
  void exchange(StateImage& image) noexcept {
    image(turns, angle, speed, acceleration, jerk, snap);
  }
};

class ShaftSpin {
 public:
  static constexpr std::size_t kNodes = kRadauNodes.size();

  ShaftSpin(const LinearRotor& rotor, const SpinCoupling& coupling, double h);

  // Real-time safe.

  /// Takes up a step from an offset [s], with the course that is foretold.
  void begin(double offset, const SpinMotion& spin, const LinearMotion& motion) noexcept;
  const ShaftCourse& course() const noexcept { return course_; }
  double speed(std::size_t node) const noexcept { return speeds_[node]; }  ///< [rad/s]
  /// Where the rotor is at a node of the course.
  void take(std::size_t node, const LinearMotion& motion) noexcept;
  /// What else acts on the spin there [N m].
  void add(std::size_t node, double torque) noexcept {
    nodes_[node].torque += torque;
    nodes_[node].rate += torque;
  }
  /// After all nodes: corrects the speed course. False: singular equations, or a speed that is not
  /// finite or above 1e300.
  bool mend() noexcept;
  /// Whether the last mend() changed it by no more than rounding.
  bool agrees() const noexcept { return agrees_; }
  /// Sets the spin to the end of the step; returns the work of the torques on it [J].
  double finish(SpinMotion& spin) noexcept;
  /// [rad/s^2], of a spin driven by its motor alone.
  double freeAcceleration(double speed) const noexcept;

 private:
  struct Node {
    double lever = 0.0;   ///< s . q'
    double torque = 0.0;  ///< [N m], all of P' but what the unbalance gives
    double rate = 0.0;    ///< P'
    double slope = 0.0;   ///< dP' / dw
  };
  double lever(double angle, const LinearMotion& motion) const noexcept;
  void bend() noexcept;  ///< the course through the speeds

  double h_;
  double inertia_;
  Motor motor_;
  Eigen::VectorXd real_, imaginary_;  ///< of F
  Eigen::MatrixXd circulatory_, resistance_;
  bool turns_damping_;                           ///< are they other than zero?
  std::array<std::array<double, 3>, 3> powers_;  ///< of speeds at the nodes, those of a cubic
  double start_lever_ = 0.0;
  std::array<double, kNodes> speeds_{};
  std::array<Node, kNodes> nodes_{};
  ShaftCourse course_;
  double size_ = 0.0;  ///< [rad/s], by which speeds round
  bool agrees_ = false;
};

}  // namespace whirl_twin
