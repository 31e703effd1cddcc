// What pushes a rotor at one place along its shaft, and is not linear in the motion there: a
// magnetic bearing near its poles, a film of oil, a stator that it rubs on.
//
// What of such a force is among the rotor's own matrices and the directions of its inputs is the
// rotor's; a law gives the rest, F(x, y, x', y', w, u). A rotor stays one linear system with a few
// forces (see locally_forced_rotor.h), whatever the number of its coordinates.
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

struct LocalPush {
  std::array<double, 2> force{};  ///< [N], along x and y
  double size = 0.0;              ///< [N], of what it is the difference of: that is what rounds
};

/// How F changes.
struct LocalSlopes {
  Eigen::Matrix2d stiffness;                           ///< -dF/d(x, y) [N/m]
  Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();   ///< -dF/d(x', y') [N s/m]
  Eigen::Matrix2d by_input = Eigen::Matrix2d::Zero();  ///< dF/du
};

class LocalLaw {
 public:
  virtual ~LocalLaw() = default;
  /// Real-time safe. False, with `out` as it was, where there is no such place for a rotor.
  virtual bool push(const LocalState& at, LocalPush& out) const noexcept = 0;
  /// Real-time safe.
  virtual LocalSlopes slopes(const LocalState& at) const noexcept = 0;
  /// [N m], on the shaft's spin, where a motor turns it. Real-time safe.
  virtual double moment(const LocalState& /*at*/) const noexcept { return 0.0; }
  /// [m], how far a place is from where there is none; infinite where there is a place everywhere.
  virtual double room(const Eigen::Vector2d& /*place*/) const noexcept {
    return std::numeric_limits<double>::infinity();
  }
  /// [m], how far a rotor moves where this decides how far.
  virtual double length() const { return 0.0; }
};

struct LocalForce {
  static constexpr std::size_t kNoInput = static_cast<std::size_t>(-1);

  std::string name;                   ///< "magnet_1"
  Eigen::VectorXd along_x, along_y;   ///< x = along_x . q, y = along_y . q
  std::array<std::size_t, 2> inputs;  ///< of Dynamics::inputs(), x and y, or kNoInput
  std::shared_ptr<const LocalLaw> law;
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
