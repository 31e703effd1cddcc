// Free whirl of a linear rotor at a constant speed: the solutions q = Re(phi e^(s t)) of
//
//   M q'' + (C + G) q' + (K + N) q = 0,
//
// each with its natural frequency |s|, damped frequency Im s, damping ratio zeta = -Re s / |s|,
// logarithmic decrement 2 pi zeta / sqrt(1 - zeta^2) and the orbit it runs at every station
// (Genta, Dynamics of Rotating Systems, 2005; Friswell et al., Dynamics of Rotating Machines,
// 2010).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "analysis/orbit.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/linearization.h"

namespace whirl_twin {

struct WhirlMode {
  std::complex<double> eigenvalue;  ///< s [1/s], Im s > 0
  Eigen::VectorXcd shape;           ///< phi [dof]
  std::vector<Orbit> orbits;        ///< [-], at each station; the widest has the semi-major axis 1
  Whirl whirl = Whirl::kForward;    ///< of the whole shaft

  double naturalFrequency() const { return std::abs(eigenvalue); }  ///< [rad/s]
  double dampedFrequency() const { return eigenvalue.imag(); }      ///< [rad/s]
  double dampingRatio() const { return 0.0 - eigenvalue.real() / std::abs(eigenvalue); }  ///< [-]
  double logDecrement() const;                                                            ///< [-]
};

constexpr double kMaxWhirlDamping = 0.7;  ///< damping ratio, of a whirl: isWhirl()
constexpr double kMaxWhirlGrowth = 0.99;  ///< negative damping ratio, likewise

/// A motion whose damping ratio is above 0.7 hardly goes round once: an overdamped root, or one
/// that is nearly so, of a bearing with much damping. One that grows by a factor of 1e19 while it
/// goes round once is the divergence of a buckled shaft. No verdict on whirl modes is about them.
bool isWhirl(const WhirlMode& mode);

struct WhirlModes {
  std::vector<WhirlMode> modes;    ///< by rising damped frequency
  std::vector<double> real_roots;  ///< [1/s], ascending: overdamped motions, and 0 of free ones
};

/// Modes with equal eigenvalues (to a relative 1e-7), whose shapes are not unique, are separated by
/// direction: for a round rotor one is forward, one backward. Zero eigenvalues of rigid-body modes
/// are exactly zero, and where no energy is supplied (cannotGrow) a real part within rounding is
/// computed from the damping of the shape: without damping, exactly 0.
WhirlModes whirlModes(const Linearization& at_speed, const std::vector<Station>& stations);
/// At a speed [rad/s].
WhirlModes whirlModes(const LinearRotor& rotor, const std::vector<Station>& stations, double speed);

/// The `count` modes of lowest frequency or more, and the real roots among as many, without a dense
/// solution. Nothing where lowestRoots() has no result.
std::optional<WhirlModes> lowestWhirlModes(const BandedLinearization& at_speed,
                                           const std::vector<Station>& stations, std::size_t count);

/// Gives the shape its length and its instant, and works out the orbits and the direction.
void normalise(WhirlMode& mode, const std::vector<Station>& stations);

/// The orbits of a motion Re(shape e^(i wt)) at the stations [m].
std::vector<Orbit> orbitsOf(const Eigen::VectorXcd& shape, const std::vector<Station>& stations);

/// Direction of a whole shaft: kMixed where stations disagree. Stations with less than 1e-6 of the
/// largest amplitude are ignored.
Whirl whirlOf(const std::vector<Orbit>& orbits);

/// Other shapes of the same space (columns): as forward as can be first, backward last.
Eigen::MatrixXcd separatedByDirection(const Eigen::MatrixXcd& shapes,
                                      const std::vector<Station>& stations);

}  // namespace whirl_twin
