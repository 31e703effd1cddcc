// A rotor's whirl wherever it is published: the phase there, from the steps that are published and
// from those between, of which only the position is evaluated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mechanics/dynamics.h"
#include "realtime/state_image.h"
#include "twin/record.h"
#include "twin/whirl_phase.h"

namespace whirl_twin {

class FollowedWhirl {
 public:
  /// The stations from now on, the first of them the rotor's own; their phases continue.
  void put(const std::vector<Station>& stations);

  const Station& station(std::size_t k) const { return places_[k].at; }
  const WhirlPhase& phase(std::size_t k) const { return places_[k].phase; }
  WhirlMotion motion(std::size_t k, const double* q, const double* v) const;

  /// A step that is published: settle() with the mark as it was before any change, then observe().
  /// seconds: of a step.
  void settle(std::int64_t step, const ShaftView& shaft, double on_shaft, double seconds);
  void observe(std::int64_t step, const double* q, const double* v, const ShaftMark& mark);
  void exchange(StateImage& image) noexcept { image(places_); }
  /// The next step, of which only the position is evaluated. False: it has to be observed. The
  /// shaft has to turn by less than a quarter of a turn in a step.
  bool follow(std::int64_t step, const double* q) noexcept;

 private:
  struct Place {
    Station at;
    WhirlPhase phase;
    std::int64_t seen = 0;            // step, of the phase
    std::vector<double> across = {};  // x and y of each coordinate in turn

    void exchange(StateImage& image) noexcept { image(phase, seen); }
  };

  std::vector<Place> places_;
};

}  // namespace whirl_twin
