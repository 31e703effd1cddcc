// Conversion of measured values between units.
#include "messages/units.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl_twin {
namespace units_test {

TEST(Units, AreBroughtToWhatIsWanted) {
  EXPECT_EQ(unitScale("m", "m"), 1.0);
  EXPECT_DOUBLE_EQ(unitScale("mm", "m"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("um", "mm"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("deg", "rad"), M_PI / 180.0);
  EXPECT_DOUBLE_EQ(unitScale("mm/s", "m/s"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("mN m", "N m"), 1.0e-3);
  EXPECT_EQ(unitScale("V", "V"), 1.0);
  EXPECT_DOUBLE_EQ(unitScale("kN/mm", "N/m"), 1.0e6);
  EXPECT_DOUBLE_EQ(unitScale("g mm", "kg m"), 1.0e-6);
  EXPECT_DOUBLE_EQ(unitScale("kg cm^2", "kg m^2"), 1.0e-4);
  EXPECT_DOUBLE_EQ(unitScale("GPa", "Pa"), 1.0e9);
  EXPECT_DOUBLE_EQ(unitScale("cP", "Pa s"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("%", "-"), 0.01);
  EXPECT_DOUBLE_EQ(unitScale("1/ms", "1/s"), 1.0e3);
  EXPECT_DOUBLE_EQ(unitScale("µm", "m"), 1.0e-6);
}

// NIST SP 811, appendix B: 1 lbf/in is 175.1268 N/m, 1 psi 6894.757 Pa, 1 lb/in^3 27679.90 kg/m^3.
TEST(Units, OfInchAndPound) {
  EXPECT_NEAR(unitScale("lbf/in", "N/m"), 175.1268, 5e-5);
  EXPECT_NEAR(unitScale("psi", "Pa"), 6894.757, 5e-4);
  EXPECT_NEAR(unitScale("lb/in^3", "kg/m^3"), 27679.90, 5e-3);
  EXPECT_NEAR(unitScale("lbf s/in", "N s/m"), 175.1268, 5e-5);
  EXPECT_NEAR(unitScale("reyn", "Pa s"), 6894.757, 5e-4);
  EXPECT_DOUBLE_EQ(unitScale("mil", "um"), 25.4);
}

TEST(Units, ATurnIsTwoPi) {
  EXPECT_DOUBLE_EQ(unitScale("rpm", "rad/s"), M_PI / 30.0);
  EXPECT_DOUBLE_EQ(unitScale("Hz", "rad/s"), 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(unitScale("rpm", "Hz"), 1.0 / 60.0);
  EXPECT_DOUBLE_EQ(unitScale("rev", "rad"), 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(unitScale("rpm/s", "rad/s^2"), M_PI / 30.0);
  EXPECT_EQ(unitScale("Hz", "1/s"), 0.0) << "a decay of so many 1/s is not of so many Hz";
}

TEST(Units, ThatAreNotSaidAreAsWanted) {
  EXPECT_EQ(unitScale("", "m"), 1.0);
}

TEST(Units, OfAnotherKindAreNotTaken) {
  EXPECT_EQ(unitScale("rad", "m"), 0.0);
  EXPECT_EQ(unitScale("m/s", "m"), 0.0);
  EXPECT_EQ(unitScale("m", "m/s"), 0.0);
  EXPECT_EQ(unitScale("V", "m"), 0.0);
  EXPECT_EQ(unitScale("N", "N m"), 0.0);
  EXPECT_EQ(unitScale("lb", "lbf"), 0.0) << "a mass is no force";
  EXPECT_EQ(unitScale("mm", "-"), 0.0);
  EXPECT_EQ(unitScale("furlong", "m"), 0.0);
  for (const char* none : {"", "-", "10", "m + 1", "m @ 5", "lg(re 1 m)", "rmp"}) {
    EXPECT_FALSE(isUnit(none)) << none;
  }
}

}  // namespace units_test
}  // namespace whirl_twin
