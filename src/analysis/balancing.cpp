#include "analysis/balancing.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

/// Condition number from which planes do the same.
constexpr double kSamePlanes = 1.0e12;

using Complex = std::complex<double>;

Eigen::VectorXcd reflected(const Eigen::VectorXcd& x, const std::vector<Eigen::Index>& places) {
  Eigen::VectorXcd other(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    other[places[static_cast<std::size_t>(i)]] = x[i];
  }
  return other;
}

/// [planes x runs], those of the reflected runs after those of the runs.
Eigen::MatrixXcd massesOf(const Influence& of) {
  const auto runs = static_cast<Eigen::Index>(of.runs.size());
  Eigen::MatrixXcd masses(of.runs.front().masses.size(), of.reflection ? 2 * runs : runs);
  for (Eigen::Index k = 0; k < runs; ++k) {
    masses.col(k) = of.runs[static_cast<std::size_t>(k)].masses;
    if (of.reflection) {
      masses.col(runs + k) = reflected(masses.col(k), of.reflection->planes);
    }
  }
  return masses;
}

/// M^+ [runs x planes]: A = (V - v_0) M^+.
Eigen::MatrixXcd shareOfRuns(const Eigen::MatrixXcd& masses) {
  // Trial masses of planes may differ by orders of magnitude: rows of one size.
  const Eigen::VectorXd size = masses.rowwise().norm();
  const Eigen::VectorXd singular =
      size.minCoeff() > 0.0
          ? singularValues(size.cwiseInverse().cast<Complex>().asDiagonal() * masses)
          : Eigen::VectorXd(Eigen::VectorXd::Zero(1));
  if (masses.cols() < masses.rows() || !(singular.minCoeff() * kSamePlanes > singular.maxCoeff())) {
    throw InputError(
        "balancing: the masses of the trial runs must separate the planes: as many runs as planes, "
        "with a mass in every plane, found runs that do not");
  }
  const Eigen::MatrixXcd unit = size.cwiseInverse().cast<Complex>().asDiagonal() * masses;
  return unit.adjoint() * (unit * unit.adjoint()).inverse() *
         size.cwiseInverse().cast<Complex>().asDiagonal();
}

void requireSizes(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                  const Eigen::VectorXd& weights) {
  if (influence.rows() != initial.size() || weights.size() != initial.size() ||
      !(weights.array() >= 0.0).all()) {
    throw InputError(
        fmt::format("balancing: expected {} readings and as many weights >= 0, found {} and {}",
                    influence.rows(), initial.size(), weights.size()));
  }
}

void putResidual(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                 BalanceCorrection& correction) {
  correction.residual = initial + influence * correction.mass_radius;
  correction.rms = correction.residual.norm() / std::sqrt(static_cast<double>(initial.size()));
}

}  // namespace

Influence influenceOfPlanes(const Eigen::VectorXcd& initial, std::vector<TrialRun> runs,
                            std::optional<Reflection> reflection) {
  for (const TrialRun& run : runs) {
    if (run.readings.size() != initial.size() || run.masses.size() != runs.front().masses.size()) {
      throw InputError(fmt::format(
          "balancing: expected {} readings of each run and a mass for each of {} planes, found {} "
          "and {}",
          initial.size(), runs.front().masses.size(), run.readings.size(), run.masses.size()));
    }
  }
  if (runs.empty()) {
    throw InputError("balancing: expected a trial run for every plane, found none");
  }
  Influence influence{{}, std::move(runs), std::move(reflection)};
  const Eigen::MatrixXcd masses = massesOf(influence);
  const auto count = static_cast<Eigen::Index>(influence.runs.size());
  Eigen::MatrixXcd changes(initial.size(), masses.cols());
  for (Eigen::Index k = 0; k < count; ++k) {
    changes.col(k) = influence.runs[static_cast<std::size_t>(k)].readings - initial;
    if (influence.reflection) {
      changes.col(count + k) = reflected(changes.col(k), influence.reflection->probes);
    }
  }
  influence.coefficients = changes * shareOfRuns(masses);
  return influence;
}

BalanceCorrection balance(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                          const Eigen::VectorXd& weights) {
  requireSizes(influence, initial, weights);
  const Eigen::VectorXcd root = weights.cwiseSqrt().cast<Complex>();
  const Eigen::MatrixXcd weighted = root.asDiagonal() * influence;
  BalanceCorrection correction;
  correction.mass_radius = leastSquares(weighted, -root.cwiseProduct(initial));
  putResidual(influence, initial, correction);
  const Eigen::VectorXd singular = singularValues(weighted);
  const bool enough = (weights.array() > 0.0).count() >= influence.cols();
  correction.condition = enough && singular.minCoeff() > 0.0
                             ? singular.maxCoeff() / singular.minCoeff()
                             : std::numeric_limits<double>::infinity();
  return correction;
}

