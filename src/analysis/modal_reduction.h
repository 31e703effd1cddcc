// Modal reduction of a linear rotor of many coordinates (Rayleigh-Ritz).
//
// Modes of the undamped rotor at rest alone converge slowly: they do not include bearing damping
// and gyroscopic moments. The shapes are therefore
//
//   the modes below the highest speed, four at least (which make the whirl modes of the run),
//   the sag under a constant load,
//   that under a force at each node where external forces act, and
//   the unbalance response at Chebyshev's speeds of the run, its real and its imaginary part,
//
// with which the response is exact at those speeds and its error falls geometrically with their
// number. For a two-disc rotor in bearings of 3 kN s/m, 28 coordinates, the error is
//
//   shapes           8       12      16      20
//   modes alone      3e-2    1e-2    3e-3    1e-3
//   these shapes     4e-3    4e-4    1e-5    3e-10
//
// Where modes alone have a smaller error (few shapes, many modes in the run) they are used. Shapes
// are orthogonal in M and K of the rotor at rest, by rising frequency, of unit largest
// displacement.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

/// How far the reduced rotor is from the full one, up to highest_speed.
struct ReductionError {
  /// [-] Largest relative difference of the synchronous unbalance response at the published
  /// station, over kResponseSpeeds speeds.
  double response = 0.0;
  /// [-] Largest relative difference of an eigenvalue with |s| below the highest speed, there.
  double eigenvalue = 0.0;
};

struct RotorReduction {
  Eigen::MatrixXd shapes;  ///< a column a coordinate [dof x n]
  ReductionError error;
  double highest_speed = 0.0;  ///< [rad/s]
  std::string note;            ///< what was kept, and why, in words
};

constexpr int kResponseSpeeds = 200;  ///< equally spaced

/// Twice the second critical speed, roughly: twice the fourth natural frequency of the rotor at
/// rest that is not zero (bending in two planes). [rad/s]
double usualHighestSpeed(const LinearRotor& rotor);

/// The rotor reduced to `count` shapes, 1 to dof. The unbalance is the rotor's own, or one at the
/// published station, the first of its `stations`, if it has none. `pushed`: a column for each
/// force that is not the rotor's own, [dof x any].
RotorReduction reduceRotor(const LinearRotor& rotor, const std::vector<Station>& stations,
                           double highest_speed, int count, const Eigen::MatrixXd& pushed = {});

/// The same with the smallest even number of shapes whose response error is below `tolerance`, and
/// whose eigenvalue error is below a hundredth of it: a run-up excites free whirls, whose phase
/// must be accurate for the hundred radians or so until they decay. All shapes if none is.
RotorReduction reduceRotorTo(const LinearRotor& rotor, const std::vector<Station>& stations,
                             double highest_speed, double tolerance,
                             const Eigen::MatrixXd& pushed = {});

}  // namespace whirl_twin
