// What a sensor says in one unit, in another.
#include "messages/units.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl_twin {
namespace {

TEST(Units, AreBroughtToWhatIsWanted) {
  EXPECT_EQ(unitScale("m", "m"), 1.0);
  EXPECT_DOUBLE_EQ(unitScale("mm", "m"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("um", "mm"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("deg", "rad"), M_PI / 180.0);
  EXPECT_DOUBLE_EQ(unitScale("mm/s", "m/s"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("mN m", "N m"), 1.0e-3);
  EXPECT_EQ(unitScale("V", "V"), 1.0);
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
}

}  // namespace
}  // namespace whirl_twin
