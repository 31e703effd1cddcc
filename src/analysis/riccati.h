// Algebraic Riccati equations, and the gains they give: of a regulator (LQR) and of a Kalman
// filter.
//
//   continuous   A' X + X A - (X B + N) R^-1 (B' X + N') + Q = 0
//   sampled      X = A' X A - (A' X B + N) (R + B' X B)^-1 (B' X A + N') + Q
//
// By the structure-preserving doubling algorithm: k doublings are 2^k steps of Riccati's recursion,
// so it converges quadratically, by products and LU factorizations only, no eigenvalues (E. Chu, H.
// Fan, W. Lin, Linear Algebra and its Applications 396 (2005) 55; E. Chu, H. Fan, W. Lin, C. Wang,
// Int. J. Control 77 (2004) 767). The continuous equation is converted by a Cayley transform.
// Newton steps then remove the rounding errors.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// The cost of a motion: the integral (or the sum over samples) of x' Q x + 2 x' N u + u' R u.
struct QuadraticCost {
  Eigen::MatrixXd state;       ///< Q [n x n], symmetric, >= 0
  Eigen::MatrixXd input;       ///< R [m x m], symmetric, > 0
  Eigen::MatrixXd cross = {};  ///< N [n x m]; empty: none
};

/// u = -gain x costs least: x0' cost x0 from x0 on.
struct Regulator {
  Eigen::MatrixXd gain;  ///< [m x n]
  Eigen::MatrixXd cost;  ///< X [n x n], the stabilising solution
};

/// Of x' = a x + b u. All four: shapes that do not fit are a std::logic_error; InputError where R
/// is not positive definite or a number is not finite; RunFailure where no gain stabilises, or a
/// motion that does not die out by itself costs nothing. Not real-time safe (allocates).
Regulator continuousRegulator(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                              const QuadraticCost& cost);

/// Of x(k+1) = a x(k) + b u(k).
Regulator discreteRegulator(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                            const QuadraticCost& cost);

/// x' = a x + b u under inputs held for a period, from sample to sample, with what it costs on the
/// way: exact, the cost between the samples included, which has a cross term even if the continuous
/// one has none (C. Van Loan, IEEE Trans. Automatic Control 23 (1978) 395).
struct SampledPlant {
  Eigen::MatrixXd a;   ///< [n x n]
  Eigen::MatrixXd b;   ///< [n x m]
  QuadraticCost cost;  ///< of a period
};

/// `period` [s] > 0.
SampledPlant sampledPlant(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                          const QuadraticCost& cost, double period);

/// The gain of samples a period [s] apart that costs least of x' = a x + b u.
Regulator sampledRegulator(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                           const QuadraticCost& cost, double period);

/// What is not known of a state that is measured.
struct Estimator {
  Eigen::MatrixXd gain;        ///< [n x measured]
  Eigen::MatrixXd covariance;  ///< [n x n]
};

/// Of x' = a x + w, y = c x + v, with noise of the densities W = `process` [n x n] and V =
/// `measurement` [measured x measured]: x^' = a x^ + gain (y - c x^). Errors as above.
Estimator continuousEstimator(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                              const Eigen::MatrixXd& process, const Eigen::MatrixXd& measurement);

/// Of x(k+1) = a x(k) + w, y = c x + v, with covariances W and V of a sample: x^ += gain (y - c x^)
/// when y comes, x^(k+1) = a x^ (+ b u) on the way to the next. `covariance` is that before y
/// comes.
Estimator discreteEstimator(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                            const Eigen::MatrixXd& process, const Eigen::MatrixXd& measurement);

}  // namespace whirl_twin
