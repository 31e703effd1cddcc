#include "transport/step_continuity.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace whirl_twin {
namespace step_continuity_test {

StepContinuity of(std::initializer_list<std::int64_t> steps) {
  StepContinuity continuity;
  for (const auto step : steps) {
    continuity.add(step);
  }
  return continuity;
}

TEST(StepContinuity, OfEveryStepHasNoGap) {
  const auto continuity = of({5, 6, 7, 8});
  EXPECT_EQ(continuity.stride(), 1);
  EXPECT_EQ(continuity.gaps() + continuity.lost(), 0u);
  EXPECT_EQ(continuity.repeated() + continuity.backward(), 0u);
}

TEST(StepContinuity, OfEveryTenthStepHasNoGap) {
  // The last state of a run comes early when the duration is no multiple of the stride.
  const auto continuity = of({0, 10, 20, 30, 33});
  EXPECT_EQ(continuity.stride(), 10);
  EXPECT_EQ(continuity.gaps(), 0u);
}

TEST(StepContinuity, CountsStatesMissingInGaps) {
  const auto continuity = of({0, 10, 20, 50, 60, 80, 90});
  EXPECT_EQ(continuity.gaps(), 2u);
  EXPECT_EQ(continuity.lost(), 3u);  // 30, 40 and 70
}

TEST(StepContinuity, FindsTheStrideAfterAGapAtTheBeginning) {
  const auto continuity = of({0, 4, 5, 6, 7});
  EXPECT_EQ(continuity.stride(), 1);
  EXPECT_EQ(continuity.lost(), 3u);
}

TEST(StepContinuity, TellsRepeatedFromBackward) {
  const auto continuity = of({0, 1, 1, 2, 0, 1});
  EXPECT_EQ(continuity.repeated(), 1u);
  EXPECT_EQ(continuity.backward(), 1u);
  EXPECT_EQ(continuity.gaps(), 0u);
}

// Datagrams overtake one another: late is not lost.
TEST(StepContinuity, PutsLateStatesInTheirPlace) {
  for (const std::int64_t stride : {1, 10}) {
    for (const std::int64_t places : {1, 4, 63}) {
      StepContinuity continuity;
      std::int64_t late = 0;
      for (std::int64_t k = 0; k < 1000; ++k) {
        if (k % 100 != 50) {
          continuity.add(stride * k);
        }
        if (k % 100 == 50 + places || (k % 100 == (50 + places) % 100 && k > 100)) {
          continuity.add(stride * (k - places));
          ++late;
        }
      }
      EXPECT_EQ(continuity.stride(), stride);
      EXPECT_EQ(continuity.late(), static_cast<std::uint64_t>(late)) << places;
      EXPECT_EQ(continuity.lost(), 10u - static_cast<std::uint64_t>(late)) << places;
      EXPECT_EQ(continuity.repeated() + continuity.backward(), 0u);
    }
  }
}

TEST(StepContinuity, AStateTwiceOrMissingIsNotLate) {
  StepContinuity continuity;
  for (std::int64_t k = 0; k < 500; ++k) {
    if (k != 200 && k != 201) {
      continuity.add(k);
    }
    if (k == 100) {
      continuity.add(90);
    }
  }
  EXPECT_EQ(continuity.repeated(), 1u);
  EXPECT_EQ(continuity.lost(), 2u);
  EXPECT_EQ(continuity.gaps(), 1u);
  EXPECT_EQ(continuity.late() + continuity.backward(), 0u);
}

// One state from long before is no reset; states that continue from there are.
TEST(StepContinuity, TellsAStragglerFromATwinThatBeganAnew) {
  StepContinuity continuity;
  for (std::int64_t k = 0; k < 500; ++k) {
    if (k != 10) {
      continuity.add(k);
    }
    if (k == 300) {
      continuity.add(10);
    }
  }
  EXPECT_EQ(continuity.late(), 1u);
  EXPECT_EQ(continuity.backward(), 0u);
  EXPECT_EQ(continuity.lost(), 1u) << "it came too late to be put in its place";
  for (const std::int64_t first : {0, 37}) {
    for (std::int64_t k = first; k < 300; ++k) {
      continuity.add(k);
    }
  }
  EXPECT_EQ(continuity.backward(), 2u);
  EXPECT_EQ(continuity.late(), 1u);
  EXPECT_EQ(continuity.lost(), 1u);
}

TEST(StepContinuity, OfNothingIsNothing) {
  EXPECT_EQ(of({}).stride(), 0);
  EXPECT_EQ(of({}).gaps() + of({}).lost(), 0u);
  EXPECT_EQ(of({7}).stride(), 0);
  EXPECT_EQ(of({7}).lost(), 0u);
}

TEST(StepContinuity, SurvivesThatEveryDifferenceIsAnother) {
  StepContinuity continuity;
  std::int64_t step = 0;
  for (std::int64_t difference = 1; difference <= 5000; ++difference) {
    continuity.add(step += difference);
  }
  continuity.add(std::numeric_limits<std::int64_t>::max());
  EXPECT_GT(continuity.gaps(), 4000u);
}

}  // namespace step_continuity_test
}  // namespace whirl_twin
