#include "analysis/approximate_frequencies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/frequency_response.h"
#include "analysis/natural_modes.h"
#include "analysis/quadratic_form.h"
#include "messages/input_error.h"

namespace whirl_twin {

DunkerleyBound dunkerleyBound(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  requireSameSize(mass, stiffness);
  requirePositiveDefinite(mass, "mass");
  const Eigen::VectorXd terms = (influenceCoefficients(stiffness) * mass).diagonal();
  return {1.0 / std::sqrt(terms.sum()), terms};
}

namespace {

void requireSize(const Eigen::VectorXd& vector, const Eigen::MatrixXd& matrix, const char* what) {
  if (vector.size() != matrix.rows()) {
    throw std::logic_error(
        fmt::format("{}: expected {} entries, found {}", what, matrix.rows(), vector.size()));
  }
}

}  // namespace

double rayleighFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                         const Eigen::VectorXd& shape) {
  requireSameSize(mass, stiffness);
  requirePositiveDefinite(mass, "mass");
  requireSymmetric(stiffness, "stiffness");
  requireSize(shape, mass, "assumed shape");
  if (!shape.allFinite() || shape.isZero(0.0)) {
    throw InputError("assumed shape: expected finite entries, not all of them zero");
  }
  const Eigen::VectorXd phi = shape / shape.cwiseAbs().maxCoeff();
  const double squared = phi.dot(stiffness * phi) / phi.dot(mass * phi);
  // A rigid-body shape leaves the rounding of the sum, which can be negative.
  const double rounding =
      1e-12 * phi.cwiseAbs().dot(stiffness.cwiseAbs() * phi.cwiseAbs()) / phi.dot(mass * phi);
  if (squared < -rounding) {
    throw RunFailure(
        fmt::format("Rayleigh's quotient: the stiffness is negative for the assumed shape, p^2 = "
                    "{:.6g} (rad/s)^2: the position is statically unstable",
                    squared));
  }
  return std::sqrt(squared > 0.0 ? squared : 0.0);
}

Eigen::VectorXd staticDeflection(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load) {
  requireSize(load, stiffness, "load");
  return influenceCoefficients(stiffness) * load;
}

Eigen::VectorXd weight(const Eigen::MatrixXd& mass, const Eigen::VectorXd& down, double gravity) {
  requireSize(down, mass, "direction of the weight");
  return gravity * (mass * down);
}

namespace {

constexpr double kDisturbance = 1e-3;  // of a converged shape of length 1

class Iteration {
 public:
  Iteration(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
            const IterationLimits& limits)
      : mass_(mass),
        stiffness_(stiffness),
        dynamical_(influenceCoefficients(stiffness) * mass),
        limits_(limits),
        found_(mass.rows(), 0) {}

  IteratedMode next(const Eigen::VectorXd& start) {
    IteratedMode mode;
    Eigen::VectorXd x = swept(start);
    // A start within the modes already found has nothing left.
    x = normalised(length(x) > 1e-6 * length(start) ? x : leastSwept());
    bool disturbed = false;
    Eigen::VectorXd pushed = swept(dynamical_ * x);
    while (!mode.converged && static_cast<int>(mode.history.size()) < limits_.most_steps) {
      x = normalised(pushed);
      pushed = swept(dynamical_ * x);
      const double squared = x.dot(stiffness_ * x);
      mode.history.push_back(std::sqrt(squared));
      if (length(pushed - x / squared) <= limits_.tolerance / squared) {
        mode.converged = disturbed;
        mode.shape = x;
        if (!disturbed) {
          disturbed = true;
          pushed = swept(dynamical_ * (x + kDisturbance * normalised(disturbance())));
        }
      }
    }
    mode.shape = x;
    mode.frequency = mode.history.empty() ? std::sqrt(x.dot(stiffness_ * x)) : mode.history.back();
    found_.conservativeResize(Eigen::NoChange, found_.cols() + 1);
    found_.col(found_.cols() - 1) = x;
    return mode;
  }

  // Some part of every mode: numbers without a pattern (multiples of the golden ratio, folded), so
  // that no symmetry of the system makes it orthogonal to a mode.
  Eigen::VectorXd disturbance() const {
    Eigen::VectorXd x(mass_.rows());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double multiple = 0.6180339887498949 * static_cast<double>(i + 1);
      x[i] = (0.25 + multiple - std::floor(multiple)) / std::sqrt(mass_(i, i));
    }
    return x;
  }

 private:
  double length(const Eigen::VectorXd& x) const { return std::sqrt(x.dot(mass_ * x)); }
  Eigen::VectorXd normalised(const Eigen::VectorXd& x) const { return x / length(x); }
  Eigen::VectorXd swept(Eigen::VectorXd x) const {
    for (int again = 0; again < 2; ++again) {  // the second time takes out the first's rounding
      x -= found_ * (found_.transpose() * (mass_ * x));
    }
    return x;
  }

  // The motion of one coordinate that keeps most of itself when swept.
  Eigen::VectorXd leastSwept() const {
    Eigen::VectorXd best = Eigen::VectorXd::Zero(mass_.rows());
    for (Eigen::Index i = 0; i < mass_.rows(); ++i) {
      const Eigen::VectorXd one =
          swept(Eigen::VectorXd::Unit(mass_.rows(), i) / std::sqrt(mass_(i, i)));
      if (length(one) > length(best)) {
        best = one;
      }
    }
    return best;
  }

  Eigen::MatrixXd mass_, stiffness_, dynamical_;
  IterationLimits limits_;
  Eigen::MatrixXd found_;  // mass-normalised modes
};

}  // namespace

std::vector<IteratedMode> matrixIteration(const Eigen::MatrixXd& mass,
                                          const Eigen::MatrixXd& stiffness, int count,
                                          const Eigen::VectorXd& start,
                                          const IterationLimits& limits) {
  requireSameSize(mass, stiffness);
  requirePositiveDefinite(mass, "mass");
  const Eigen::Index n = mass.rows();
  if (start.size() != n || !start.allFinite() || start.isZero(0.0)) {
    throw InputError(
        fmt::format("matrix iteration: expected a start of {} finite entries that is not zero", n));
  }
  if (count < 1 || count > n) {
    throw InputError(fmt::format("matrix iteration: expected 1 to {} modes, found {}", n, count));
  }
  Iteration iteration(mass, stiffness, limits);
  std::vector<IteratedMode> modes{iteration.next(start)};
  while (modes.back().converged && static_cast<int>(modes.size()) < count) {
    modes.push_back(iteration.next(iteration.disturbance()));
  }
  // Equal roots come out in the order of their rounding.
  std::stable_sort(modes.begin(), modes.end(), [](const IteratedMode& a, const IteratedMode& b) {
    return a.frequency < b.frequency;
  });
  return modes;
}

}  // namespace whirl_twin
