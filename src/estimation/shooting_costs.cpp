#include "estimation/shooting_costs.h"

#include <algorithm>
#include <cmath>

#include "messages/refusal.h"

namespace whirl_twin {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kUnusualEquation = 0.2;  // of usual accelerations
constexpr double kEquationChange = 1.0e-5;
constexpr double kEquationChangeOfZero = 1.0e-7;

}  // namespace

void makeRobust(double huber, Eigen::VectorXd& residuals, Eigen::VectorXd& slope) {
  slope = Eigen::VectorXd::Ones(residuals.size());
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const double size = std::fabs(residuals[i]);
    if (size > huber) {
      const double counted = std::sqrt(huber * (2.0 * size - huber));
      slope[i] = huber / counted;
      residuals[i] = std::copysign(counted, residuals[i]);
    }
  }
}

WindowCost::WindowCost(const Shooting& shooting, const Window& window,
                       const Eigen::VectorXd& given_start, bool unknowns)
    : shooting_(shooting), window_(window), given_start_(given_start), unknowns_(unknowns) {
  set_num_residuals(static_cast<int>(residualCount(shooting.study(), window)));
  if (unknowns_) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shooting.unknowns()));
  }
  if (shooting.study().start_estimated) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shooting.startSize()));
  }
}

bool WindowCost::Evaluate(double const* const* blocks, double* residuals,
                          double** jacobians) const {
  const std::size_t place = unknowns_ ? 1 : 0;
  const bool estimated = shooting_.study().start_estimated;
  const Eigen::VectorXd start =
      estimated
          ? Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(blocks[place], shooting_.startSize()))
          : given_start_;
  double* by_unknowns = jacobians != nullptr && unknowns_ ? jacobians[0] : nullptr;
  double* by_start = jacobians != nullptr && estimated ? jacobians[place] : nullptr;
  WindowDerivatives d;
  const bool arrived = by_unknowns != nullptr || by_start != nullptr
                           ? shooting_.derivatives(window_, start, by_unknowns != nullptr, d)
                           : shooting_.residuals(window_, start, d.residuals);
  if (!arrived) {
    return false;
  }
  Eigen::VectorXd slope = Eigen::VectorXd::Ones(d.residuals.size());
  if (shooting_.study().huber) {
    makeRobust(*shooting_.study().huber, d.residuals, slope);
  }
  Eigen::Map<Eigen::VectorXd>(residuals, d.residuals.size()) = d.residuals;
  if (by_unknowns != nullptr) {
    Eigen::Map<RowMajor>(by_unknowns, d.residuals.size(), shooting_.unknowns()) =
        slope.asDiagonal() * d.by_unknowns;
  }
  if (by_start != nullptr) {
    Eigen::Map<RowMajor>(by_start, d.residuals.size(), shooting_.startSize()) =
        slope.asDiagonal() * d.by_start;
  }
  return true;
}

EquationCost::EquationCost(const EquationError& equations, const CandidateMaker& maker)
    : equations_(equations), maker_(maker) {
  set_num_residuals(static_cast<int>(equations.size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(maker.unknowns().size()));
}

bool EquationCost::Evaluate(double const* const* blocks, double* residuals,
                            double** jacobians) const {
  const auto n = static_cast<Eigen::Index>(maker_.unknowns().size());
  Eigen::VectorXd theta = Eigen::Map<const Eigen::VectorXd>(blocks[0], n);
  Eigen::VectorXd slope;
  try {
    Eigen::VectorXd here = equations_.residuals(maker_.at(theta));
    Eigen::MatrixXd by_unknowns(here.size(), jacobians != nullptr ? n : 0);
    for (Eigen::Index i = 0; i < by_unknowns.cols(); ++i) {
      const Unknown& unknown = maker_.unknowns()[static_cast<std::size_t>(i)];
      const double size = unknown.size(theta[i]);
      const double change = size > 0.0 ? kEquationChange * size : kEquationChangeOfZero;
      const double at = theta[i];
      const double above = std::min(at + change, unknown.most);
      const double below = std::max(at - change, unknown.least);
      theta[i] = above;
      by_unknowns.col(i) = equations_.residuals(maker_.at(theta));
      theta[i] = below;
      by_unknowns.col(i) -= equations_.residuals(maker_.at(theta));
      by_unknowns.col(i) /= above - below;
      theta[i] = at;
    }
    if (!here.allFinite() || !by_unknowns.allFinite()) {
      return false;
    }
    makeRobust(kUnusualEquation, here, slope);
    Eigen::Map<Eigen::VectorXd>(residuals, here.size()) = here;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[0], here.size(), n) = slope.asDiagonal() * by_unknowns;
    }
    return true;
  } catch (const Refusal&) {
    return false;
  }
}

}  // namespace whirl_twin
