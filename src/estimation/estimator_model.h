// A system as a state estimator uses it: its accelerations and their derivatives by the state and
// by the estimated parameters.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/built_system.h"

namespace whirl_twin {

// A step of linearized equations y' = A y + (0, f), y the coordinates and rates of n coordinates:
// the matrix exponential of A, and the response to accelerations f by Gauss quadrature with three
// nodes.

struct MotionStep {
  /// Fractions of the step, from 0 to 1.
  static constexpr std::array<double, 3> kNode = {0.11270166537925831, 0.5, 0.88729833462074169};
  static constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};

  MotionStep() = default;
  /// by_state [n x 2n]: derivatives of the accelerations by coordinates and rates; duration [s].
  MotionStep(const Eigen::MatrixXd& by_state, double duration);

  /// Covariance [2n x 2n] due to white accelerations of a density [n x n, (m/s^2)^2/Hz].
  Eigen::MatrixXd noiseOf(const Eigen::MatrixXd& density) const;

  double duration = 0.0;                ///< [s]
  Eigen::MatrixXd states;               ///< e^(A h) [2n x 2n]
  std::array<Eigen::MatrixXd, 3> node;  ///< response to f at a node [2n x n]
  Eigen::MatrixXd forced;               ///< sum of these: response to a constant f
  Eigen::MatrixXd noise;                ///< for white accelerations of density 1 [2n x 2n]
};

/// Estimate of a parameter: the logarithm of its ratio to the scene's value. This keeps the sign of
/// the parameter, and small numbers are relative changes.
struct EstimatorParameter {
  std::string path;    ///< `stiffness`, `bearings[0].kxx`
  double start = 1.0;  ///< value in the scene; not 0

  double value(double number) const;
  /// Standard deviation in the parameter's unit, from the standard deviation of the number.
  double deviation(double number, double deviation) const;
};

/// Accelerations of a system of n coordinates with m parameters, linearized about a state.
struct LocalMotion {
  Eigen::VectorXd acceleration;  ///< [n]
  Eigen::MatrixXd by_state;      ///< [n x 2n], by coordinates and rates
  Eigen::MatrixXd by_parameter;  ///< [n x m], by the numbers of EstimatorParameter
};

class EstimatorModel {
 public:
  EstimatorModel(SharedSystem system, std::vector<EstimatorParameter> parameters);

  Eigen::Index dof() const { return dof_; }
  const std::vector<EstimatorParameter>& parameters() const { return parameters_; }
  /// The system with the parameters of its last set-up.
  const SharedSystem& system() const { return now_.system; }
  /// Number of set-ups.
  std::int64_t version() const { return version_; }
  /// Sets it up for these numbers of its parameters if they differ enough from the current ones.
  /// For numbers that are invalid for the system, keeps the current set-up and returns false.
  bool follow(const Eigen::VectorXd& numbers);

  /// At q and v [n] with numbers [m] near those of the set-up, under inputs u.
  LocalMotion about(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at, const Eigen::VectorXd& numbers,
                    const Eigen::VectorXd& u) const;
  /// The acceleration alone, with `by_parameter` of a nearby state.
  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at, const Eigen::VectorXd& numbers,
                               const Eigen::VectorXd& u, const Eigen::MatrixXd& by_parameter) const;

  /// Derivatives of the accelerations by each input [n x inputs].
  Eigen::MatrixXd byInput(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          const EvaluationPoint<double>& at) const;

 private:
  struct Variant {
    SharedSystem system;
    Eigen::MatrixXd inputs;  // directions [n x inputs]
  };
  static Variant variant(SharedSystem system);
  Variant at(const Eigen::VectorXd& numbers) const;
  Eigen::VectorXd acceleration(const Variant& variant, const Eigen::VectorXd& q,
                               const Eigen::VectorXd& v, const EvaluationPoint<double>& at,
                               const Eigen::VectorXd& u) const;

  SharedSystem scene_system_;
  std::vector<EstimatorParameter> parameters_;
  Eigen::Index dof_;
  Variant now_;
  std::int64_t version_ = 0;
  Eigen::VectorXd numbers_;           // of the set-up
  std::vector<Variant> more_, less_;  // each parameter varied by kDifference
};

}  // namespace whirl_twin
