// Nonlinear nodal force on a rotor: a magnetic bearing near its poles, an oil film, a stator rub.
//
// The linear part of such a force is in the rotor's matrices and input directions; a force law
// gives the remainder, F(x, y, x', y', w, u). The rotor is one linear system with a few forces (see
// locally_forced_rotor.h), for any number of coordinates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>

namespace whirl_twin {

/// At the place of a force, across the shaft.
struct LocalState {
  std::array<double, 2> place{};  ///< [m], x and y
  std::array<double, 2> rate{};   ///< [m/s]
  std::array<double, 2> input{};  ///< u, of LocalForce::inputs
  double speed = 0.0;             ///< [rad/s], of the shaft
};

struct NodalForce {
  std::array<double, 2> force{};  ///< [N], along x and y
  double size = 0.0;              ///< [N], size of the terms of F, for its rounding error
};

/// Derivatives of F.
struct LocalSlopes {
  Eigen::Matrix2d stiffness;                           ///< -dF/d(x, y) [N/m]
  Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();   ///< -dF/d(x', y') [N s/m]
  Eigen::Matrix2d by_input = Eigen::Matrix2d::Zero();  ///< dF/du
};

class NodalForceLaw {
 public:
  virtual ~NodalForceLaw() = default;
  /// Real-time safe. False, with `out` unchanged, where the position is outside the clearance.
  virtual bool push(const LocalState& at, NodalForce& out) const noexcept = 0;
  /// Real-time safe.
  virtual LocalSlopes slopes(const LocalState& at) const noexcept = 0;
  /// [N m], on the shaft's spin, where a motor turns it. Real-time safe.
  virtual double moment(const LocalState& /*at*/) const noexcept { return 0.0; }
  /// [m], distance of a position from the limit of the clearance; infinite without a limit.
  virtual double room(const Eigen::Vector2d& /*place*/) const noexcept {
    return std::numeric_limits<double>::infinity();
  }
  /// [m], length scale of a rotor's motion where this force determines it.
  virtual double length() const { return 0.0; }
};

struct LocalForce {
  static constexpr std::size_t kNoInput = static_cast<std::size_t>(-1);

  std::string name;                   ///< "magnet_1"
  Eigen::VectorXd along_x, along_y;   ///< x = along_x . q, y = along_y . q
  std::array<std::size_t, 2> inputs;  ///< of Dynamics::inputs(), x and y, or kNoInput
  std::shared_ptr<const NodalForceLaw> law;
};

/// Of the place of a force, in a motion q, v at a speed [rad/s]; without inputs.
inline LocalState stateOf(const LocalForce& force, const Eigen::VectorXd& q,
                          const Eigen::VectorXd& v, double speed) {
  LocalState at;
  at.place = {force.along_x.dot(q), force.along_y.dot(q)};
  at.rate = {force.along_x.dot(v), force.along_y.dot(v)};
  at.speed = speed;
  return at;
}

}  // namespace whirl_twin
