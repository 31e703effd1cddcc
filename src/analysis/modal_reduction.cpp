#include "analysis/modal_reduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "algebra/sparse_solver.h"
#include "analysis/refined_eigenvalues.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr Index kMinModes = 4;                  // two in each plane
constexpr double kSameShape = 1.0e-9;           // what orthogonalization may leave of a shape
constexpr double kTurnsOfFreeWhirl = 100.0;     // [rad] that a run-up's free whirl lives for
constexpr double kEigenvalueRounding = 1.0e-9;  // of stiff rotors
constexpr double kEveryError = std::numeric_limits<double>::infinity();
constexpr double kAsFar = 1.0e-3;               // what is hardly farther is not
constexpr double kSameSquare = 1.0e-8;          // of squares of frequencies that are one
constexpr double kRoundingOfSquares = 1.0e-13;  // of the largest
constexpr double kRigidFrequency = 1.0e-5;      // of the highest frequency: a rigid-body mode
constexpr double kAtRest = 0.1;                 // of the lowest frequency: nearly at rest

struct RestModes {
  VectorXd frequencies;  ///< [rad/s], ascending
  MatrixXd shapes;
};

RestModes restModes(const Linearization& l) {
  const SymmetricModes<double> solver = generalizedModes(l.stiffness, l.mass);
  return {solver.values.cwiseMax(0.0).cwiseSqrt(), solver.vectors};
}

/// Everything about the full rotor that the search for shapes needs.
class FullRotor {
 public:
  FullRotor(const LinearRotor& rotor, const std::vector<Station>& stations, double highest_speed,
            const MatrixXd& pushed)
      : rotor_(rotor), stations_(stations), highest_(highest_speed), pushed_(pushed) {
    const bool balanced = rotor_.synchronousForce(1.0).isZero(0.0);
    if (balanced) {
      const Station& at = stations_.front();
      rotor_.forces.push_back(
          {at.along_x.cast<Complex>() - Complex(0.0, 1.0) * at.along_y, 1, true});
    }
    middle_ = rotor_.matrices(0.5 * highest_);
    modes_ = restModes(middle_);
    points_.reserve(kResponseSpeeds);
    for (int i = 1; i <= kResponseSpeeds; ++i) {
      points_.push_back(pointAt(highest_ * i / kResponseSpeeds));
    }
  }

  Index dof() const { return rotor_.dof(); }
  /// Modes that the run passes, and four at least.
  Index modesOfTheRun() const {
    const auto below = (modes_.frequencies.array() < highest_).count();
    return std::min(dof(), std::max<Index>(kMinModes, below));
  }

  bool isPushed() const { return pushed_.cols() > 0; }
  /// The first shapes, retained in every choice.
  Index fewest() const {
    const Index needed =
        isPushed() ? modesOfTheRun() + (rotor_.load.isZero(0.0) ? 0 : 1) + pushed_.cols() : 2;
    return std::min(dof(), needed + needed % 2);
  }

  /// `count` shapes, the first `modes` of them modes.
  MatrixXd shapes(Index count, Index modes) const {
    MatrixXd kept(dof(), 0);
    for (Index i = 0; i < std::min(modes, count); ++i) {
      keep(modes_.shapes.col(i), count, kept);
    }
    if (!rotor_.load.isZero(0.0)) {
      keep(Lu(middle_.stiffness + middle_.circulatory).solve(rotor_.load), count, kept);
    }
    if (isPushed()) {
      const Lu held(middle_.stiffness + middle_.circulatory + slowly() * slowly() * middle_.mass);
      for (Index i = 0; i < pushed_.cols(); ++i) {
        keep(held.solve(pushed_.col(i)), count, kept);
      }
    }
    const Index points = (count - kept.cols() + 1) / 2;
    for (Index i = 0; i < points; ++i) {
      const double place =
          std::cos(kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(points));
      const VectorXcd whirl = response(pointAt(0.5 * highest_ * (1.0 - place)));
      keep(whirl.real(), count, kept);
      keep(whirl.imag(), count, kept);
    }
    for (Index i = modes; i < dof(); ++i) {
      keep(modes_.shapes.col(i), count, kept);
    }
    return modal(kept);
  }

