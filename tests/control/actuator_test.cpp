// Output of an actuator for a command, and its saturation flag.
#include "control/actuator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace whirl_twin {
namespace actuator_test {

ActuatorSettings settings(double limit, double slew, double resolution) {
  ActuatorSettings s;
  s.limit = limit;
  s.slew = slew;
  s.resolution = resolution;
  return s;
}

TEST(Actuator, WithinItsLimitGivesWhatItIsToldToTheLastBit) {
  Actuator actuator(settings(4.0, 0.0, 0.0), 1.0e-4);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> decades(-9.0, 0.5), sign(-1.0, 1.0);
  for (int i = 0; i < 100000; ++i) {
    const double command = std::copysign(std::pow(10.0, decades(random)), sign(random));
    EXPECT_TRUE(actuator.take(command)) << command;
    EXPECT_EQ(actuator.value(), command);
  }
}

TEST(Actuator, GivesItsLimitAndSaysSo) {
  Actuator actuator(settings(4.0, 0.0, 0.0), 1.0e-4);
  EXPECT_FALSE(actuator.take(5.0));
  EXPECT_EQ(actuator.value(), 4.0);
  EXPECT_FALSE(actuator.take(-1.0e300));
  EXPECT_EQ(actuator.value(), -4.0);
}

TEST(Actuator, FollowsARampThatIsAsSteepAsItsSlew) {
  Actuator actuator(settings(0.0, 1.0, 0.0), 0.1);
  for (int i = 1; i < 1000; ++i) {
    EXPECT_TRUE(actuator.take(0.1 * i)) << i;
  }
  EXPECT_FALSE(actuator.take(200.0));
  EXPECT_NEAR(actuator.value(), 100.0, 1e-9);
}

TEST(Actuator, GivesWholeMultiplesOfItsResolution) {
  Actuator actuator(settings(0.0, 0.0, 0.25), 0.1);
  EXPECT_TRUE(actuator.take(0.6));
  EXPECT_EQ(actuator.value(), 0.5);
}

}  // namespace actuator_test
}  // namespace whirl_twin
