// Least squares of a motion in a plane by harmonics whose amplitudes are polynomials of time:
//
//   x(t) = sum over harmonics, p: (c_p cos(phase(t)) + s_p sin(phase(t))) L_p(tau)
//
// and y likewise, with the Legendre polynomials L_p of tau = -1..1 over the samples. The phases are
// known exactly, so that a change of speed causes no error; only the change of the amplitude is
// approximated, accurately where the samples span more turns than the polynomials have terms. (A
// Vold-Kalman filter achieves the same by a penalty on the change; H. Vold, J. Leuridan, SAE
// 931288.)
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "algebra/dense.h"

namespace whirl_twin {

class HarmonicFit {
 public:
  /// Samples at `tau`, -1..1; capacity for `most_columns` columns.
  HarmonicFit(Eigen::ArrayXd tau, Eigen::Index most_columns);

  /// What does not turn: a polynomial. It is harmonic 0, and to be added first.
  void addMean(int degree);
  void addHarmonic(const Eigen::ArrayXd& phase, int degree);
  void removeLast();  ///< harmonic
  /// Columns for another harmonic of this degree.
  bool hasRoom(int degree) const;

  /// Fits. False where the samples cannot separate the harmonics.
  bool solve(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y);

  // After solve(), at tau = 0.

  std::complex<double> mean() const;
  /// Forward and backward parts (order_vector.h) of a harmonic, and their changes per unit of tau.
  std::complex<double> forward(std::size_t harmonic) const { return part(harmonic, 1.0, false); }
  std::complex<double> backward(std::size_t harmonic) const { return part(harmonic, -1.0, false); }
  std::complex<double> forwardChange(std::size_t harmonic) const {
    return part(harmonic, 1.0, true);
  }
  std::complex<double> backwardChange(std::size_t harmonic) const {
    return part(harmonic, -1.0, true);
  }
  /// Standard deviation of real and imaginary part of forward or backward, if the residual is
  /// noise.
  double deviation(std::size_t harmonic) const;
  /// How far [the unit of x] forward or backward may be off: by noise, by what the last terms of
  /// the polynomial let expect of those that it does not have, and by all of its change where that
  /// is more than what stays, for then something else turns beside this harmonic.
  double doubt(std::size_t harmonic) const;
  /// The residual, as x + i y, and its root mean square in one direction.
  const Eigen::ArrayXcd& rest() const { return rest_; }
  double noise() const { return noise_; }

 private:
  struct Harmonic {
    Eigen::Index first;  // column: cosines of all degrees, then sines
    int degree;
    bool turns;
  };

  void addColumns(const Eigen::ArrayXd& factor, int degree);
  std::complex<double> part(std::size_t harmonic, double direction, bool change) const;

  Eigen::ArrayXd tau_;
  Eigen::MatrixXd columns_;
  Eigen::Index used_ = 0;
  std::vector<Harmonic> harmonics_;
  Ldlt normal_;
  Eigen::MatrixX2d coefficients_;
  Eigen::ArrayXcd rest_;
  double noise_ = 0.0;
};

}  // namespace whirl_twin
