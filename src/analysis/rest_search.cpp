#include "analysis/rest_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

constexpr int kMostCorrections = 40;   // at a point of the path
constexpr int kMostRestrictions = 60;  // halvings of a step that leaves the bounds
constexpr int kMostPathSteps = 2000;
constexpr double kShortestPathStep = 1.0e-7;
constexpr double kKept = 0.1;         // of its room, by a step
constexpr double kAtRest = 1.0e-14;   // of the place: a step that is none
constexpr double kOnPath = 1.0e-6;    // likewise, of a point on the way
constexpr double kRounding = 1.0e-7;  // likewise, where rounding lets no step be shorter
constexpr double kStalled = 0.5;      // of the step before: one that is no shorter is rounding

bool inside(const Eigen::VectorXd& room) {
  return room.size() == 0 || room.minCoeff() > 0.0;
}

bool keepsRoom(const Eigen::VectorXd& after, const Eigen::VectorXd& before) {
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    if (std::isfinite(before[i]) && !(after[i] > kKept * before[i])) {
      return false;
    }
  }
  return true;
}

/// From y to where the pull is `left`; nothing where Newton's method does not converge.
std::optional<Eigen::VectorXd> corrected(const RestProblem& problem, Eigen::VectorXd y,
                                         const Eigen::VectorXd& left, double tolerance) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostCorrections; ++i) {
    Eigen::VectorXd step = problem.step(y, problem.pull(y) - left);
    if (!step.allFinite()) {
      return std::nullopt;
    }
    const Eigen::VectorXd room = problem.room(y);
    int halvings = 0;
    while (!keepsRoom(problem.room(y + step), room)) {
      step *= 0.5;
      if (++halvings > kMostRestrictions) {
        return std::nullopt;
      }
    }
    y += step;
    const double length = step.norm();
    const double place = y.norm();
    if (halvings == 0 && (length <= tolerance * place ||
                          (length <= kRounding * place && length >= kStalled * before))) {
      return y;
    }
    before = halvings == 0 ? length : std::numeric_limits<double>::infinity();
  }
  return std::nullopt;
}

}  // namespace

std::optional<Eigen::VectorXd> restWithinBounds(const RestProblem& problem,
                                                const Eigen::VectorXd& start) {
  if (!inside(problem.room(start))) {
    return std::nullopt;
  }
  const Eigen::VectorXd pull = problem.pull(start);
  if (!pull.allFinite()) {
    return std::nullopt;
  }
  Eigen::VectorXd y = start;
  double share = 0.0;
  double stride = 1.0;
  for (int i = 0; i < kMostPathSteps && stride >= kShortestPathStep; ++i) {
    const double next = std::min(1.0, share + stride);
    const bool last = next == 1.0;
    const auto there = corrected(problem, y, (1.0 - next) * pull, last ? kAtRest : kOnPath);
    if (!there) {
      stride *= 0.25;
      continue;
    }
    if (last) {
      return there;
    }
    y = *there;
    share = next;
    stride *= 2.0;
  }
  return std::nullopt;
}

}  // namespace whirl_twin
