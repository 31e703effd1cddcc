// Matrices of one exact step of a linear rotor at a speed w (rotor_step.h). Not real-time safe.
//
// The forcing at harmonic m of the shaft is Re[F g(s) e^(i m w s)] over a step of h, g a polynomial
// in s/h with complex coefficients g_0 ... g_p. With psi_k' = i m w psi_k + (k+1)/h psi_(k+1),
// psi_k(0) = g_k, it is Re[F psi_0], so that states and forcing are one linear system with constant
// coefficients and the step is e^(A h): exact for any h, stiff or not, damped or not, in resonance
// or not. Inputs (applied_inputs.h) are included likewise: a harmonic as a pair of phasors of its
// frequency, one behind a lag as a further pair, any other as a real polynomial.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "integration/applied_inputs.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

// Interpolation over shaft speed of a matrix that is expensive to compute and needed at many
// speeds: piecewise Chebyshev interpolation (Trefethen, Approximation Theory and Approximation
// Practice, 2013). Not real-time safe.

class MapOverSpeed {
 public:
  using Sample = std::function<Eigen::MatrixXd(double speed)>;
  /// How much an error is of a matrix.
  using Size = std::function<double(const Eigen::MatrixXd& error, const Eigen::MatrixXd& exact)>;

  /// Between two speeds [rad/s] to `tolerance`, checked between the nodes; where the rounding error
  /// is larger, to that (up to `rounding`). Throws RunFailure where no part is narrow enough.
  MapOverSpeed(const Sample& sample, double low, double high, const Size& size, double tolerance,
               double rounding);

  Eigen::MatrixXd at(double speed) const;

 private:
  struct Part {
    double low, high;  ///< [rad/s]
    std::vector<Eigen::MatrixXd> values;
    Eigen::MatrixXd at(double speed) const;
  };
  void add(const Sample& sample, double low, double high, const Size& size, double tolerance,
           double rounding, double before);

  std::vector<Part> parts_;  ///< ascending
};

/// Forces of one harmonic, all with a factor (w^2 - i a) or all without.
struct ForceChannel {
  Eigen::VectorXcd amplitude;
  int harmonic = 1;
  bool inertial = true;
};

/// The rotor's forces gathered in channels.
std::vector<ForceChannel> forceChannels(const LinearRotor& rotor);

/// The matrices of a step.
struct RotorStepMatrices {
  Eigen::MatrixXd increment;  ///< B: (dq, dv) = B y. [2 dof x inputs]
  Eigen::MatrixXd work;       ///< W: what dh/dt gives over the step is y^T W y. [inputs x inputs]
};

class RotorMap {
 public:
  /// The input vector of a step, y: q, v, then for every channel Re g_0, Im g_0, Re g_1 ..., then
  /// 1, then the active inputs: pairs where `degree` is 0 (linear functions in units of h), else,
  /// and for a rotor with nodal forces, their polynomials over the step.
  static Eigen::Index inputs(Eigen::Index dof, std::size_t channels, const AppliedInputs& acting,
                             int degree);

  /// At a speed [rad/s], for steps of h [s]; `degree` of the polynomials g.
  RotorMap(const LinearRotor& rotor, const std::vector<ForceChannel>& channels,
           const AppliedInputs& acting, double speed, double h, int degree);

  /// B: (dq, dv) = B y. [2 dof x inputs]
  Eigen::MatrixXd increment() const;
  /// W: the work done on the system, dh/dt integrated over the step, is y^T W y; driven: with that
  /// of the synchronous forces. [inputs x inputs]
  Eigen::MatrixXd work(bool driven = true) const;
  /// Of steps of 1, 2, 4 ... nanoseconds up to h; the units of y stay those of h.
  std::vector<RotorStepMatrices> parts() const;

 private:
  Eigen::MatrixXd power(bool driven = true) const;
  Eigen::MatrixXd unscaledIncrement(const Eigen::MatrixXd& e) const;

  Eigen::Index n_;
  double h_;
  Linearization l_;
  const std::vector<ForceChannel>& channels_;
  const AppliedInputs& acting_;
  int degree_;
  Eigen::MatrixXd a_;  ///< of the scaled system
  Eigen::MatrixXd scale_, unscale_;
};

}  // namespace whirl_twin
