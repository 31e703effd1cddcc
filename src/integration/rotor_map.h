// What one exact step makes of a linear rotor at a speed w: the matrices of rotor_step.h. Prepared
// off the real-time path.
//
// The forcing that turns with the shaft at harmonic m is Re[F g(s) e^(i m w s)] over a step of h,
// g a polynomial in s/h with complex coefficients g_0 ... g_p. With psi_k' = i m w psi_k +
// (k+1)/h psi_(k+1), psi_k(0) = g_k, it is Re[F psi_0], so that states and forcing are one linear
// system with constant coefficients and the step is e^(A h): exact for any h, stiff or not, damped
// or not, in resonance or not. Inputs (acting_inputs.h) come in likewise: a harmonic as a pair of
// phasors of its own frequency, one behind a lag as a pair of its own, any other as a real
// polynomial.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "integration/acting_inputs.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

// A matrix that is smooth in the speed of a shaft, dear to work out, and wanted at very many
// speeds: from few of them by Chebyshev interpolation in parts of the range (Trefethen,
// Approximation Theory and Approximation Practice, 2013). Not real-time safe.

class MapOverSpeed {
 public:
  using Sample = std::function<Eigen::MatrixXd(double speed)>;
  /// How much an error is of a matrix.
  using Size = std::function<double(const Eigen::MatrixXd& error, const Eigen::MatrixXd& exact)>;

  /// Between two speeds [rad/s] to `tolerance`, seen between the nodes; where rounding leaves more
  /// (up to `rounding`) to that. Throws RunFailure where no part is narrow enough.
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

/// What a step is made of.
struct RotorStepMatrices {
  Eigen::MatrixXd increment;  ///< B: (dq, dv) = B y. [2 dof x inputs]
  Eigen::MatrixXd work;       ///< W: what dh/dt gives over the step is y^T W y. [inputs x inputs]
};

class RotorMap {
 public:
  /// What a step starts from, y: q, v, then for every channel Re g_0, Im g_0, Re g_1 ..., then 1,
  /// then the inputs that act: pairs where `degree` is 0 (straight lines in units of h), else, and
  /// where the rotor is pushed besides, their courses over the step.
  static Eigen::Index inputs(Eigen::Index dof, std::size_t channels, const ActingInputs& acting,
                             int degree);

  /// At a speed [rad/s], for steps of h [s]; `degree` of the polynomials g.
  RotorMap(const LinearRotor& rotor, const std::vector<ForceChannel>& channels,
           const ActingInputs& acting, double speed, double h, int degree);

  /// B: (dq, dv) = B y. [2 dof x inputs]
  Eigen::MatrixXd increment() const;
  /// W: the work done on the system, dh/dt integrated over the step, is y^T W y; driven: with that
  /// of the forces that turn with the shaft. [inputs x inputs]
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
  const ActingInputs& acting_;
  int degree_;
  Eigen::MatrixXd a_;  ///< of the scaled system
  Eigen::MatrixXd scale_, unscale_;
};

}  // namespace whirl_twin
