// The spin of a shaft that a motor turns, over one step: the balance of torques of
// mechanics/spin_coupling.h, beside a rotor whose whirl a step takes along any course of the speed.
//
// With the momentum P = J w + s . q' that balance needs no accelerations,
//
//   P' = T(w) - d w + w (ds/dtheta) . q' + q^T N_1 q' - w q^T S q + m
//
// (m: inputs and friction), so that stiff modes, whose accelerations no step resolves, leave no
// mark. Radau IIA with three nodes (order 5): speeds at the nodes are sought that the rotor, taken
// along the cubic through them, agrees with. What the speeds do to the whirl is small beside what
// they are (m e^2 / J), and what the motor's law does to them goes by Newton's method, so that one
// or two rounds mend the course that the last step foretells.
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
  /// After all nodes: the course mended. False: it has lost the numbers.
  bool mend() noexcept;
  /// Did the last mend() move it by no more than rounding?
  bool agrees() const noexcept { return agrees_; }
  /// Puts the spin at the end of the step; tells the work of what acts on it [J].
  double finish(SpinMotion& spin) noexcept;
  /// [rad/s^2], of a spin that nothing but its motor turns.
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
