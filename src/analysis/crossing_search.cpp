#include "analysis/crossing_search.h"

#include <algorithm>
#include <cmath>

#include "analysis/bracketed_root.h"
#include "analysis/stability.h"

namespace whirl_twin {

namespace {

constexpr double kMet = 1.0e-6;  // of a frequency: as near as a mode comes that meets it

std::size_t overdamped(const WhirlModes& all) {
  return all.real_roots.size() / 2;
}

}  // namespace

WhirlModes CrossingSearch::modes(double speed) const {
  return whirlModes(system_(speed), stations_);
}

std::size_t CrossingSearch::slower(double harmonic, double speed) const {
  const WhirlModes all = modes(speed);
  return overdamped(all) + static_cast<std::size_t>(std::count_if(
                               all.modes.begin(), all.modes.end(), [&](const WhirlMode& mode) {
                                 return mode.dampedFrequency() < harmonic * speed;
                               }));
}

std::optional<int> CrossingSearch::net(double harmonic, double low, double high) const {
  if (system_(low).mass.rows() > kMostCompleteCoordinates) {
    return std::nullopt;
  }
  return static_cast<int>(slower(harmonic, high)) - static_cast<int>(slower(harmonic, low));
}

std::vector<FoundCrossing> CrossingSearch::between(double harmonic, double low, double high) const {
  const std::size_t at_low = slower(harmonic, low);
  const std::size_t at_high = slower(harmonic, high);
  std::vector<FoundCrossing> found;
  for (std::size_t k = std::min(at_low, at_high); k < std::max(at_low, at_high); ++k) {
    const auto excess = [&](double speed) {
      const WhirlModes all = modes(speed);
      const std::size_t still = overdamped(all);
      if (k >= still + all.modes.size()) {
        return harmonic * speed;  // faster than the modes known
      }
      return (k < still ? 0.0 : all.modes[k - still].dampedFrequency()) - harmonic * speed;
    };
    const double speed = bracketedRoot(excess, low, high, excess(low), excess(high));
    const WhirlModes there = modes(speed);
    const std::size_t still = overdamped(there);
    // A mode that does not vibrate, or leaves the modes known, meets nothing.
    if (k >= still && k - still < there.modes.size() &&
        std::fabs(there.modes[k - still].dampedFrequency() - harmonic * speed) <=
            kMet * harmonic * speed) {
      found.push_back({speed, there.modes[k - still], k - still});
    }
  }
  return found;
}

}  // namespace whirl_twin