  /// Stops once it is above `enough`.
  double responseError(const MatrixXd& shapes, double enough) const {
    double worst = 0.0;
    const Eigen::MatrixXcd complex_shapes = shapes.cast<Complex>();
    for (const SpeedPoint& point : points_) {
      const Eigen::MatrixXcd moved = point.dynamic * complex_shapes;
      const Eigen::MatrixXcd dynamic = shapes.transpose() * moved;
      const VectorXcd force = shapes.transpose() * point.force;
      const Eigen::Vector2cd found = atStation(shapes * ComplexLu(dynamic).solve(force));
      const double error = (found - point.response).norm() / point.response.norm();
      worst = std::isfinite(error) ? std::max(worst, error) : worst;
      if (worst > enough) {
        break;
      }
    }
    return worst;
  }

  double eigenvalueError(const MatrixXd& shapes) const {
    return largestEigenvalueError(rotor_.matrices(highest_), reduced(highest_, shapes), shapes,
                                  highest_);
  }

  double highestSpeed() const { return highest_; }

 private:
  Linearization reduced(double speed, const MatrixXd& shapes) const {
    const Linearization l = rotor_.matrices(speed);
    const auto part = [&](const MatrixXd& m) -> MatrixXd {
      return shapes.transpose() * (m * shapes);
    };
    return {part(l.mass), part(l.damping), part(l.gyroscopic), part(l.stiffness),
            part(l.circulatory)};
  }

  /// [rad/s], that is nearly rest to all but a motion as a rigid body.
  double slowly() const {
    const double rigid = kRigidFrequency * modes_.frequencies[dof() - 1];
    const auto first = (modes_.frequencies.array() <= rigid).count();
    return kAtRest * modes_.frequencies[std::min(dof() - 1, Index{first})];
  }

  struct SpeedPoint {
    ComplexSparseMatrix dynamic;  // K - w^2 M + i w C
    VectorXcd force;
    Eigen::Vector2cd response;
  };

  SpeedPoint pointAt(double speed) const {
    const Linearization l = rotor_.matrices(speed);
    const auto dynamic = (l.stiffness + l.circulatory - speed * speed * l.mass).cast<Complex>() +
                         Complex(0.0, speed) * (l.damping + l.gyroscopic);
    SpeedPoint point{dynamic.sparseView(), rotor_.synchronousForce(speed), {}};
    point.response = atStation(response(point));
    return point;
  }

  /// Not a number at an undamped critical speed.
  VectorXcd response(const SpeedPoint& point) const {
    return solver_.solve(point.dynamic, point.force);
  }

  Eigen::Vector2cd atStation(const VectorXcd& q) const {
    const Station& at = stations_.front();
    return {at.along_x.cast<Complex>().cwiseProduct(q).sum(),
            at.along_y.cast<Complex>().cwiseProduct(q).sum()};
  }

  /// Adds the new part of a shape, mass-orthonormal, unless there are `count` already.
  void keep(VectorXd shape, Index count, MatrixXd& kept) const {
    const MatrixXd& mass = middle_.mass;
    shape /= std::sqrt(shape.dot(mass * shape));
    if (kept.cols() >= count || !shape.allFinite()) {
      return;
    }
    for (int pass = 0; pass < 2; ++pass) {
      shape -= kept * (kept.transpose() * (mass * shape));
    }
    const double rest = std::sqrt(shape.dot(mass * shape));
    if (rest > kSameShape) {
      kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
      kept.rightCols(1) = shape / rest;
    }
  }

  /// Any combination of shapes of equal frequency is a mode: the choice must not depend on
  /// rounding, or a coordinate would have a different meaning on a different machine. The first
  /// shape moves the station with the largest motion (the first such station), along its x or else
  /// its y, in positive direction; the others have a node there, and so on.
  void order(Eigen::Ref<MatrixXd> shapes) const {
    for (Index i = 0; i < shapes.cols(); ++i) {
      auto rest = shapes.rightCols(shapes.cols() - i);
      Eigen::RowVectorXd farthest = Eigen::RowVectorXd::Zero(rest.cols());
      for (const Station& station : stations_) {
        for (const VectorXd* along : {&station.along_x, &station.along_y}) {
          const Eigen::RowVectorXd moved = along->transpose() * rest;
          if (moved.norm() > (1.0 + kAsFar) * farthest.norm()) {
            farthest = moved;
          }
        }
      }
      // Householder's reflection to the first of them, then forward.
      VectorXd w = farthest.transpose();
      const double sign = w[0] < 0.0 ? -1.0 : 1.0;
      w[0] += sign * farthest.norm();
      if (w.squaredNorm() > 0.0) {
        const VectorXd along = rest * w;
        rest -= (2.0 / w.squaredNorm()) * along * w.transpose();
        rest.col(0) *= -sign;
      }
    }
  }

