// Equilibria of a system at a constant shaft speed, and its operating point. For a system with
// cyclic coordinates these are its steady motions, or relative equilibria: the shape is constant
// while the cyclic coordinates turn or slide at constant rates (a cone of a free rotating pendulum,
// a flywheel with masses at a constant radius, a governed engine at its speed).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/cyclic_coordinates.h"
#include "analysis/floquet.h"
#include "analysis/stability.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

// Newton's method for a place of rest within bounds, and the continuation that finds it where
// Newton's method does not converge. The journals of a rotor in oil films rest within their
// clearances, the films stiffen without bound towards the wall, and a full step from the centre
// leaves the bearing.

/// A place of rest is where nothing pulls. The unknowns y may have any units.
struct RestProblem {
  /// What pulls at y.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y)> pull;
  /// The step of Newton's method at y that answers a pull.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y, const Eigen::VectorXd& pull)> step;
  /// Values that must stay positive, [m], one per bound; empty without bounds.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y)> room;
};

/// The equilibrium that a homotopy path from `start` leads to. On it the residual force at the
/// start is gradually removed, pull(y) = (1 - s) pull(start), s from 0 to 1 (Newton homotopy;
/// Allgower and Georg, Introduction to Numerical Continuation Methods, 2003): from journals at the
/// centres of their bearings s is the share of the load. The whole path is tried in one step first.
/// Nothing where the start violates the bounds or the path ends before s = 1, as where films do not
/// carry the load.
std::optional<Eigen::VectorXd> restWithinBounds(const RestProblem& problem,
                                                const Eigen::VectorXd& start);

struct Equilibrium {
  Eigen::VectorXd q;    ///< angles in (-pi, pi]; cyclic coordinates at 0
  Eigen::VectorXd v;    ///< zero but for cyclic coordinates
  Stability stability;  ///< of the shape, at constant momenta (reducedStability)
  /// The motion about it where what drives the system alternates: the stability is that of this
  /// motion, by its multipliers, and kUncertain where none was found.
  std::optional<PeriodicMotion> periodic = std::nullopt;
};

/// All equilibria found at a constant speed [rad/s], by Newton's method on the reduced potential
/// from a grid of starts, ascending: over the circle of an angle, as many natural lengths of a
/// slide (eight circles where it is the only coordinate); eight starts for each of up to four
/// coordinates, fewer for more. Conserved momenta are those of the motion through q and v.
/// Alternating loads are at their mean; where they have a common period the stability is that of
/// the nearby periodic motion (floquet.h). An equilibrium where a coordinate has no inertia (a
/// rotating pendulum without a hub, hanging) has no linearized motion in these coordinates and is
/// omitted. A linear system has one equilibrium under its constant loads, K q = load: a rotor with
/// weight sags, and its unbalance whirls it about that; none where a load acts along a direction
/// without stiffness.
std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed,
                                    const Eigen::VectorXd& q, const Eigen::VectorXd& v);
/// With all conserved momenta zero.
std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed);

/// Does a constant load act on a linear system along a direction without stiffness? It has no
/// equilibrium then, and moves away whatever its roots are: nothing is stable.
bool isUnsupported(const Dynamics& dynamics, double speed);

/// Newton's method from q at rest at a constant speed [rad/s]; nothing if it does not converge.
std::optional<Eigen::VectorXd> equilibriumNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                               double speed);

/// The bounded equilibrium that the overdamped shape creeps to from q (creepsTo): the end of the
/// motion after its oscillation has decayed, not necessarily the nearest one. From a maximum of the
/// potential, and where rates are driven, the nearest (angles in the shorter direction, without
/// cyclic coordinates; of several rates of a driven one the nearest). With the momenta of the
/// motion through q and v; nothing if there is none. For a nonlinear system without a
/// bounded one the nearest of the others: above its threshold speed a rotor whirls about an
/// unstable equilibrium. With alternating loads, bounded or not: the creeping mean motion may
/// settle where the motion itself grows.
std::optional<Equilibrium> operatingPoint(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                          const Eigen::VectorXd& v, double speed);
/// As operatingPoint(), among equilibria that are known.
std::optional<Equilibrium> operatingPointAmong(const Dynamics& dynamics,
                                               std::vector<Equilibrium> known,
                                               const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                               double speed);

/// Whether two are one: one shape, and one rate of every driven coordinate.
bool same(const Dynamics& dynamics, const CyclicCoordinates& cyclic, const Equilibrium& a,
          const Equilibrium& b);

/// The verdict kUncertain, without numbers: for a nonlinear system without a known equilibrium.
/// Away from one it is in no steady motion whose stability could be evaluated.
Stability unjudged();

/// Linearization at rest in q at a constant speed [rad/s].
Linearization linearizationAtRest(const Dynamics& dynamics, const Eigen::VectorXd& q, double speed);

/// Linearization about the steady motion through q with rates v.
Linearization linearizationAbout(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& v, double speed);

}  // namespace whirl_twin
