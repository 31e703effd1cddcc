// State feedback by a given gain, on the deviation of the measurement from the set-point.
#include <gtest/gtest.h>

#include "example_controllers.h"

namespace whirl_twin {
namespace state_feedback_test {

TEST(StateFeedback, TakesItsGainOff) {
  const auto law =
      made("state_feedback", {}, matrices({{"gain", row({2, 3})}, {"setpoint", row({1, 0.5})}}),
           planOf(10.0, 2, 1));
  const double y[] = {1.5, -0.5};
  double u = 0.0;
  law->update(sampleOf(y), &u);
  EXPECT_EQ(u, -2.0 * 0.5 + 3.0 * 1.0);
}

TEST(StateFeedback, IsRefusedAGainOfAnotherSize) {
  const auto [name, text] =
      inputError("state_feedback", {}, matrices({{"gain", row({2, 3, 4})}}), planOf(10.0, 2, 1));
  EXPECT_EQ(name, "gain");
  EXPECT_EQ(text, "must be 1 x 2, a row per output, a column per measured signal, found 1 x 3");
}

}  // namespace state_feedback_test
}  // namespace whirl_twin
