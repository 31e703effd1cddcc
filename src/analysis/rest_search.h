// Newton's method for a place of rest within bounds, and the continuation that finds it where
// Newton's method does not converge. The journals of a rotor in oil films rest within their
// clearances, the films stiffen without bound towards the wall, and a full step from the centre
// leaves the bearing.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace whirl_twin {

/// A place of rest is where nothing pulls. The unknowns y may have any units.
struct RestProblem {
  /// What pulls at y.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y)> pull;
  /// The step of Newton's method at y that answers a pull.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y, const Eigen::VectorXd& pull)> step;
  /// What must stay positive, [m], one entry for each bound; empty where nothing is bounded.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y)> room;
};

/// The place of rest that the path from `start` leads to. On it the pull at the start is taken away
/// little by little, pull(y) = (1 - s) pull(start), s from 0 to 1 (Newton homotopy; Allgower and
/// Georg, Introduction to Numerical Continuation Methods, 2003): from journals at the centres of
/// their bearings s is the share of the load. The whole way is tried in one step first. Nothing
/// where the start has no room or the path ends before, as where films do not carry the load.
std::optional<Eigen::VectorXd> restWithinBounds(const RestProblem& problem,
                                                const Eigen::VectorXd& start);

}  // namespace whirl_twin
