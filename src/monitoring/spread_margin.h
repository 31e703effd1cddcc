// The stability of a system whose numbers are known to within a spread: a thousand members drawn
// of it are judged at the present speed, and the slowest decay anywhere within it is looked for.
//
// The box that is searched: each number within its half width, or three standard deviations; of
// correlated ones those that are independent make it, so that it is a slanted one. Its
// corners (of up to kMostCorners numbers), the members that lie in it, and from the slowest of them
// on downhill, number by number. By Kharitonov's theorem (1978: four polynomials tell of all whose
// coefficients lie in intervals) nothing within the box grows, where those four do not; the
// intervals are those that the corners span, beyond which no coefficient goes that rises or falls
// with each number all along. The numbers of one system tie its coefficients together, so where the
// four do not decay the theorem does not tell.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/steady_motion.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct SpreadMargin {
  /// [1/s], the slowest of each member, ascending; below 0 of one that surely grows, -infinity of
  /// one that has no steady motion near the system's.
  std::vector<double> decay_rates;
  double lowest_decay_rate = 0.0;  ///< [1/s], found in the box or of a member
  bool stable_throughout = false;

  /// Members that decay slower than this [1/s], or grow.
  std::size_t beyond(double decay_rate) const;
};

/// Of a system that operates about `motion` at a shaft speed [rad/s]. Members that the model cannot
/// have are left out. Nothing where no number is spread that a system of its kind is made of, for
/// one that takes long to set up (isQuickToSearch), and where `given_up` says so, which is asked
/// along the way.
std::optional<SpreadMargin> spreadMargin(
    const BuiltSystem& system, const SteadyMotion& motion, double speed,
    const std::function<bool()>& given_up = [] { return false; });

}  // namespace whirl_twin
