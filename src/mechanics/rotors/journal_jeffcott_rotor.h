// A Jeffcott rotor whose shaft ends in two equal short journal bearings: oil whirl and oil whip.
//
//   T = m |v_G|^2 / 2 + m_j |v_j|^2 / 2,   V = k |r - r_j - bow|^2 / 2 + g (m y + m_j y_j)
//   Q on the journals: 2 film forces (short_journal_bearing.h)
//
// r: the disc's shaft centre S, r_j: both journals, which move alike; m_j is their mass together.
// Material damping acts on the shaft's deflection r - r_j. Above a speed the journals whirl
// forwards at a little less than half the speed of the shaft (oil whirl); once that reaches the
// rotor's critical speed the whirl stays there, however fast the shaft (oil whip; Newkirk & Taylor
// 1925; Childs, Turbomachinery Rotordynamics, 1993). The film's drag on the spin is the motor's
// drag.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/reaction.h"
#include "mechanics/rotors/jeffcott_rotor.h"
#include "mechanics/rotors/short_journal_bearing.h"

namespace whirl_twin {

/// Its linear part: without the films.
struct FilmlessJeffcottRotor : JeffcottRotor {
  static constexpr std::size_t kDof = 4;
  static constexpr std::array<Coordinate, kDof> kCoordinates{
      {{"x", "m", "of the disc's centre, from the bearings' line"},
       {"y", "m", "likewise, up"},
       {"journal_x", "m", "of each journal, from its bearing's centre"},
       {"journal_y", "m", "likewise, up"}}};

  static constexpr auto parameters() {
    return inherited<FilmlessJeffcottRotor>(JeffcottRotor::parameters());
  }
  FilmlessJeffcottRotor balanced() const { return withoutUnbalance(*this); }
  double naturalLength() const { return 0.1 * bearing_clearance; }

  std::array<Input<kDof>, 2> inputs() const {
    return {{{"force_x", "N", {1.0, 0.0, 0.0, 0.0}, "on the disc, along x"},
             {"force_y", "N", {0.0, 1.0, 0.0, 0.0}, "on the disc, along y"}}};
  }

  template <class S>
  WHIRL_TWIN_INLINE S kinetic(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                              const EvaluationPoint<S>& at) const {
    const S disc = JeffcottRotor::kinetic(std::array<S, 2>{q[0], q[1]}, {v[0], v[1]}, at);
    return disc + (0.5 * journal_mass) * (v[2] * v[2] + v[3] * v[3]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S potential(const std::array<S, kDof>& q, const EvaluationPoint<S>& at) const {
    const S bent = bending(deflection(q), at);
    return bent + gravity * (mass * q[1] + journal_mass * q[3]);
  }
  template <class S>
  WHIRL_TWIN_INLINE S dissipation(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                                  const EvaluationPoint<S>& at) const {
    return externalDissipation(std::array<S, 2>{q[0], q[1]}, {v[0], v[1]}, at) +
           internalDissipation(deflection(q), deflection(v), at);
  }
  template <class S>
  WHIRL_TWIN_INLINE std::array<S, kDof> force(const std::array<S, kDof>& q,
                                              const std::array<S, kDof>&,
                                              const EvaluationPoint<S>&) const {
    return {-cross_coupling * q[1], cross_coupling * q[0], S(0.0), S(0.0)};
  }

 private:
  template <class S>
  static WHIRL_TWIN_INLINE std::array<S, 2> deflection(const std::array<S, kDof>& q) {
    return {q[0] - q[2], q[1] - q[3]};
  }
};

struct JournalJeffcottRotor : FilmlessJeffcottRotor {
  static constexpr bool kLinear = false;

  static constexpr auto parameters() {
    return inherited<JournalJeffcottRotor>(JeffcottRotor::parameters());
  }
  JournalJeffcottRotor balanced() const { return withoutUnbalance(*this); }

  ShortJournalBearing bearing() const {
    return {bearing_length, bearing_diameter, bearing_clearance, bearing_viscosity};
  }
  template <class S>
  std::array<S, kDof> force(const std::array<S, kDof>& q, const std::array<S, kDof>& v,
                            const EvaluationPoint<S>& at) const {
    std::array<S, kDof> all = FilmlessJeffcottRotor::force(q, v, at);
    const FilmForce<S> film = bearing().force(q[2], q[3], v[2], v[3], at.speed);
    all[2] = 2.0 * film.x;
    all[3] = 2.0 * film.y;
    return all;
  }

  std::vector<Condition> conditions(const std::array<double, kDof>& q,
                                    const std::array<double, kDof>&,
                                    const std::array<double, kDof>&,
                                    const EvaluationPoint<double>&) const {
    return {{"oil_film", "m", bearing_clearance - std::hypot(q[2], q[3]),
             "the journals touch their bearings"}};
  }
};

}  // namespace whirl_twin
