#include "analysis/loop_rest.h"

#include "algebra/dense.h"
#include "integration/matrix_exponential.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kCancelledAtRest = 1e-13;  // of the terms whose sum is nothing but rounding

/// Rows and columns times powers of two: the largest of each is near 1.
MatrixXd equilibrated(MatrixXd m) {
  constexpr int kRounds = 8;
  const auto toOne = [](auto line) {
    const double largest = line.cwiseAbs().maxCoeff();
    if (largest > 0.0) {
      line *= powerOfTwo(1.0 / largest);
    }
  };
  for (int round = 0; round < kRounds; ++round) {
    for (Index i = 0; i < m.rows(); ++i) {
      toOne(m.row(i));
      toOne(m.col(i));
    }
  }
  return m;
}

}  // namespace

int standingDirections(const LoopPlant& plant, const std::vector<LoopController>& controllers) {
  const Index n = plant.a.rows();
  Index size = n;
  for (const LoopController& controller : controllers) {
    size += controller.law.states() + static_cast<Index>(controller.acts_on.size());
  }
  MatrixXd rest = MatrixXd::Zero(size, size);
  rest.topLeftCorner(n, n) = plant.a;
  Index next = n;
  for (const LoopController& controller : controllers) {
    const DiscreteStateSpace& law = controller.law;
    const Index states = law.states();
    const Index outputs = static_cast<Index>(controller.acts_on.size());
    MatrixXd c(static_cast<Index>(controller.measures.size()), n);
    for (Index i = 0; i < c.rows(); ++i) {
      c.row(i) = plant.c.row(controller.measures[static_cast<std::size_t>(i)]);
    }
    rest.block(next, 0, states, n) = law.b * c;
    rest.block(next, next, states, states) = law.a - MatrixXd::Identity(states, states);
    rest.block(next + states, 0, outputs, n) = law.d * c;
    rest.block(next + states, next, outputs, states) = law.c;
    rest.block(next + states, next + states, outputs, outputs).diagonal().setConstant(-1.0);
    for (Index i = 0; i < outputs; ++i) {
      rest.col(next + states + i).head(n) +=
          plant.b.col(controller.acts_on[static_cast<std::size_t>(i)]);
    }
    next += states + outputs;
  }
  if (size == 0) {
    return 0;
  }
  return static_cast<int>((singularValues(equilibrated(rest)).array() <= kCancelledAtRest).count());
}

}  // namespace whirl_twin
