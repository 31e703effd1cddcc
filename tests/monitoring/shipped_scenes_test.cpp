// A minute of every scene in config/scenes under its monitor: it raises the alerts that are the
// scene's subject, and no other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "accuracy/step_choice.h"
#include "scene/scene_reader.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace shipped_scenes_test {

using Alerts = std::set<std::string>;  // "SYSTEM TYPE"

/// A run through a critical speed.
Alerts passing(const std::vector<std::string>& rotors, Alerts further = {}) {
  for (const std::string& rotor : rotors) {
    further.insert(rotor + " CRITICAL_SPEED_APPROACH");
    further.insert(rotor + " IN_CRITICAL_BAND");
  }
  return further;
}

/// Of the scenes that have one: what they are about, as their first lines say. Most rotors run
/// through a critical speed, or hang at it; others lose their damping, or have little.
const std::map<std::string, Alerts>& subjects() {
  static const std::map<std::string, Alerts> all = {
      {"avoided_speeds", passing({"rotor"})},
      {"balancing", passing({"rotor"}, {"rotor LOW_DAMPING"})},
      {"bow", passing({"bowed", "unbalanced"})},
      {"demo", passing({"rotor"})},
      {"fluid_whirl", passing({"rotor"}, {"rotor LOW_DAMPING", "rotor UNSTABLE"})},
      {"free_rotor", passing({"strong", "weak"}, {"weak SOMMERFELD_CAPTURE"})},
      {"friswell_rotor", passing({"rotor"}, {"rotor LOW_DAMPING"})},
      {"gyroscopic", passing({"rotor", "struck"}, {"rotor LOW_DAMPING", "struck LOW_DAMPING"})},
      {"hysteresis", passing({"rotor", "sagging"},
                             {"rotor LOW_DAMPING", "rotor UNSTABLE", "sagging LOW_DAMPING"})},
      {"internal_damping", passing({"quiet", "rotor"}, {"rotor LOW_DAMPING", "rotor UNSTABLE"})},
      {"laboratory", passing({"captured", "escaping"}, {"captured SOMMERFELD_CAPTURE"})},
      // At speeds near standstill the loop is unstable with its notch, if the shaft stays there.
      {"levitation", {"magnets LOOP_SENSITIVITY", "rotor LOW_DAMPING", "rotor UNSTABLE"}},
      {"nelson_mcvaugh", passing({"rotor"}, {"rotor LOW_DAMPING"})},
      {"oil_whip", passing({"rotor"}, {"rotor LOW_DAMPING", "rotor UNSTABLE"})},
      {"rub", passing({"dry", "rotor"})},
      {"sommerfeld", passing({"captured", "escaping"}, {"captured SOMMERFELD_CAPTURE"})},
      {"supervised_speed",
       {"prudent RESONANCE_NOT_PASSED", "sprinter RESONANCE_NOT_PASSED",
        "stubborn RESONANCE_NOT_PASSED"}},
      {"throttle", {"bare UNSTABLE"}},
      {"tolerances", passing({"rotor"})},
      // Balanced upside down by one joint: each sensor alone has next to no margin.
      {"upright", {"elbow LOOP_SENSITIVITY", "shoulder LOOP_SENSITIVITY"}}};
  return all;
}

/// Its loop is judged at each speed of its run-up, which takes minutes: only in scripts/test
/// --long.
constexpr const char* kSlow = "levitation";

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    if (entry.path().extension() == ".yaml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// What the simulation reports of the accuracy of its systems.
void reportAccuracy(WatchedTwin& watched) {
  state::LoopStatistics& loop = watched.loop;
  loop.system.clear();
  loop.error_estimate.clear();
  loop.tolerance.clear();
  for (std::size_t i = 0; i < watched.twin.systems().size(); ++i) {
    const SystemSpec& spec = watched.twin.systems()[i]->spec;
    loop.system.push_back(spec.name);
    loop.error_estimate.push_back(watched.observer.errorEstimate(i));
    loop.tolerance.push_back(spec.integrator == "auto" ? spec.tolerance
                                                       : std::numeric_limits<double>::quiet_NaN());
  }
  loop.stopped.assign(loop.system.size(), 0);
  loop.stopped_why.assign(loop.system.size(), "");
  watched.announce();
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, RaisesTheAlertsThatAreItsSubjectAndNoOther) {
  constexpr double kDuration = 60.0;  // s
  constexpr double kMessages = 0.1;   // s apart
  constexpr double kRecords = 0.01;   // s apart
  const char* const length = std::getenv("WHIRL_TWIN_EXTREMES");
  if (GetParam() == kSlow && (length == nullptr || std::string(length) != "full")) {
    GTEST_SKIP() << "in scripts/test --long";
  }
  WatchedTwin watched(
      withStepsChosen(readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/" + GetParam() + ".yaml")));
  const double step = watched.twin.scene().stepSeconds();
  const auto steps = std::llround(kDuration / step);
  const auto every = std::max(1LL, std::llround(kMessages / step));
  const auto look = std::max(1LL, std::llround(kRecords / step));
  const AlarmSettings settings;
  std::vector<double> residual_before(watched.twin.systems().size(), 0.0);
  Alerts raised;
  std::string texts;
  for (long long i = 1; i <= steps; ++i) {
    watched.twin.step();
    // The first steps, too: a motion from rest begins there.
    if (i % every == 0 || i == 1) {
      watched.feed();
      reportAccuracy(watched);
    } else if (i % look == 0) {
      watched.twin.write(watched.record.data());
      watched.observer.observe(watched.record.data());
    }
    // ENERGY_RESIDUAL and ACCURACY_LOST between the messages.
    for (std::size_t k = 0; i % look == 0 && k < residual_before.size(); ++k) {
      const std::string& name = watched.twin.systems()[k]->spec.name;
      const double residual = std::fabs(watched.observer.energyResidual(k));
      ASSERT_LE(std::fmin(residual, residual_before[k]), settings.energy_residual)
          << name << " at " << watched.twin.time() << " s";
      residual_before[k] = residual;
      if (watched.twin.systems()[k]->spec.integrator == "auto") {
        ASSERT_FALSE(watched.observer.errorEstimate(k) > watched.twin.systems()[k]->spec.tolerance)
            << name << " at " << watched.twin.time() << " s";
      }
    }
  }
  for (const state::Alert& alert : watched.events) {
    if (alert.raised) {
      raised.insert(alert.system + " " + alert.type);
      texts += std::to_string(alert.time) + " " + alert.type + " " + alert.text + "\n";
    }
  }
  const auto subject = subjects().find(GetParam());
  EXPECT_EQ(raised, subject == subjects().end() ? Alerts{} : subject->second) << texts;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(shippedScenes()),
                         [](const auto& test) { return test.param; });

}  // namespace shipped_scenes_test
}  // namespace whirl_twin
