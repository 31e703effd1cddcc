// A rotor's whirl wherever it is published: the phase there, from the steps that are told and from
// those that are only looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "mechanics/dynamics.h"
#include "realtime/state_image.h"
#include "twin/record.h"
#include "twin/steady_whirl.h"
#include "twin/whirl_phase.h"

namespace whirl_twin {

class FollowedWhirl {
 public:
  /// The stations from now on, the first of them the rotor's own; their phases go on.
  void put(const std::vector<Station>& stations);

  const Station& station(std::size_t k) const { return places_[k].at; }
  const WhirlPhase& phase(std::size_t k) const { return places_[k].phase; }
  WhirlMotion motion(std::size_t k, const double* q, const double* v) const;

  /// A step that is told: settle() with the mark as it was before any change, then observe().
  /// seconds: of a step.
  void settle(std::int64_t step, const ShaftView& shaft, double on_shaft, double seconds);
  void observe(std::int64_t step, const double* q, const double* v, const ShaftMark& mark);
  /// What is known of the past, but that it is steady, which is found out again.
  void exchange(StateImage& image) noexcept {
    image(places_, told_);
    if (image.puts()) {
      steady_until_ = told_;
    }
  }
  /// One that is looked at, behind the one before. False: it is to be told. Before `steadyUntil()`
  /// it need not be looked at. The shaft has to turn by less than a quarter of a turn in it.
  bool follow(std::int64_t step, const double* q) noexcept;

  /// Finds out for how many steps from the one told last the whirl is steady (steady_whirl.h), at a
  /// constant speed that lasts for `steps` steps: they need not be seen. coarse: the shaft turns a
  /// quarter of a turn in a step, or more.
  void findSteady(const Dynamics& dynamics, const double* q, const double* v,
                  const ShaftView& shaft, double seconds, std::int64_t steps, bool coarse);
  /// The step that is to be told again, if steps are not looked at from the one told last on; that
  /// one itself: they are.
  std::int64_t steadyUntil() const { return steady_until_; }

 private:
  struct Place {
    Station at;
    WhirlPhase phase;
    std::int64_t seen = 0;            // step, at which the phase was last seen
    std::vector<double> across = {};  // x and y of each coordinate in turn

    void exchange(StateImage& image) noexcept { image(phase, seen); }
  };

  std::vector<Place> places_;
  std::int64_t told_ = 0;          // step
  std::int64_t steady_until_ = 0;  // step, up to which steady_ holds
  std::optional<SteadyWhirl> steady_;
  double sought_ =
      std::numeric_limits<double>::quiet_NaN();  // [rad/s], that steady_ is of, or none
};

}  // namespace whirl_twin
