// What linear theory says of a system, as numbers that a study can measure, in the words of `twin
// analyze`:
//
//   critical_speeds[0]                  [rad/s]; also .amplification_factor, .separation_margin
//   natural_frequencies[0], damping_ratios[0]
//   stability.sigma, margins.decay_rate [1/s], -max Re s
//   margins.damping_ratio, margins.log_decrement
//   margins.instability_speed           [rad/s], infinite where it never becomes unstable
//   separation.reserve                  [percent], by how much the nearest critical speed's
//                                       separation margin exceeds that which API 617 asks for
//
// In a scene of several systems the system's name stands before: `rotor.critical_speeds[0]`.
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
  std::size_t place = 0;  ///< of the critical speed or the mode, from 0
};

/// The number of that name; nothing if there is none, or where it does not say which system.
std::optional<AnalysedNumber> analysedNumber(const std::string& name, const BuiltScene& scene);
/// How they are written, for a hint: with 0 for any place.
std::vector<std::string> analysedNames(const BuiltScene& scene);
std::string unitOf(const AnalysedNumber& number);

/// Of one scene, each analysis made when it is first asked for. The scene outlives it.
class AnalysedScene {
 public:
  /// speed [rad/s], of the shafts; nothing: as at the scene's start.
  AnalysedScene(const BuiltScene& scene, std::optional<double> speed);
  ~AnalysedScene();
  /// NaN where there is none: a critical speed that the rotor does not have. Throws what an
  /// analysis throws: RunFailure, Refusal, std::overflow_error.
  double value(const AnalysedNumber& number);

 private:
  struct Results;

  const BuiltScene& scene_;
  std::optional<double> speed_;
  std::vector<Results> results_;  // of each system
};

}  // namespace whirl_twin
