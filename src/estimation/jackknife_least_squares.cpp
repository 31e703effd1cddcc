#include "estimation/jackknife_least_squares.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxDataParts = 240;  // then pairs are merged
/// Smallest eigenvalue above rounding of the normal equations normalized by their diagonal.
constexpr double kMinEigenvalue = 1.0e-11;
/// Fraction of all that is explained: with a larger standard deviation an unknown or a direction is
/// unidentifiable.
constexpr double kMaxUncertain = 0.3;
constexpr std::size_t kGroups = 20;              // of parts, left out one by one
constexpr double kRoundingParticipation = 0.01;  // smallest share in a direction of rounding

}  // namespace

/// Independent directions of the unknowns; size: the sum of squares explained by each.
struct JackknifeLeastSquares::Directions {
  Eigen::MatrixXd plain;    // in units of what each unknown alone explains
  Eigen::MatrixXd columns;  // in the unknowns' own units
  Eigen::VectorXd size;
  std::vector<bool> identifiable;

  Eigen::VectorXd solved(const Eigen::VectorXd& right) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(right.size());
    for (Eigen::Index i = 0; i < size.size(); ++i) {
      if (identifiable[static_cast<std::size_t>(i)]) {
        x += columns.col(i) * (columns.col(i).dot(right) / size[i]);
      }
    }
    return x;
  }
};

JackknifeLeastSquares::Directions JackknifeLeastSquares::directionsOf(
    const Eigen::MatrixXd& normal) {
  Eigen::VectorXd unit = normal.diagonal();
  for (double& u : unit) {
    u = u > 0.0 ? 1.0 / std::sqrt(u) : 0.0;
  }
  const SymmetricModes<double> eigen =
      symmetricModes(unit.asDiagonal() * normal * unit.asDiagonal());
  Directions all;
  all.plain = eigen.vectors;
  all.columns = unit.asDiagonal() * all.plain;
  all.size = eigen.values;
  for (const double size : all.size) {
    all.identifiable.push_back(size > kMinEigenvalue);
  }
  return all;
}

void JackknifeLeastSquares::Part::add(const Part& other) {
  normal += other.normal;
  right += other.right;
  squares += other.squares;
  values += other.values;
}

JackknifeLeastSquares::Part JackknifeLeastSquares::nothing() const {
  return {Eigen::MatrixXd::Zero(unknowns_, unknowns_), Eigen::VectorXd::Zero(unknowns_), 0.0, 0};
}

JackknifeLeastSquares::Part& JackknifeLeastSquares::current() {
  if (!parts_.empty() && parts_.back().values < part_values_) {
    return parts_.back();
  }
  if (parts_.size() == kMaxDataParts) {
    for (std::size_t i = 0; i < kMaxDataParts / 2; ++i) {
      Part both = std::move(parts_[2 * i]);
      both.add(parts_[2 * i + 1]);
      parts_[i] = std::move(both);
    }
    parts_.resize(kMaxDataParts / 2);
    part_values_ *= 2;
  }
  parts_.push_back(nothing());
  return parts_.back();
}

void JackknifeLeastSquares::add(const std::vector<Eigen::Index>& places,
                                const std::vector<double>& row, double value) {
  Part& part = current();
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      part.normal(places[i], places[k]) += row[i] * row[k];
    }
    part.right[places[i]] += row[i] * value;
  }
  part.squares += value * value;
  ++part.values;
}

