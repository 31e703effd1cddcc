// Local nonlinear elements at a shaft (local_force.h), each a template over the number type: the
// force is written once, its derivatives come from dual numbers.
//
//   cubic spring     F = -k |r|^2 r
//   rub, gap         where |r| > clearance: N = k (|r| - clearance) + d |r|', along -r, and
//   friction
//                    mu k (|r| - clearance) u / sqrt(u^2 + kSlip^2) against u = v_tangential + w R,
//                    the sliding of the surface (as rotors/nonlinear_jeffcott_rotor.h)
//   journal bearing  Ocvirk's film (rotors/short_journal_bearing.h), wherever the journal is
//   squeeze film     the same film around a ring that does not rotate: a damper
//
// Of these only friction acts on the shaft's spin: a film's drag there is the motor's.
//
// The damping of a film in its centre, pi mu R L^3 / (2 c^3), is part of the linear rotor:
// otherwise undamped modes with many periods within a step would not be damped by it.
#pragma once

#include <cmath>
#include <memory>

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"
#include "mechanics/local_force.h"
#include "mechanics/rotors/short_journal_bearing.h"

namespace whirl_twin {

/// Of a place x, y [m] with rates vx, vy [m/s] at a speed of the shaft [rad/s].
template <class S>
struct PushedMotion {
  S x, y, vx, vy;
  double speed;
};

struct CubicSpring {
  double stiffness = 0.0;  ///< [N/m^3]

  template <class S>
  FilmForce<S> force(const PushedMotion<S>& at) const {
    const S pull = -stiffness * (at.x * at.x + at.y * at.y);
    return {pull * at.x, pull * at.y};
  }
};

struct Rub {
  static constexpr double kSlip = 1.0e-3;  ///< [m/s], sliding within which friction is rounded off

  double clearance = 0.0;  ///< [m]
  double stiffness = 0.0;  ///< [N/m]
  double damping = 0.0;    ///< [N s/m], across the contact
  double friction = 0.0;   ///< [-]
  double radius = 0.0;     ///< [m], of the surface that rubs

  template <class S>
  FilmForce<S> force(const PushedMotion<S>& at) const {
    const S squared = at.x * at.x + at.y * at.y;
    if (!(squared > clearance * clearance)) {
      return {S(0.0), S(0.0)};
    }
    const S r = sqrt(squared);
    const S ex = at.x / r;
    const S ey = at.y / r;
    const S load = stiffness * (r - clearance);
    const S sliding = ex * at.vy - ey * at.vx + radius * at.speed;
    const S normal = load + damping * (ex * at.vx + ey * at.vy);
    const S drag = friction * load * (sliding / sqrt(sliding * sliding + kSlip * kSlip));
    return {drag * ey - normal * ex, -normal * ey - drag * ex};
  }
  /// [N m], of the friction on the shaft's spin.
  double moment(const PushedMotion<double>& at) const {
    const double r = std::hypot(at.x, at.y);
    if (!(r > clearance)) {
      return 0.0;
    }
    const double sliding = (at.x * at.vy - at.y * at.vx) / r + radius * at.speed;
    return -radius * friction * stiffness * (r - clearance) * sliding /
           std::sqrt(sliding * sliding + kSlip * kSlip);
  }
};

/// Film of a journal that rotates with the shaft, or of a damper's ring that does not rotate.
struct OilFilm {
  ShortJournalBearing bearing;
  bool turns = true;

  /// [N s/m], of the rotor: the force is without it.
  double linearDamping() const {
    const double slenderness = bearing.length / bearing.clearance;
    return kQuarterTurn * bearing.viscosity * 0.5 * bearing.diameter * slenderness * slenderness *
           slenderness;
  }

  template <class S>
  FilmForce<S> force(const PushedMotion<S>& at) const {
    const FilmForce<S> film = bearing.force(at.x, at.y, at.vx, at.vy, S(turns ? at.speed : 0.0));
    const double damping = linearDamping();
    return {film.x + damping * at.vx, film.y + damping * at.vy};
  }

 private:
  static constexpr double kQuarterTurn = 1.57079632679489661923;
};

std::shared_ptr<const NodalForceLaw> localLaw(const CubicSpring& spring);
std::shared_ptr<const NodalForceLaw> localLaw(const Rub& rub);
/// It has no place for a rotor beyond its clearance.
std::shared_ptr<const NodalForceLaw> localLaw(const OilFilm& film);

}  // namespace whirl_twin
