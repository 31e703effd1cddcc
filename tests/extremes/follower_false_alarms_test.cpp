// A state estimator of an unchanged plant: less than one false alarm a day, of any kind, over a
// thousand simulated hours of a rotor of one mode at 200 Hz (an hour without WHIRL_TWIN_EXTREMES).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "../estimation/followed_machine.h"
#include "measured.h"

namespace whirl_twin {
namespace follower_false_alarms_test {

constexpr const char* kRotor = R"(
name: rig
step: 0.005
drives:
  shaft: {speed: 45.0}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
sensors:
  probes:
    rate: 200.0
    block: 1.0
    seed: %
    channels:
      x: {measures: rotor.x, noise: 3.0e-6}
      y: {measures: rotor.y, noise: 3.0e-6}
  tacho: {keyphasor: shaft, jitter: 2.0e-5, block: 1.0}
)";

constexpr int kTold = 10;  // h, of two hours of a core for a thousand

TEST(FollowerFalseAlarms, AreFewerThanOneADay) {
  const auto hours = static_cast<int>(runOf(1, 1000));
  int drifts = 0, mismatches = 0;
  for (int hour = 0; hour < hours; ++hour) {
    std::string text = kRotor;
    text.replace(text.find('%'), 1, std::to_string(hour + 1));
    FollowSettings settings;
    settings.systems["rotor"].parameters = {{"stiffness", {0.05, 2.0e-5}}};
    Machine machine(text);
    Twinned twin(text, settings);
    bool drifting = false;
    double judged = 0.0;
    std::size_t seen = 0;
    while (machine.time() < 3600.0) {
      for (const state::Measurement& m : machine.step()) {
        twin.follower.take(m);
      }
      for (; seen < twin.published.size(); ++seen) {
        const state::FollowState& published = twin.published[seen];
        const bool drifts_now = !published.drift_parameter.empty();
        drifts += drifts_now && !drifting ? 1 : 0;
        drifting = drifts_now;
        if (published.mismatch != judged) {
          judged = published.mismatch;
          mismatches += published.mismatch > published.mismatch_limit ||
                                published.mismatch < published.mismatch_least ||
                                std::fabs(published.whiteness) > published.whiteness_limit
                            ? 1
                            : 0;
        }
      }
      twin.published.clear();
      seen = 0;
    }
    if ((hour + 1) % kTold == 0) {
      fmt::print("{} h: {} drifts, {} windows beyond their limits\n", hour + 1, drifts, mismatches);
      std::fflush(stdout);
    }
  }
  // Poisson: of `hours` / 24 expected, three standard deviations more.
  const double expected = hours / 24.0;
  expectWithin(expected + 3.0 * std::sqrt(expected), drifts,
               fmt::format("false alarms of drift in {} h", hours));
  expectWithin(expected + 3.0 * std::sqrt(expected), mismatches,
               fmt::format("windows of residuals beyond their limits in {} h", hours));
}

}  // namespace follower_false_alarms_test
}  // namespace whirl_twin
