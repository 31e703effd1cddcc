// The eigenvalues of every rotor of a shipped scene, full-order and reduced, and of random shafts,
// against the dense solution in extended precision: to 1e-9 of their moduli, at rest and at speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "all_eigenvalues.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/equilibria.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/stability.h"
#include "mechanics/rotors/full_order_rotor.h"
#include "random_shafts.h"
#include "scene/built_scene.h"
#include "scene/held_rotor.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace eigenvalue_agreement_test {

constexpr double kAgrees = 1.0e-9;
constexpr double kUsualSpeed = 100.0;  // [rad/s], of a rotor whose scene gives none

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    if (file.path().extension() == ".yaml") {
      names.push_back(file.path().stem());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The eigenvalues that `twin analyze` reports, with all modes up to a hundred coordinates.
void expectAgreement(const Linearization& l, const std::string& which) {
  if (rigidBodyMotions(l).any()) {
    return;  // its zeros are set aside (free_rotors_test.cpp)
  }
  const std::vector<std::complex<double>> all = allEigenvalues(l);
  const Stability s = stability(l);
  EXPECT_EQ(s.eigenvalues.size() + s.omitted, all.size()) << which;
  EXPECT_LE(worstDifference(s.eigenvalues, all), kAgrees) << which;
  if (const auto lowest = lowestEigenvalues(banded(l), 6)) {
    EXPECT_LE(worstDifference(lowest->roots, all), kAgrees) << which << ", the lowest";
  }
}

class ShippedRotors : public testing::TestWithParam<std::string> {};

TEST_P(ShippedRotors, HaveTheEigenvaluesOfTheDenseSolution) {
  const BuiltScene scene =
      build(readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/" + GetParam() + ".yaml"));
  for (const SharedSystem& system : scene.systems) {
    const std::shared_ptr<const Dynamics> dynamics = heldDynamics(*system);
    if (!dynamics->isRotor() || !dynamics->hasShaft()) {
      continue;
    }
    const double highest = scene.driveOf(*system).speedRange().second;
    for (const double speed : {0.0, highest > 0.0 ? highest : kUsualSpeed}) {
      const std::string which = system->spec.name + " at " + std::to_string(speed);
      const std::vector<Equilibrium> rests = equilibria(*dynamics, speed);
      const Eigen::VectorXd rest =
          rests.empty() ? Eigen::VectorXd::Zero(dynamics->dof()) : rests.front().q;
      const Linearization l = linearizationAtRest(*dynamics, rest, speed);
      if (l.stiffness.allFinite()) {
        expectAgreement(l, which);
      }
      if (!dynamics->linear()) {
        continue;
      }
      const LinearRotor rotor = dynamics->linearRotor();
      const auto* const assembled = rotor.matrices.target<AssembledMatrices>();
      if (assembled != nullptr && assembled->unreduced) {
        expectAgreement(assembled->unreduced->assembly->matrices(speed), which + ", whole");
      }
    }
  }
}

// Nearly rigid bearings together with soft ones, and shafts with material damping, leave seven
// correct digits of the lowest whirls in the dense solution in doubles.
TEST(RandomShafts, HaveTheEigenvaluesOfTheDenseSolution) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const RandomShaft drawn = randomShaft(seed, 3 + static_cast<int>(seed % 8));
    const RotorAssembly rotor(drawn.shaft);
    for (const double speed : {0.0, drawn.speed > 0.0 ? drawn.speed : kUsualSpeed}) {
      expectAgreement(rotor.matrices(speed), "seed " + std::to_string(seed));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ShippedRotors, testing::ValuesIn(shippedScenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace eigenvalue_agreement_test
}  // namespace whirl_twin
