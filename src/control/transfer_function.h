// Transfer functions in z as states in samples.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

// A linear system in samples.

/// x(k+1) = a x(k) + b y(k), u(k) = c x(k) + d y(k): of a controller, y what it measures and u its
/// outputs. Without a state a is 0 x 0.
struct DiscreteStateSpace {
  Eigen::MatrixXd a;  ///< [n x n]
  Eigen::MatrixXd b;  ///< [n x measured]
  Eigen::MatrixXd c;  ///< [outputs x n]
  Eigen::MatrixXd d;  ///< [outputs x measured]

  Eigen::Index states() const { return a.rows(); }
};

/// (b0 z^m + ... + bm) / (a0 z^n + ... + an) of one signal, coefficients of falling powers, m <= n,
/// a0 not 0: n states, in observer form. Throws std::logic_error for others.
DiscreteStateSpace discreteTransferFunction(const Eigen::VectorXd& numerator,
                                            const Eigen::VectorXd& denominator);

/// gain (1 + s / zero) / (1 + s / pole), zero and pole [rad/s] > 0, by Tustin's rule with samples
/// `period` [s] apart: s = (2 / period) (z - 1) / (z + 1). At a frequency `prewarp` [rad/s], below
/// pi / period, it is what it is in s: (2 / period) becomes prewarp / tan(prewarp period / 2); 0:
/// it is not (G. F. Franklin, J. D. Powell, M. Workman, Digital Control of Dynamic Systems, 3rd ed.
/// 1998, sec. 6.1).
DiscreteStateSpace discreteLead(double gain, double zero, double pole, double period,
                                double prewarp);

/// The same control law, of one signal, on each of a number of axes.
DiscreteStateSpace onEachAxis(const DiscreteStateSpace& law, Eigen::Index axes);

}  // namespace whirl_twin