BalanceCorrection balanceWithin(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                                const Eigen::VectorXd& weights, const Eigen::VectorXd& limits) {
  constexpr int kMaxSweeps = 100000;
  constexpr double kSettled = 1.0e-13;  // change in a sweep, relative to the masses
  BalanceCorrection correction = balance(influence, initial, weights);
  Eigen::VectorXcd& u = correction.mass_radius;
  if ((u.cwiseAbs().array() <= limits.array()).all()) {
    return correction;
  }
  const auto limited = [&](const Complex& mass, Eigen::Index plane) {
    const double size = std::abs(mass);
    return size > limits[plane] ? mass * (limits[plane] / size) : mass;
  };
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    u[j] = limited(u[j], j);
  }
  // The problem is convex. In one plane the sum of squares depends on the distance from its minimum
  // only, so that the limited minimum is exact, and planes in turn converge to that of all.
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double change = 0.0;
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      const auto column = influence.col(j);
      const double size = weights.dot(column.cwiseAbs2());
      if (!(size > 0.0)) {
        continue;
      }
      const Eigen::VectorXcd rest = initial + influence * u;
      const Complex step = column.dot(weights.cast<Complex>().cwiseProduct(rest)) / size;
      const Complex next = limited(u[j] - step, j);
      change = std::max(change, std::abs(next - u[j]));
      u[j] = next;
    }
    if (!(change > kSettled * u.norm())) {
      break;
    }
  }
  putResidual(influence, initial, correction);
  return correction;
}

std::optional<CorrectionSpread> correctionSpread(const Influence& of,
                                                 const Eigen::VectorXd& weights,
                                                 const BalanceCorrection& correction,
                                                 double deviation) {
  const Eigen::MatrixXcd& influence = of.coefficients;
  const Eigen::Index spare = (weights.array() > 0.0).count() - influence.cols();
  if (!(correction.condition < kSamePlanes) || (deviation == 0.0 && spare < 1)) {
    return std::nullopt;
  }
  const Eigen::MatrixXcd weighted = weights.cast<Complex>().asDiagonal() * influence;
  const Eigen::MatrixXcd inverse = (influence.adjoint() * weighted).inverse();
  CorrectionSpread spread;
  if (deviation == 0.0) {
    // The residual has the errors of the first run and of A u together, as the correction has.
    const double squares = weights.dot(correction.residual.cwiseAbs2());
    const auto free = static_cast<double>(2 * spare);
    spread.deviation = (squares / free * inverse.diagonal().real()).cwiseSqrt();
    spread.within95 = boost::math::quantile(boost::math::students_t(free), 0.975);
    return spread;
  }
  // du = -inverse A* W (dv_0 + dA u), dA u = sum over the runs of (dv_run - dv_0) p_run, where
  // p = M^+ u, and of their reflections R (dv_run - dv_0) p_reflected.
  const Eigen::Index readings = influence.rows();
  const auto unit = Eigen::MatrixXcd::Identity(readings, readings);
  Eigen::MatrixXcd of_first = unit, errors = Eigen::MatrixXcd::Zero(readings, readings);
  if (!of.runs.empty()) {
    Eigen::MatrixXcd reflection = Eigen::MatrixXcd::Zero(readings, readings);
    for (Eigen::Index i = 0; of.reflection && i < readings; ++i) {
      reflection(of.reflection->probes[static_cast<std::size_t>(i)], i) = 1.0;
    }
    const Eigen::VectorXcd p = shareOfRuns(massesOf(of)) * correction.mass_radius;
    const auto runs = static_cast<Eigen::Index>(of.runs.size());
    for (Eigen::Index k = 0; k < runs; ++k) {
      const Eigen::MatrixXcd one =
          p[k] * unit + (of.reflection ? p[runs + k] : Complex(0.0)) * reflection;
      of_first -= one;
      errors += one * one.adjoint();
    }
  }
  errors += of_first * of_first.adjoint();
  const Eigen::MatrixXcd covariance =
      inverse * (weighted.adjoint() * errors * weighted) * inverse.adjoint();
  spread.deviation = deviation * covariance.diagonal().real().cwiseSqrt();
  spread.within95 = 1.959963984540054;
  return spread;
}

std::vector<PartOfMass> partsAtPlaces(const std::complex<double>& mass_radius,
                                      std::vector<double> places) {
  constexpr double kAtPlace = 1.0e-4;  // rad: no place is known better
  for (double& place : places) {
    place = std::remainder(place, kTwoPi);
    place += place < 0.0 ? kTwoPi : 0.0;
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end(),
                           [](double a, double b) { return b - a <= kAtPlace; }),
               places.end());
  double widest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double next = i + 1 < places.size() ? places[i + 1] : places.front() + kTwoPi;
    widest = std::max(widest, next - places[i]);
  }
  if (places.size() < 3 || widest > kPi - kAtPlace) {
    throw InputError(
        fmt::format("balancing: places must be less than 180 deg apart, found {} places with a gap "
                    "of {:.4g} deg",
                    places.size(), places.empty() ? 360.0 : widest / kDegree));
  }
  const double size = std::abs(mass_radius);
  double angle = std::remainder(std::arg(mass_radius), kTwoPi);
  angle += angle < places.front() ? kTwoPi : 0.0;
  angle += angle < places.front() ? kTwoPi : 0.0;
  const auto above = std::upper_bound(places.begin(), places.end(), angle + kAtPlace);
  const double low = *std::prev(above);
  const double high = above == places.end() ? places.front() + kTwoPi : *above;
  if (angle - low <= kAtPlace) {
    return {{low, size}};
  }
  if (high - angle <= kAtPlace) {
    return {{std::fmod(high, kTwoPi), size}};
  }
  return {{low, size * std::sin(high - angle) / std::sin(high - low)},
          {std::fmod(high, kTwoPi), size * std::sin(angle - low) / std::sin(high - low)}};
}

}  // namespace whirl_twin
