// A system as a filter needs it: its accelerations, and how they change with the state and with the
// parameters that are followed along.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/built_system.h"

namespace whirl_twin {

// A step of linearized equations y' = A y + (0, f), y the coordinates and rates of n coordinates:
// the matrix exponential of A, and what accelerations f on the way come to, by Gauss's three nodes.

struct MotionStep {
  /// Of the step, from 0 to 1.
  static constexpr std::array<double, 3> kNode = {0.11270166537925831, 0.5, 0.88729833462074169};
  static constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};

  MotionStep() = default;
  /// by_state [n x 2n]: accelerations by coordinates and rates; duration [s].
  MotionStep(const Eigen::MatrixXd& by_state, double duration);

  /// The covariance [2n x 2n] that white accelerations of a density [n x n, (m/s^2)^2/Hz] make.
  Eigen::MatrixXd noiseOf(const Eigen::MatrixXd& density) const;

  double duration = 0.0;                ///< [s]
  Eigen::MatrixXd states;               ///< e^(A h) [2n x 2n]
  std::array<Eigen::MatrixXd, 3> node;  ///< what f at a node comes to [2n x n]
  Eigen::MatrixXd forced;               ///< their sum: what an f that stays comes to
  Eigen::MatrixXd noise;                ///< of white accelerations of density 1 [2n x 2n]
};

/// A parameter as a filter keeps it: the logarithm of its ratio to the scene's value, so that it
/// keeps its sign, and a small number is a part of the value.
struct FollowedParameter {
  std::string path;    ///< `stiffness`, `bearings[0].kxx`
  double start = 1.0;  ///< as the scene says; not 0

  double value(double number) const;
  /// Standard deviation in the parameter's unit of one of the number, there.
  double deviation(double number, double deviation) const;
};

/// How a system of n coordinates with m parameters accelerates about a state.
struct LocalMotion {
  Eigen::VectorXd acceleration;  ///< [n]
  Eigen::MatrixXd by_state;      ///< [n x 2n], by coordinates and rates
  Eigen::MatrixXd by_parameter;  ///< [n x m], by the numbers of FollowedParameter
};

class FollowedModel {
 public:
  FollowedModel(SharedSystem system, std::vector<FollowedParameter> parameters);

  Eigen::Index dof() const { return dof_; }
  const std::vector<FollowedParameter>& parameters() const { return parameters_; }
  /// The system with the parameters as they were when it was last set up for them.
  const SharedSystem& system() const { return now_.system; }
  /// How often it was set up.
  std::int64_t version() const { return version_; }
  /// Sets it up for these numbers of its parameters, if they are far enough from those that it has.
  /// Numbers that a system cannot have leave it as it was: false.
  bool follow(const Eigen::VectorXd& numbers);

  /// Of q and v [n] with numbers [m] near those that it is set up for, under u [inputs].
  LocalMotion about(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Moment<double>& at,
                    const Eigen::VectorXd& numbers, const Eigen::VectorXd& u) const;
  /// The acceleration alone; `by_parameter` from a state nearby.
  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const Moment<double>& at, const Eigen::VectorXd& numbers,
                               const Eigen::VectorXd& u, const Eigen::MatrixXd& by_parameter) const;

  /// Accelerations by a unit of each input [n x inputs].
  Eigen::MatrixXd byInput(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          const Moment<double>& at) const;

 private:
  struct Variant {
    SharedSystem system;
    Eigen::MatrixXd inputs;  // directions [n x inputs]
  };
  static Variant variant(SharedSystem system);
  Variant at(const Eigen::VectorXd& numbers) const;
  Eigen::VectorXd acceleration(const Variant& variant, const Eigen::VectorXd& q,
                               const Eigen::VectorXd& v, const Moment<double>& at,
                               const Eigen::VectorXd& u) const;

  SharedSystem scene_system_;
  std::vector<FollowedParameter> parameters_;
  Eigen::Index dof_;
  Variant now_;
  std::int64_t version_ = 0;
  Eigen::VectorXd numbers_;           // that it is set up for
  std::vector<Variant> more_, less_;  // each parameter by kDifference
};

}  // namespace whirl_twin
