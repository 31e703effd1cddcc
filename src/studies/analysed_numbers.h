// Results of linear analyses as numbers that a study can measure, named as in `twin analyze`:
//
//   critical_speeds[0]                  [rad/s]; also .amplification_factor, .separation_margin
//   natural_frequencies[0], damping_ratios[0]
//   stability.sigma, margins.decay_rate [1/s], -max Re s
//   margins.damping_ratio, margins.log_decrement
//   margins.instability_speed           [rad/s], infinite if stable at all speeds
//   separation.reserve                  [percent], separation margin of the nearest critical speed
//                                       less the margin required by API 617
//
// In a scene of several systems the name is prefixed by the system's: `rotor.critical_speeds[0]`.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/built_scene.h"

namespace whirl_twin {

struct AnalysedNumber {
  enum class Kind {
    kCriticalSpeed,
    kAmplificationFactor,
    kSeparationMargin,
    kNaturalFrequency,
    kDampingRatioOfMode,
    kDecayRate,
    kDampingRatio,
    kLogDecrement,
    kInstabilitySpeed,
    kSeparationReserve
  };
  Kind kind = Kind::kDecayRate;
  std::size_t system = 0;
  std::size_t place = 0;  ///< index of the critical speed or mode
};

/// The number of that name; empty if there is none, or the system is ambiguous.
std::optional<AnalysedNumber> analysedNumber(const std::string& name, const BuiltScene& scene);
/// All valid names, for a hint, with 0 as index.
std::vector<std::string> analysedNames(const BuiltScene& scene);
std::string unitOf(const AnalysedNumber& number);

/// Analyses of a scene, each made on first use. The scene must outlive it.
class AnalysedScene {
 public:
  /// speed [rad/s], of the shafts; empty: that at the scene's start.
  AnalysedScene(const BuiltScene& scene, std::optional<double> speed);
  ~AnalysedScene();
  /// NaN if undefined: a critical speed that the rotor does not have. Throws the exceptions of the
  /// analyses: RunFailure, InputError, std::overflow_error.
  double value(const AnalysedNumber& number);

 private:
  struct Results;

  const BuiltScene& scene_;
  std::optional<double> speed_;
  std::vector<Results> results_;  // of each system
};

}  // namespace whirl_twin