/// Change of the solution along the identifiable directions without one of the groups of parts, one
/// group per column: the sum of their squares is its variance (the jackknife).
Eigen::MatrixXd JackknifeLeastSquares::withoutParts(const Directions& directions,
                                                    const Eigen::VectorXd& x) const {
  const std::size_t groups = std::min(kGroups, parts_.size());
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(unknowns_, static_cast<Eigen::Index>(groups));
  for (std::size_t g = 0; g < groups; ++g) {
    Part group = nothing();
    for (std::size_t i = g * parts_.size() / groups; i < (g + 1) * parts_.size() / groups; ++i) {
      group.add(parts_[i]);
    }
    Eigen::MatrixXd left = -(directions.columns.transpose() * group.normal * directions.columns);
    Eigen::VectorXd score = directions.columns.transpose() * (group.right - group.normal * x);
    left.diagonal() += directions.size;
    for (Eigen::Index i = 0; i < unknowns_; ++i) {
      if (!directions.identifiable[static_cast<std::size_t>(i)]) {
        left.row(i).setZero();
        left.col(i).setZero();
        left(i, i) = 1.0;
        score[i] = 0.0;
      }
    }
    changes.col(static_cast<Eigen::Index>(g)) = Ldlt(left).solve(score);
  }
  const auto count = static_cast<double>(groups);
  return changes * std::sqrt(groups > 1 ? (count - 1.0) / count : 1.0);
}

JackknifeSolution JackknifeLeastSquares::solve() const {
  if (parts_.empty()) {
    throw std::logic_error("PartedLeastSquares: expected a row");
  }
  Part all = nothing();
  for (const Part& part : parts_) {
    all.add(part);
  }
  Directions directions = directionsOf(all.normal);
  const Eigen::VectorXd first = directions.solved(all.right);
  const double rest = all.squares - 2.0 * first.dot(all.right) + first.dot(all.normal * first);

  JackknifeSolution solution;
  solution.values = all.values;
  solution.variance =
      std::max(0.0, rest) / std::max(1.0, static_cast<double>(all.values - unknowns_));
  solution.explained = first.dot(all.right);
  for (Eigen::Index i = unknowns_ - constants_; i < unknowns_; ++i) {
    solution.explained -=
        all.normal(i, i) > 0.0 ? std::pow(all.right[i], 2.0) / all.normal(i, i) : 0.0;
  }
  solution.explained = std::max(0.0, solution.explained);

  solution.x = first;
  const Eigen::MatrixXd changes = withoutParts(directions, first);
  Eigen::ArrayXd white = Eigen::ArrayXd::Zero(unknowns_);
  for (Eigen::Index i = 0; i < unknowns_; ++i) {
    if (directions.identifiable[static_cast<std::size_t>(i)]) {
      white += solution.variance * directions.columns.col(i).array().square() / directions.size[i];
    }
  }
  solution.deviation =
      (directions.columns * changes).array().square().rowwise().sum().max(white).sqrt();

  // In units of what each explains alone, an unknown or a direction with a standard deviation above
  // this fraction of all that is explained is not identifiable.
  const double most = kMaxUncertain * std::sqrt(solution.explained);
  std::vector<Eigen::Index> unidentifiable;
  for (Eigen::Index k = 0; k < unknowns_; ++k) {
    solution.identifiable.push_back(solution.deviation[k] * std::sqrt(all.normal(k, k)) <= most);
  }
  for (Eigen::Index i = 0; i < unknowns_; ++i) {
    const bool rounding = !directions.identifiable[static_cast<std::size_t>(i)];
    const double variance =
        std::max(changes.row(i).squaredNorm(), solution.variance / directions.size[i]);
    if (rounding || variance > most * most) {
      unidentifiable.push_back(i);
    }
    for (Eigen::Index k = 0; k < unknowns_ && rounding; ++k) {
      if (std::fabs(directions.plain(k, i)) > kRoundingParticipation) {
        solution.identifiable[static_cast<std::size_t>(k)] = false;
      }
    }
  }
  solution.unidentifiable.resize(unknowns_, static_cast<Eigen::Index>(unidentifiable.size()));
  for (std::size_t i = 0; i < unidentifiable.size(); ++i) {
    solution.unidentifiable.col(static_cast<Eigen::Index>(i)) =
        directions.columns.col(unidentifiable[i]);
  }
  return solution;
}

}  // namespace whirl_twin
