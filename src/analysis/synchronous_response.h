// Steady response of a linear rotor to its synchronous forces, unbalance and bow:
//
//   (K + N - w^2 M + i w (C + G)) X = F(w),   q = Re(X e^(i theta)), theta the shaft's angle.
//
// (Friswell et al., Dynamics of Rotating Machines, 2010, 6.3.) An amplitude's argument is its lead
// over the shaft's phase reference; probes show the lag, its negative.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/orbit.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

struct SynchronousResponse {
  double speed = 0.0;         ///< [rad/s]
  Eigen::VectorXcd q;         ///< X [dof]
  std::vector<Orbit> orbits;  ///< [m], at each station
};

/// The response to the rotor's own forces at one speed [rad/s].
SynchronousResponse synchronousResponse(const LinearRotor& rotor,
                                        const std::vector<Station>& stations, double speed);

/// The same over a range of speeds: `points` >= 2 equally spaced, and as many more as show every
/// peak whole. from < to.
std::vector<SynchronousResponse> synchronousSweep(const LinearRotor& rotor,
                                                  const std::vector<Station>& stations, double from,
                                                  double to, int points);

/// [rad] in (-pi, pi]: lag of the forward whirl behind the phase reference, at the angle
/// `phase_mark` [rad] on the shaft.
double phaseLag(const Orbit& orbit, double phase_mark);

/// Whether the rotor has a synchronous force.
bool hasSynchronousForce(const LinearRotor& rotor);

}  // namespace whirl_twin