  /// The rotor's modes in these shapes, of unit largest displacement at a station.
  MatrixXd modal(const MatrixXd& shapes) const {
    const MatrixXd stiffness = shapes.transpose() * middle_.stiffness * shapes;
    const SymmetricModes<double> solver = symmetricModes(0.5 * (stiffness + stiffness.transpose()));
    MatrixXd modes = shapes * solver.vectors;
    const VectorXd& squares = solver.values;
    const double rounding = kRoundingOfSquares * squares.cwiseAbs().maxCoeff();
    for (Index first = 0, end = 1; first < modes.cols(); first = end++) {
      while (end < modes.cols() &&
             squares[end] - squares[end - 1] <= rounding + kSameSquare * std::fabs(squares[end])) {
        ++end;
      }
      order(modes.middleCols(first, end - first));
    }
    for (Index i = 0; i < modes.cols(); ++i) {
      double largest = 0.0;
      for (const Station& station : stations_) {
        largest = std::max(largest, std::hypot(station.along_x.dot(modes.col(i)),
                                               station.along_y.dot(modes.col(i))));
      }
      modes.col(i) /= largest;
    }
    return modes;
  }

  LinearRotor rotor_;
  std::vector<Station> stations_;
  double highest_;
  MatrixXd pushed_;
  Linearization middle_;  // at half the highest speed: bearings may follow it
  RestModes modes_;
  std::vector<SpeedPoint> points_;
  mutable SparseSolver solver_;
};

struct Choice {
  MatrixXd shapes;
  double response_error = 0.0;
  Index modes = 0;
};

/// Modes alone, or those of the run and the response: which is better is measured, and modes alone
/// are none where it is pushed. Errors above `enough` are not measured to the end.
Choice choose(const FullRotor& full, Index count, double enough) {
  Choice best;
  for (const Index modes : {std::min(count, full.modesOfTheRun()), count}) {
    MatrixXd shapes = full.shapes(count, modes);
    const double error = full.responseError(shapes, enough);
    if (best.modes == 0 || error < best.response_error) {
      best = {std::move(shapes), error, modes};
    }
    if (modes == count || full.isPushed()) {
      break;
    }
  }
  return best;
}

RotorReduction report(const FullRotor& full, const Choice& choice, const std::string& why) {
  RotorReduction r;
  r.shapes = choice.shapes;
  r.error = {choice.response_error, full.eigenvalueError(choice.shapes)};
  r.highest_speed = full.highestSpeed();
  const Index others = choice.shapes.cols() - choice.modes;
  r.note = fmt::format(
      "{} of {} modes{}: response error {:.1e}{} up to {:.4g} rad/s, eigenvalue error {:.1e}",
      choice.shapes.cols(), full.dof(),
      others > 0 ? fmt::format(" ({} of them response vectors)", others) : "", r.error.response,
      why, r.highest_speed, r.error.eigenvalue);
  return r;
}

}  // namespace

double usualHighestSpeed(const LinearRotor& rotor) {
  const RestModes modes = restModes(rotor.matrices(0.0));
  const Index n = modes.frequencies.size();
  const double rigid = kRigidFrequency * modes.frequencies[n - 1];
  const auto first = (modes.frequencies.array() <= rigid).count();
  return 2.0 * modes.frequencies[std::min(n - 1, first + kMinModes - 1)];
}

RotorReduction reduceRotor(const LinearRotor& rotor, const std::vector<Station>& stations,
                           double highest_speed, int count, const MatrixXd& pushed) {
  const FullRotor full(rotor, stations, highest_speed, pushed);
  return report(full, choose(full, std::min<Index>(count, full.dof()), kEveryError), "");
}

RotorReduction reduceRotorTo(const LinearRotor& rotor, const std::vector<Station>& stations,
                             double highest_speed, double tolerance, const MatrixXd& pushed) {
  const FullRotor full(rotor, stations, highest_speed, pushed);
  for (Index count = full.fewest();; count = std::min(count + 2, full.dof())) {
    const Choice choice = choose(full, count, tolerance);
    if (choice.response_error <= tolerance) {
      RotorReduction r = report(full, choice, fmt::format(" <= {:.3g}", tolerance));
      if (r.error.eigenvalue <= std::max(tolerance / kTurnsOfFreeWhirl, kEigenvalueRounding)) {
        return r;
      }
    }
    if (count == full.dof()) {
      return report(full, choose(full, count, kEveryError),
                    fmt::format(" (required {:.3g})", tolerance));
    }
  }
}

}  // namespace whirl_twin
