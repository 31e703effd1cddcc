// How far each number of a system, changed alone, is from the loss of stability, and the nearest of
// them: which, at which value, and whether by divergence or by whirl.
//
// A number is changed in strides of its present value: a twentieth of it down to nothing (and on
// through zero, where its range allows a sign), and by the factor 1.05 up to ten times; of a system
// of more than kMostExactCoordinates coordinates a quarter, 1.25, and four times. An isle of
// instability narrower than a stride may be jumped over.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/loss_of_stability.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct ParameterMargin {
  std::string parameter;  ///< its path (parameter_paths.h), or "speed": that of the shaft
  std::string unit;
  double value = 0.0;  ///< now
  /// [-], the smallest change to the loss, of the value: -0.2 is 20 % less; NaN from zero.
  double change = 0.0;
  LossOfStability loss;
};

struct MarginResolution {
  double stride = 0.05;  ///< [-], of the value, down; a factor 1 + stride up
  double reach = 10.0;   ///< [-], times the value, up
};
MarginResolution marginResolution(const Dynamics& dynamics);

/// Are they a matter of a second at most: of up to kMostExactCoordinates coordinates, one where
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
/// way: nothing where it says so.
std::optional<ParameterMargin> nearestLoss(
    const BuiltSystem& system, const SteadyMotion& motion, double speed,
    const std::function<bool()>& given_up = [] { return false; });

/// "divergence", "whirl" of a rotor, "flutter" of anything else, "no_motion".
const char* lossName(LossKind kind, const Dynamics& dynamics);

}  // namespace whirl_twin
