// Runs the points of a block: one by one, or, where they are isotropic linear rotors on one shaft
// of which nothing but the largest whirl radius is measured, side by side in vectors
// (integration/isotropic_rotors.h), which takes a hundredth of the time. Which of the two is a
// matter of the study and the block alone, and so are the results.
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

/// Of one thread.
class BlockEvaluator {
 public:
  /// As PointEvaluator. Throws SceneError for a scene that is none any more.
  BlockEvaluator(const Study& study, const StepsChosen& steps, const std::atomic<bool>& stop);

  /// Of the block's points, in their order; `done` is called with how many more have been run.
  /// Throws Interrupted.
  std::vector<Outcome> outcomes(std::uint64_t block,
                                const std::function<void(std::uint64_t)>& done);

  /// Of one point alone, to the last digit as in its block. Throws Interrupted.
  Outcome at(std::uint64_t point);

 private:
  /// The system with other parameters, without reading the whole scene again, where nothing but
  /// parameters varies.
  struct Quick {
    Quick(const Study& study, const BuiltScene& scene);
    /// False: one of them is out of range.
    bool put(const std::vector<double>& values);

    bool possible = true;
    const ModelInfo& model;
    SystemSpec spec;
    std::vector<std::string> names;  // of what varies
  };

  bool mayGoTogether() const;
  bool isQuick(const std::vector<double>& values);
  /// Nothing: it is not such a rotor. Throws what a system that is refused throws.
  std::optional<IsotropicRotor> rotorAt(const std::vector<double>& values, bool quick);
  /// Nothing where they cannot go together after all.
  std::optional<std::vector<Outcome>> together(std::uint64_t block);

  const Study& study_;
  const std::atomic<bool>& stop_;
  PointEvaluator one_;
  BuiltScene scene_;  // as it is
  bool together_;
  std::optional<Quick> quick_;
};

}  // namespace whirl_twin
