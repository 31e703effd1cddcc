// What pushes a rotor at one place along its shaft, and is not linear in the motion there: a
// magnetic bearing near its poles, and whatever else stands beside a rotor.
//
// What is linear in such a force is the rotor's own, among its matrices and the directions of its
// inputs; a law gives the rest, F(x, y, u). A rotor stays one linear system with a few forces (see
// locally_forced_rotor.h), whatever the number of its coordinates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <string>

namespace whirl_twin {

/// At the place of a force, across the shaft.
struct LocalState {
  std::array<double, 2> place{};       ///< [m], x and y
  std::array<double, 2> rate{};        ///< [m/s]
  std::array<double, 2> input{};       ///< u, of LocalForce::inputs
  std::array<double, 2> input_rate{};  ///< u'
};

struct LocalPush {
  std::array<double, 2> force{};  ///< [N], along x and y
  std::array<double, 2> rate{};   ///< [N/s], at which it changes
  double size = 0.0;              ///< [N], of what it is the difference of: that is what rounds
};

/// How F(x, y, u) changes.
struct LocalSlopes {
  Eigen::Matrix2d stiffness;  ///< -dF/d(x, y) [N/m]
  Eigen::Matrix2d by_input;   ///< dF/du
};

class LocalLaw {
 public:
  virtual ~LocalLaw() = default;
  /// Real-time safe. False, with `out` as it was, where there is no such place for a rotor.
  virtual bool push(const LocalState& at, LocalPush& out) const noexcept = 0;
  /// At a place and inputs. Rates do not matter.
  virtual LocalSlopes slopes(const LocalState& at) const = 0;
  /// [m], how far a place is from where there is none.
  virtual double room(const Eigen::Vector2d& place) const = 0;
};

struct LocalForce {
  std::string name;                   ///< "magnet_1"
  Eigen::VectorXd along_x, along_y;   ///< x = along_x . q, y = along_y . q
  std::array<std::size_t, 2> inputs;  ///< of Dynamics::inputs(), for x and for y
  std::shared_ptr<const LocalLaw> law;
};

}  // namespace whirl_twin
