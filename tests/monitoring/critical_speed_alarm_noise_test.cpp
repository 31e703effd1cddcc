// Critical-speed alerts from a real pick-up: noise makes no chatter, dropped-out values no alerts.
#include <random>

#include "watched_rotor.h"

namespace whirl_twin {
namespace critical_speed_alarm_noise_test {

TEST(CriticalSpeedAlarmNoise, NoiseOfThePickUpMakesNoChatter) {
  // Noise of 0.3 rad/s rms within the hysteresis of 1.6 rad/s, ramps slow enough for the edges to
  // be crossed some hundred times.
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 0.3);
    const auto noise = [&] { return std::clamp(normal(random), -0.9, 0.9); };
    AlarmSettings settings;
    settings.dwell_limit = 1000.0;
    WatchedRotor rotor({criticalAt(100.0, 80.0, 120.0)}, settings);
    rotor.move(70.0, 20.0, 0.0, noise);
    rotor.move(130.0, 1.0, 2.0, noise);
    for (const bool raised : {true, false}) {
      EXPECT_EQ(rotor.count(kApproach, raised), 1) << "seed " << seed;
      EXPECT_EQ(rotor.count(kInBand, raised), 1) << "seed " << seed;
    }
  }
}

TEST(CriticalSpeedAlarmNoise, ASpeedThatIsNotANumberNeitherRaisesNorClears) {
  WatchedRotor rotor;
  for (int step = 0; step < 3000; ++step) {
    rotor.see(kNaN, kNaN, kNaN);
  }
  EXPECT_TRUE(rotor.events.empty());

  rotor.see(100.0, 0.0, 100.0);
  ASSERT_EQ(rotor.list.active().size(), 1u);
  for (int step = 0; step < 3000; ++step) {
    rotor.see(kNaN, 20.0, 200.0);
    rotor.see(std::numeric_limits<double>::infinity(), 20.0, 200.0);
  }
  EXPECT_EQ(rotor.list.active().size(), 1u);
  for (int step = 0; step < 900; ++step) {
    rotor.see(150.0, 0.0, 150.0);
  }
  rotor.see(kNaN, 0.0, 150.0);
  for (int step = 0; step < 900; ++step) {
    rotor.see(150.0, 0.0, 150.0);
  }
  EXPECT_EQ(rotor.count(kInBand, false), 0) << "the delay was broken";
}

TEST(CriticalSpeedAlarmNoise, AnAccelerationThatIsNotANumberHoldsTheApproach) {
  WatchedRotor rotor;
  rotor.see(79.5, kNaN, 200.0);
  EXPECT_TRUE(rotor.events.empty());
  rotor.see(60.0, 20.0, 200.0);
  ASSERT_EQ(rotor.list.active().size(), 1u);
  for (int step = 0; step < 3000; ++step) {
    rotor.see(20.0, kNaN, 20.0);
  }
  EXPECT_EQ(rotor.list.active().size(), 1u);
}

}  // namespace critical_speed_alarm_noise_test
}  // namespace whirl_twin
