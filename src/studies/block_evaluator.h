// Evaluates the points of a block: one by one, or batched (SIMD, integration/isotropic_rotors.h), a
// hundred times faster, if they are isotropic linear rotors on a common shaft with only the largest
// whirl radius measured. The choice, and thus the results, depend only on the study and the block.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "integration/isotropic_rotors.h"
#include "scene/built_scene.h"
#include "studies/point_evaluator.h"

namespace whirl_twin {

/// For one thread.
class BlockEvaluator {
 public:
  /// As PointEvaluator. Throws SceneError for an invalid scene.
  BlockEvaluator(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop);

  /// The block's points, in order; `done` is called with the number of points completed since its
  /// last call. Throws Interrupted.
  std::vector<Outcome> outcomes(std::uint64_t block,
                                const std::function<void(std::uint64_t)>& done);

  /// A single point, bit-identical to the one in its block. Throws Interrupted.
  Outcome at(std::uint64_t point);

 private:
  /// Sets parameters of the system without reading the whole scene again, if only parameters vary.
  struct Quick {
    Quick(const Study& study, const BuiltScene& scene);
    /// False if a value is out of range.
    bool put(const std::vector<double>& values);

    bool possible = true;
    const ModelInfo& model;
    SystemSpec spec;
    std::vector<std::string> names;  // of the varied parameters
  };

  bool mayGoTogether() const;
  bool isQuick(const std::vector<double>& values);
  /// Empty: not such a rotor. Throws the exceptions of an invalid system.
  std::optional<IsotropicRotor> rotorAt(const std::vector<double>& values, bool quick);
  /// Empty if they cannot be batched after all.
  std::optional<std::vector<Outcome>> together(std::uint64_t block);

  const Study& study_;
  const std::atomic<bool>& stop_;
  PointEvaluator one_;
  BuiltScene scene_;  // nominal
  bool together_;
  std::optional<Quick> quick_;
};

}  // namespace whirl_twin
