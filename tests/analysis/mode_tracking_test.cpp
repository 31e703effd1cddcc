#include "analysis/mode_tracking.h"

#include <gtest/gtest.h>

#include "rotors_under_test.h"

namespace whirl_twin {
namespace mode_tracking_test {

// A rotor of so many coordinates is followed by Newton's method from speed to speed.
TEST(ModeTracking, WhatIsFollowedIsAmongAllModesOfTheRotor) {
  for (const double internal : {0.0, 30.0}) {
    const RotorUnderTest r = chainRotor(30, 5.0e5, 1.3, 60.0, internal);
    const ModeTracker tracker(r.rotor.matrices, r.stations);
    ModeTracker::Modes modes = tracker.lowest(0.0, 12);
    ASSERT_EQ(modes.size(), 12U);
    for (double speed = 20.0; speed <= 200.0; speed += 20.0) {
      modes = tracker.follow(modes, speed - 20.0, speed);
      const WhirlModes all = whirlModes(r.rotor, r.stations, speed);
      for (std::size_t i = 0; i < modes.size(); ++i) {
        ASSERT_TRUE(modes[i]);
        const auto apart = modes[i]->eigenvalue - all.modes[i].eigenvalue;
        EXPECT_LE(std::abs(apart), 1.0e-9 * std::abs(modes[i]->eigenvalue)) << speed << ' ' << i;
        EXPECT_EQ(modes[i]->whirl, all.modes[i].whirl);
      }
    }
  }
}

}  // namespace mode_tracking_test
}  // namespace whirl_twin
