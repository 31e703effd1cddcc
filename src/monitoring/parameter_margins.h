// How far each number of a system, changed alone, is from the loss of stability, and the nearest of
// them: which, at which value, and whether by divergence or by whirl.
//
// A number is changed in strides of its present value: a twentieth of it down to nothing (and on
// through zero, where its range allows a sign), and by the factor 1.05 up to ten times; of a system
// of more than kMaxExactCoordinates coordinates a quarter, 1.25, and four times. An isle of
// instability narrower than a stride may be jumped over.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/instability_point.h"
#include "analysis/steady_motion.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct ParameterMargin {
  std::string parameter;  ///< its path (parameter_paths.h), or "speed": that of the shaft
  std::string unit;
  double value = 0.0;  ///< now
  /// [-], the smallest change to the loss, of the value: -0.2 is 20 % less; NaN from zero.
  double change = 0.0;
  InstabilityPoint loss;
};

struct MarginResolution {
  double stride = 0.05;  ///< [-], of the value, down; a factor 1 + stride up
  double reach = 10.0;   ///< [-], times the value, up
};
MarginResolution marginResolution(const Dynamics& dynamics);

/// Are they a matter of a second at most: of up to kMaxExactCoordinates coordinates, one where
/// alternating loads drive it, and of a model that is not assembled from tables for every value? Of
/// a shaft of many elements they take minutes.
bool isQuickToSearch(const BuiltSystem& system);

/// Of every number that has a loss within reach, the nearest first, those that are zero now last: a
/// zero is tried with what others of its unit are, from a thousandth of the largest of them to ten
/// times. A parameter that by default is another's (stiffness_y), and has its value, goes with it.
/// The system operates about `motion` at a shaft speed [rad/s], stable.
std::vector<ParameterMargin> parameterMargins(const BuiltSystem& system, const SteadyMotion& motion,
                                              double speed);

/// The first of those only, zeros left out, in a part of the time. `given_up` is asked along the
/// way: nothing where it returns true.
std::optional<ParameterMargin> nearestInstability(
    const BuiltSystem& system, const SteadyMotion& motion, double speed,
    const std::function<bool()>& given_up = [] { return false; });

/// "divergence", "whirl" of a rotor, "flutter" of anything else, "no_motion".
const char* lossName(LossKind kind, const Dynamics& dynamics);

/// The stability of a system whose parameters are known to within tolerances (its spread): a
/// thousand samples drawn of it are evaluated at the present speed, and the slowest decay anywhere
/// within it is searched for.
///
/// The box that is searched: each number within its half width, or three standard deviations; of
/// correlated ones those that are independent make it, so that it is a slanted one. Its
/// corners (of up to kMaxCorners numbers), the members that lie in it, and from the slowest of
/// them on downhill, number by number. By Kharitonov's theorem (1978: four polynomials decide for
/// all whose coefficients lie in intervals) nothing within the box grows, where those four do not;
/// the intervals are those that the corners span, beyond which no coefficient goes that rises or
/// falls with each number all along. The numbers of one system tie its coefficients together, so
/// where the four do not decay the theorem decides nothing.
struct RobustStabilityMargin {
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
/// one that takes long to set up (isQuickToSearch), and where `given_up` returns true, which is
/// asked along the way.
std::optional<RobustStabilityMargin> robustStabilityMargin(
    const BuiltSystem& system, const SteadyMotion& motion, double speed,
    const std::function<bool()>& given_up = [] { return false; });

}  // namespace whirl_twin
