// A short plain journal bearing with a film that cavitates: Ocvirk's short bearing, pi film.
//
//   d/dz (h^3 dp/dz) = 6 mu w dh/dtheta + 12 mu dh/dt,   h = c - x cos(theta) - y sin(theta)
//
// gives a pressure parabolic along the bearing's length and over theta
//
//   integral of p dz = mu L^3 / 2 * (a cos(theta) + b sin(theta)) / h^3,
//   (a, b) = (2 vx + w y, 2 vy - w x),
//
// positive over the half circle about the direction u of (a, b), at any position and velocity of
// the journal; in the other half the film is torn (Gumbel). With G = integral of d(phi) / (1 - p
// cos(phi) - q sin(phi)) over that half, p and q the eccentricity ratio along u and across it, the
// force is (Capone, L'Energia Elettrica 68, 1991; Childs, Turbomachinery Rotordynamics, 1993)
//
//   F = -mu R L^3 / (4 c^3) [(a, b) G_pp + (-b, a) G_pq],
//   G = 2 W / s,   W = pi / 2 + atan(p / s),   s^2 = 1 - e^2
//
// A film that is neither sheared nor squeezed, (a, b) = 0, carries nothing and has no half: there
// |(a, b)| is rounded off over kStillFilm clearances a second.
#pragma once

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

template <class S>
struct FilmForce {
  S x, y;  ///< [N], on the journal
};

/// Small motions about the static position: force on the journal = -(K (x, y) + C (vx, vy) +
/// M (ax, ay)), M symmetric.
struct BearingCoefficients {
  double kxx = 0.0, kxy = 0.0, kyx = 0.0, kyy = 0.0;  ///< [N/m]
  double cxx = 0.0, cxy = 0.0, cyx = 0.0, cyy = 0.0;  ///< [N s/m]
  double mxx = 0.0, mxy = 0.0, myy = 0.0;  ///< [kg], of what moves along with the journal
};

struct JournalPosition {
  double x, y;          ///< [m], from the bearing's centre
  double eccentricity;  ///< [-], ratio e / c
  double attitude;      ///< [rad], from the load to the line of centres, with the rotation > 0
};

struct ShortJournalBearing {
  static constexpr double kStillFilm = 1.0e-6;      ///< [1/s]
  static constexpr double kThinnestFilm = 1.0e-4;   ///< [-], of 1 - e^2
  static constexpr double kMaxEccentricity = 0.95;  ///< of staticPosition(): slow shafts touch

  double length = 0.0;     ///< [m]
  double diameter = 0.0;   ///< [m]
  double clearance = 0.0;  ///< [m], radial
  double viscosity = 0.0;  ///< [Pa s]

  /// Force on a journal at x, y [m] from the bearing's centre with velocity vx, vy [m/s] and
  /// rotational speed `speed` [rad/s]. For 1 - e^2 < kThinnestFilm the film thickness is limited
  /// from below: the journal touches, and the equations are invalid.
  template <class S>
  WHIRL_TWIN_INLINE FilmForce<S> force(const S& x, const S& y, const S& vx, const S& vy,
                                       const S& speed) const {
    const double per_clearance = 1.0 / clearance;
    const S ex = per_clearance * x;
    const S ey = per_clearance * y;
    const S a = 2.0 * (per_clearance * vx) + speed * ey;  // [1/s]
    const S b = 2.0 * (per_clearance * vy) - speed * ex;
    const S turn = 1.0 / sqrt(a * a + b * b + kStillFilm * kStillFilm);
    const S p = turn * (ex * a + ey * b);
    const S q = turn * (ey * a - ex * b);
    const S room = thinnest(1.0 - ex * ex - ey * ey);
    const S s2 = 1.0 / room;  // 1 / s^2
    const S s4 = s2 * s2;
    const S s = sqrt(s2);
    const S w = kQuarterTurn + atan(p * s);
    const S along = 6.0 * (p * s4) + 2.0 * (w * s * s2) * (1.0 + 3.0 * (p * p * s2));
    const S across = 4.0 * (q * s4) + 2.0 * (p * p * q * s4) / thinnest(1.0 - q * q) +
                     6.0 * (w * s * s4) * (p * q);
    const double scale = -forceScale();
    return {scale * (a * along - b * across), scale * (b * along + a * across)};
  }

  /// Eccentricity ratio under a load [N] at a speed [rad/s], both > 0: the root in (0, 1) of
  /// Ocvirk's (1 - e^2)^4 = S^2 e^2 (pi^2 + (16 - pi^2) e^2), S = D w mu L^3 / (8 load c^2).
  double eccentricity(double load, double speed) const;
  /// The speed [rad/s] at which a load [N] leaves an eccentricity ratio in (0, 1).
  double speedAt(double load, double eccentricity_ratio) const;
  /// Where a load [N] > 0 along -y holds the journal at a speed [rad/s] > 0.
  JournalPosition staticPosition(double load, double speed) const;
  /// About the static position under a load [N] along -y, at any speed [rad/s]; a shaft that turns
  /// backwards has the mirrored bearing. A slow shaft touches: below speedAt(load,
  /// kMaxEccentricity) direct coefficients are those of that speed, cross-coupled ones
  /// proportional to the speed.
  BearingCoefficients coefficients(double load, double speed) const;

 private:
  /// A trial state of an implicit step may lie beyond the bearing: the film stays thin there.
  template <class S>
  static WHIRL_TWIN_INLINE S thinnest(const S& film) {
    return film > kThinnestFilm ? film : S(kThinnestFilm);
  }

  static constexpr double kQuarterTurn = 1.57079632679489661923;
  /// mu R L^3 / (4 c^2) [N s]; velocities are in clearances.
  double forceScale() const {
    return viscosity * 0.5 * diameter * length * length * length / (4.0 * clearance * clearance);
  }
};

}  // namespace whirl_twin
