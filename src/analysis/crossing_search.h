// Where whirl modes meet a multiple of the speed, without following any of them. In the order of
// their damped frequencies, the overdamped first as of frequency zero, the k-th of all modes has a
// frequency f_k(w) that is continuous in the speed whichever modes cross or veer. As many more
// modes are slower than h w at a higher speed as have met it on the way.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/whirl_modes.h"

namespace whirl_twin {

struct FoundCrossing {
  double speed = 0.0;    ///< [rad/s]
  WhirlMode mode;        ///< there
  std::size_t rank = 0;  ///< how many modes vibrate slower there
};

class CrossingSearch {
 public:
  /// `system`: the matrices at a speed [rad/s].
  CrossingSearch(std::function<Linearization(double)> system, std::vector<Station> stations)
      : system_(std::move(system)), stations_(std::move(stations)) {}

  /// By how much the modes slower than harmonic times the speed are more at `high` than at `low`
  /// [rad/s]: those that have met it, less those that have outrun it again. Nothing of a rotor of
  /// more than kMostCompleteCoordinates.
  std::optional<int> net(double harmonic, double low, double high) const;
  /// The crossings that this takes, one each.
  std::vector<FoundCrossing> between(double harmonic, double low, double high) const;

 private:
  WhirlModes modes(double speed) const;
  std::size_t slower(double harmonic, double speed) const;

  std::function<Linearization(double)> system_;
  std::vector<Station> stations_;
};

}  // namespace whirl_twin
