// Equilibria of a system at a held shaft speed, and the one it operates about.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/stability.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

struct Equilibrium {
  Eigen::VectorXd q;  ///< angles in (-pi, pi]
  Stability stability;
};

/// All equilibria found at a constant speed [rad/s], by Newton's method from a grid of starts,
/// ascending: over the circle of an angle, as many natural lengths of a slide (eight circles where
/// it is the only coordinate). Loads that alternate are at their mean. Along a cyclic coordinate,
/// where nothing pulls, an equilibrium is the same everywhere: the one at 0 stands for all. One
/// where a coordinate has no inertia (a rotating pendulum without a hub, hanging) has no small
/// motion in these coordinates and is left out. A linear rotor has one, the bearing line; its
/// unbalance whirls it about it.
std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed);

/// Newton's method from q at a constant speed [rad/s]; nothing if it does not converge.
std::optional<Eigen::VectorXd> equilibriumNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                               double speed);

/// The bounded equilibrium nearest to q (angles by the shorter way round), or nothing.
std::optional<Equilibrium> operatingPoint(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                          double speed);

/// Linearization at rest in q at a constant speed [rad/s].
Linearization linearizationAtRest(const Dynamics& dynamics, const Eigen::VectorXd& q, double speed);

}  // namespace whirl_twin
