// A rotor's whirl wherever it is published: the phase there, from the steps that are told and from
// those that are only looked at.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "control/drive.h"
#include "mechanics/dynamics.h"
#include "realtime/state_image.h"
#include "twin/record.h"
#include "twin/steady_whirl.h"
#include "twin/whirl_phase.h"
#include "twin/whirl_rest.h"

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
      next_look_ = told_ + 1;
    }
  }
  /// One that is looked at, no later than nextLook(). False: it is to be told. The shaft has to
  /// turn by less than a quarter of a turn in a step.
  bool follow(std::int64_t step, const double* q) noexcept;
  /// After it: puts the next look off for as long as the whirl is sure to stay where it is
  /// (whirl_rest.h). The drive is at that step.
  void putOff(const Dynamics& dynamics, const double* q, const double* v, const Drive& drive,
              double seconds);
  /// The step that is to be looked at or told next; those before it need not be.
  std::int64_t nextLook() const { return std::max(next_look_, steady_until_); }

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

  std::vector<Station> stations() const;

  std::vector<Place> places_;
  std::int64_t told_ = 0;          // step
  std::int64_t steady_until_ = 0;  // step, up to which steady_ holds
  std::int64_t next_look_ = 1;     // step, without that
  std::optional<SteadyWhirl> steady_;
  double sought_ =
      std::numeric_limits<double>::quiet_NaN();  // [rad/s], that steady_ is of, or none
  std::optional<WhirlRest> rest_;
  bool rest_sought_ = false;
  int looks_in_turn_ = 0;  // before it is tried again to put one off
};

}  // namespace whirl_twin
