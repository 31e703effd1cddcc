#include "control/transfer_function.h"

#include <cmath>
#include <stdexcept>

namespace whirl_twin {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DiscreteStateSpace discreteTransferFunction(const VectorXd& numerator,
                                            const VectorXd& denominator) {
  const Index n = denominator.size() - 1;
  if (n < 0 || denominator[0] == 0.0 || numerator.size() > n + 1) {
    throw std::logic_error("discreteTransferFunction: not a proper transfer function");
  }
  const VectorXd a = denominator / denominator[0];
  VectorXd b = VectorXd::Zero(n + 1);
  b.tail(numerator.size()) = numerator / denominator[0];
  DiscreteStateSpace law;
  law.a = MatrixXd::Zero(n, n);
  law.b = b.tail(n) - b[0] * a.tail(n);
  law.c = MatrixXd::Zero(1, n);
  law.d = MatrixXd::Constant(1, 1, b[0]);
  if (n > 0) {
    law.a.col(0) = -a.tail(n);
    law.a.topRightCorner(n - 1, n - 1).setIdentity();
    law.c(0, 0) = 1.0;
  }
  return law;
}

DiscreteStateSpace discreteLead(double gain, double zero, double pole, double period,
                                double prewarp) {
  const double k = prewarp > 0.0 ? prewarp / std::tan(0.5 * prewarp * period) : 2.0 / period;
  return discreteTransferFunction(gain * Eigen::Vector2d(1.0 + k / zero, 1.0 - k / zero),
                                  Eigen::Vector2d(1.0 + k / pole, 1.0 - k / pole));
}

DiscreteStateSpace onEachAxis(const DiscreteStateSpace& law, Index axes) {
  const Index n = law.states();
  DiscreteStateSpace all;
  all.a = MatrixXd::Zero(axes * n, axes * n);
  all.b = MatrixXd::Zero(axes * n, axes);
  all.c = MatrixXd::Zero(axes, axes * n);
  all.d = law.d(0, 0) * MatrixXd::Identity(axes, axes);
  for (Index i = 0; i < axes; ++i) {
    all.a.block(i * n, i * n, n, n) = law.a;
    all.b.block(i * n, i, n, 1) = law.b;
    all.c.block(i, i * n, 1, n) = law.c;
  }
  return all;
}

}  // namespace whirl_twin
