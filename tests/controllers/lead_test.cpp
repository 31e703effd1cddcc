// A lead compensator: its static and initial gain, and the error for a prewarp frequency above half
// of its rate.
#include <gtest/gtest.h>

#include "example_controllers.h"

namespace whirl_twin {
namespace lead_test {

TEST(Lead, ActsAtOnceByThePoleOverTheZero) {
  // Samples so dense that Tustin's rule is continuous time: a step of 1 gives -gain pole / zero,
  // and at last -gain.
  const auto lead = made("lead", {{"gain", 2.0}, {"zero", 1.0}, {"pole", 10.0}, {"setpoint", 5.0}},
                         {}, planOf(1e5, 1));
  const double y = 6.0;
  double u = 0.0;
  lead->update(sampleOf(&y), &u);
  EXPECT_NEAR(u, -20.0, 1e-3);
  for (int k = 0; k < 500000; ++k) {
    lead->update(sampleOf(&y), &u);
  }
  EXPECT_NEAR(u, -2.0, 1e-9);
}

TEST(Lead, IsRefusedAPrewarpBeyondHalfOfTheRate) {
  const auto [name, text] =
      inputError("lead", {{"gain", 2.0}, {"zero", 1.0}, {"pole", 10.0}, {"prewarp", 400.0}}, {},
                 planOf(100.0, 1));
  EXPECT_EQ(name, "prewarp");
  EXPECT_EQ(text, "must be < 314.159 rad/s, half of the rate, found 400");
}

}  // namespace lead_test
}  // namespace whirl_twin
