#include "scene/spread_correlations.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algebra/dense.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr double kRounding = 1.0e-6;  // of a matrix written with some ten digits

/// The place of a number among those that are spread.
std::optional<Eigen::Index> placeOf(const YAML::Node& path, const std::string& key,
                                    const EnsembleSpec& ensemble, Complaints& complaints) {
  std::vector<std::string> known;
  for (const Spread& spread : ensemble.spread) {
    known.push_back(spread.path);
  }
  const std::string name = path.IsScalar() ? path.Scalar() : "";
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    const std::string near = nearestName(name, known);
    complaints.add(key, fmt::format("must be parameters with a spread, found {}{}", shown(path),
                                    near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }
  if (!ensemble.spread[static_cast<std::size_t>(found - known.begin())].normal) {
    complaints.add(
        key,
        fmt::format("correlations need normal distributions (standard_deviation); {} is uniform",
                    quoted(name)));
    return std::nullopt;
  }
  return found - known.begin();
}

void readPair(const YAML::Node& entry, const std::string& key, const EnsembleSpec& ensemble,
              Eigen::MatrixXd& matrix, Complaints& complaints) {
  constexpr double kNone = 2.0;
  const double value = entry.IsSequence() && entry.size() == 3 && entry[2].IsScalar()
                           ? parseNumber(entry[2].Scalar()).value_or(kNone)
                           : kNone;
  if (std::fabs(value) > 1.0) {
    complaints.add(key, "must be [parameter, other parameter, correlation from -1 to 1]");
    return;
  }
  const auto a = placeOf(entry[0], key, ensemble, complaints);
  const auto b = placeOf(entry[1], key, ensemble, complaints);
  if (!a || !b) {
    return;
  }
  if (*a == *b || !std::isnan(matrix(*a, *b))) {
    complaints.add(key,
                   fmt::format("the correlation of {} and {} {}", quoted(entry[0].Scalar()),
                               quoted(entry[1].Scalar()), *a == *b ? "is 1" : "is given twice"));
    return;
  }
  matrix(*a, *b) = matrix(*b, *a) = value;
}

/// Cholesky's, of a matrix that may be singular.
Eigen::MatrixXd factorOf(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double left = matrix(j, j) - factor.row(j).head(j).squaredNorm();
    factor(j, j) = std::sqrt(std::fmax(left, 0.0));
    for (Eigen::Index i = j + 1; i < n && factor(j, j) > 0.0; ++i) {
      factor(i, j) =
          (matrix(i, j) - factor.row(i).head(j).dot(factor.row(j).head(j))) / factor(j, j);
    }
  }
  return factor;
}

}  // namespace

void readCorrelations(const YAML::Node& node, const std::string& key, EnsembleSpec& ensemble,
                      Complaints& complaints) {
  if (!node.IsSequence()) {
    complaints.add(
        key, fmt::format("must be a list of [parameter, other parameter, correlation], found {}",
                         shown(node)));
    return;
  }
  const auto n = static_cast<Eigen::Index>(ensemble.spread.size());
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  const std::size_t before = complaints.all().size();
  for (std::size_t i = 0; i < node.size(); ++i) {
    readPair(node[i], fmt::format("{}[{}]", key, i), ensemble, matrix, complaints);
  }
  if (complaints.all().size() > before) {
    return;
  }
  matrix = matrix.array().isNaN().select(Eigen::MatrixXd::Identity(n, n), matrix);
  const double lowest = symmetricEigenvalues(matrix).minCoeff();
  if (lowest < -kRounding) {
    complaints.add(
        key,
        fmt::format(
            "the correlation matrix must be positive semidefinite, found an eigenvalue of {:.3g}",
            lowest));
    return;
  }
  ensemble.factor = factorOf(matrix);
}

std::vector<double> correlated(const EnsembleSpec& ensemble,
                               const std::vector<double>& independent) {
  if (ensemble.factor.size() == 0) {
    return independent;
  }
  Eigen::VectorXd parts(ensemble.factor.rows());
  for (Eigen::Index i = 0; i < parts.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    parts[i] = independent[place] / ensemble.spread[place].width;
  }
  parts = ensemble.factor.triangularView<Eigen::Lower>() * parts;
  std::vector<double> deviations;
  for (const Spread& spread : ensemble.spread) {
    deviations.push_back(parts[static_cast<Eigen::Index>(deviations.size())] * spread.width);
  }
  return deviations;
}

std::vector<double> independent(const EnsembleSpec& ensemble,
                                const std::vector<double>& correlated) {
  if (ensemble.factor.size() == 0) {
    return correlated;
  }
  const Eigen::MatrixXd& factor = ensemble.factor;
  Eigen::VectorXd parts = Eigen::VectorXd::Zero(factor.rows());
  std::vector<double> deviations;
  for (Eigen::Index i = 0; i < parts.size(); ++i) {
    const Spread& spread = ensemble.spread[static_cast<std::size_t>(i)];
    const double left = correlated[static_cast<std::size_t>(i)] / spread.width -
                        factor.row(i).head(i).dot(parts.head(i));
    parts[i] = factor(i, i) > kRounding ? left / factor(i, i) : 0.0;
    deviations.push_back(parts[i] * spread.width);
  }
  return deviations;
}

}  // namespace whirl_twin
