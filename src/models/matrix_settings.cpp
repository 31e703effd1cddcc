#include "models/matrix_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "algebra/dense.h"
#include "models/model_info.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kSymmetric =
    1.0e-12;  // [-], of the largest entry: rounding of who made the matrix
/// [-], of a mass scaled to unit diagonal: below it rounding decides what the accelerations are.
constexpr double kNoMass = 1.0e-13;

/// A matrix of the scene as its symmetric (sign 1) or skew part (sign -1), zero if not given;
/// throws if there is more to it than that part.
MatrixXd matrixOf(const Settings& settings, const std::string& name, Index n, double sign) {
  const auto given = settings.matrices.find(name);
  if (given == settings.matrices.end()) {
    return MatrixXd::Zero(n, n);
  }
  const MatrixXd& a = given->second;
  if (a.rows() != n || a.cols() != n) {
    throw SetupError(
        name, fmt::format("must be {} x {} like mass, found {} x {}", n, n, a.rows(), a.cols()));
  }
  Index i = 0;
  Index j = 0;
  const double error = (a - sign * a.transpose()).cwiseAbs().maxCoeff(&j, &i);
  if (error > kSymmetric * a.cwiseAbs().maxCoeff()) {
    const std::string entry = fmt::format("[{}][{}] = {}", i, j, a(i, j));
    throw SetupError(
        name,
        sign > 0.0
            ? fmt::format("must be symmetric, found {} and [{}][{}] = {}", entry, j, i, a(j, i))
        : i == j ? fmt::format("must be skew-symmetric, with a zero diagonal, found {}", entry)
                 : fmt::format("must be skew-symmetric, [{}][{}] = -[{}][{}], found {} and "
                               "[{}][{}] = {}",
                               i, j, j, i, entry, j, i, a(j, i)));
  }
  return 0.5 * (a + sign * a.transpose());
}

/// The motion of least mass beside what its coordinates have, and that share [-].
struct LeastMass {
  double share;
  Eigen::VectorXd motion;
};

LeastMass leastMass(const MatrixXd& mass) {
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const SymmetricModes<double> solver =
      symmetricModes(scale.asDiagonal() * mass * scale.asDiagonal());
  return {solver.values[0], scale.cwiseProduct(solver.vectors.col(0))};
}

}  // namespace

MatrixXd symmetricMatrix(const Settings& settings, const std::string& name, Index n) {
  return matrixOf(settings, name, n, 1.0);
}

MatrixXd skewMatrix(const Settings& settings, const std::string& name, Index n) {
  return matrixOf(settings, name, n, -1.0);
}

bool hasMassInEveryMotion(const MatrixXd& mass) {
  return mass.diagonal().minCoeff() > 0.0 && leastMass(mass).share > kNoMass;
}

void requirePositiveDefinite(const MatrixXd& mass, const std::vector<std::string>& names) {
  const std::string expected =
      "must be positive definite: a coordinate or combination without mass has no independent "
      "motion; "
      "found ";
  Index i = 0;
  if (const double least = mass.diagonal().minCoeff(&i); !(least > 0.0)) {
    throw SetupError("mass", fmt::format("{}[{}][{}] = {} kg", expected, i, i, least));
  }
  const LeastMass found = leastMass(mass);
  if (found.share > kNoMass) {
    return;
  }
  std::vector<std::string> moving;
  const double largest = found.motion.cwiseAbs().maxCoeff();
  for (i = 0; i < mass.rows(); ++i) {
    if (std::abs(found.motion[i]) > 0.1 * largest) {
      moving.push_back(names[static_cast<std::size_t>(i)]);
    }
  }
  throw SetupError(
      "mass", fmt::format("{}{} mass for a combination of {}", expected,
                          found.share < -kNoMass ? "negative" : "no", fmt::join(moving, ", ")));
}

}  // namespace whirl_twin
