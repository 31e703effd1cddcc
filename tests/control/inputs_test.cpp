// Inputs of a system: the phase of a harmonic after a billion steps, tables at and between their
// instants, breakpoints, commands and their time-out, errors, and no allocation.
#include "control/inputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "allocation_guard.h"

namespace whirl_twin {
namespace inputs_test {

constexpr std::int64_t kSecond = 1000000000;

TEST(Inputs, HarmonicKeepsItsPhase) {
  // 2 pi times a whole number of turns in a second, exact in doubles only as 2 pi itself is: after
  // t seconds the cosine's argument is t (61 * 2 pi rounded), which long double resolves.
  const double frequency = 61.0 * 6.283185307179586;
  Inputs inputs({InputSignal::harmonic(4.3, frequency, 0.4)});
  for (const std::int64_t steps : {0L, 1L, 1000L, 999999999L, 1000000007L}) {
    const std::int64_t time = steps * 1000000;  // 1 ms a step
    inputs.begin(time);
    const long double turn = 6.283185307179586476925286766559L;
    const long double argument = std::fmod(
        static_cast<long double>(frequency) * static_cast<long double>(time) / 1e9L, turn);
    // Long doubles hold 4e8 rad to 2e-11.
    EXPECT_NEAR(std::cos(inputs.phase(0)), std::cos(static_cast<double>(argument) + 0.4), 1e-10);
    EXPECT_NEAR(inputs.value(0, 0.25e-3),
                4.3 * std::cos(static_cast<double>(argument) + 0.4 + frequency * 0.25e-3), 5e-10);
  }
  // A quarter turn a nanosecond-exact microsecond: the phase repeats to the last bits for ever.
  Inputs turning({InputSignal::harmonic(1.0, 1.0, 0.0)});
  turning.begin(kSecond);
  EXPECT_NEAR(turning.value(0, 0.0), std::cos(1.0), 1e-15);
}

TEST(Inputs, HeldTableKeepsItsValues) {
  Inputs inputs({InputSignal::table({100, 250, 1000}, {1.0, -2.0, 5.0}, true)});
  const auto at = [&](std::int64_t time) {
    inputs.begin(time);
    return inputs.value(0, 0.0);
  };
  EXPECT_EQ(at(-5), 1.0);
  EXPECT_EQ(at(100), 1.0);
  EXPECT_EQ(at(249), 1.0);
  EXPECT_EQ(at(250), -2.0);
  EXPECT_EQ(at(5000), 5.0);
  EXPECT_EQ(at(120), 1.0);  // and back
  EXPECT_EQ(inputs.nextCorner(0), 130);
  EXPECT_EQ(inputs.nextCorner(130), 880);
  EXPECT_EQ(inputs.nextCorner(880), Inputs::kNever);
  EXPECT_EQ(inputs.piece(0, 129).value, 1.0);
  EXPECT_EQ(inputs.piece(0, 130).value, -2.0);
  EXPECT_EQ(inputs.piece(0, 130).slope, 0.0);
}

TEST(Inputs, LinearTableGoesStraightFromInstantToInstant) {
  Inputs inputs({InputSignal::table({0, kSecond, 3 * kSecond}, {1.0, 3.0, -1.0}, false)});
  inputs.begin(kSecond / 2);
  EXPECT_DOUBLE_EQ(inputs.value(0, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(inputs.value(0, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(inputs.value(0, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(inputs.value(0, 9.0), -1.0);
  inputs.begin(-kSecond);
  EXPECT_DOUBLE_EQ(inputs.value(0, 0.5), 1.0);
  EXPECT_EQ(inputs.nextCorner(0), kSecond);
  EXPECT_DOUBLE_EQ(inputs.piece(0, kSecond).slope, 2.0);
}

// i' = 100 (held - i): it depends on the elapsed times only, whatever steps begin in between.
TEST(Inputs, BehindALagGoesOnFromInstantToInstant) {
  Inputs inputs({InputSignal::controlled(100.0)});
  inputs.begin(0);
  inputs.control(0, 2.0, 3'000'000);
  for (std::int64_t step = 1; step <= 20; ++step) {
    inputs.begin(1'000'000 * step);
    const double now = step < 3 ? 0.0 : 2.0 - 2.0 * std::exp(-0.1 * static_cast<double>(step - 3));
    if (step >= 3) {
      EXPECT_NEAR(inputs.value(0, 0.0), now, 1e-15) << step;
      EXPECT_NEAR(inputs.piece(0, 0).slopeAt(0.0), 100.0 * (2.0 - now), 1e-12) << step;
      EXPECT_NEAR(inputs.value(0, 0.02), 2.0 - (2.0 - now) * std::exp(-2.0), 1e-15) << step;
    }
  }
  inputs.control(0, -1.0, 20'500'000);
  const double then = 2.0 - 2.0 * std::exp(-1.75);
  EXPECT_NEAR(inputs.value(0, 0.0005), then, 1e-15) << "it does not jump";
  EXPECT_NEAR(inputs.value(0, 0.0105), -1.0 + (then + 1.0) * std::exp(-1.0), 1e-15);
  inputs.release(0);
  inputs.begin(0);
  EXPECT_EQ(inputs.value(0, 0.0), 0.0);
  EXPECT_EQ(inputs.value(0, 0.4), 0.0);
}

TEST(Inputs, CornersAreThoseOfAllTables) {
  std::vector<std::int64_t> many;
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) {
    many.push_back(1000 * i);
    values.push_back(i);
  }
  Inputs inputs({InputSignal::constant(1.0), InputSignal::table(many, values, true),
                 InputSignal::table({1500}, {2.0}, true)});
  inputs.begin(1000);
  EXPECT_EQ(inputs.nextCorner(0), 500);
  EXPECT_EQ(inputs.nextCorner(500), 1000);
  EXPECT_EQ(inputs.piece(1, 97500).value, 98.0);
}

TEST(Inputs, CommandHoldsUntilItsTimeOut) {
  Inputs inputs({InputSignal::constant(0.5), InputSignal::harmonic(1.0, 2.0, 0.0), InputSignal{}});
  inputs.begin(0);
  EXPECT_TRUE(inputs.set(0, 7.0, 30));
  EXPECT_EQ(inputs.value(0, 0.0), 0.5);  // from the next step on
  inputs.begin(10);
  EXPECT_EQ(inputs.value(0, 0.0), 7.0);
  EXPECT_TRUE(inputs.commanded(0));
  inputs.begin(29);
  EXPECT_EQ(inputs.value(0, 5e-9), 7.0);  // over the whole step
  inputs.begin(30);
  EXPECT_EQ(inputs.value(0, 0.0), 0.5);
  EXPECT_FALSE(inputs.commanded(0));
  EXPECT_TRUE(inputs.set(0, 7.0, 100));
  inputs.reset();
  inputs.begin(40);
  EXPECT_EQ(inputs.value(0, 0.0), 0.5);
  EXPECT_FALSE(inputs.set(0, std::numeric_limits<double>::quiet_NaN(), 100));
  EXPECT_FALSE(inputs.set(1, 1.0, 100));
  EXPECT_FALSE(inputs.set(2, 1.0, 100));
  EXPECT_FALSE(inputs.set(3, 1.0, 100));
}

TEST(Inputs, RefusesWhatIsNoSignal) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Inputs({InputSignal::constant(nan)}), std::logic_error);
  EXPECT_THROW(Inputs({InputSignal::harmonic(1.0, 1e9, 0.0)}), std::logic_error);
  EXPECT_THROW(Inputs({InputSignal::table({}, {}, true)}), std::logic_error);
  EXPECT_THROW(Inputs({InputSignal::table({1, 2}, {1.0}, true)}), std::logic_error);
  const SignalFault fault = faultOf(InputSignal::table({1, 5, 5}, {1.0, 2.0, 3.0}, false));
  ASSERT_NE(fault.expected, nullptr);
  EXPECT_STREQ(fault.field, "time");
  EXPECT_EQ(fault.row, 2u);
  EXPECT_EQ(faultOf(InputSignal::table({1, 5}, {1.0, 2.0}, false)).expected, nullptr);
}

TEST(Inputs, AllocateNothing) {
  Inputs inputs({InputSignal::constant(0.5), InputSignal::harmonic(1.0, 2.0, 0.0),
                 InputSignal::table({100, 200, 300}, {1.0, 2.0, 3.0}, false)});
  double sum = 0.0;
  {
    const AllocationGuard guard;
    for (std::int64_t time = 0; time < 500; time += 10) {
      inputs.set(0, 1.0, time + 5);
      inputs.begin(time);
      sum += inputs.value(2, 3e-9) +
             inputs.piece(2, std::min<std::int64_t>(inputs.nextCorner(0), 300)).value;
    }
    inputs.reset();
    EXPECT_EQ(guard.allocations(), 0u);
  }
  EXPECT_NE(sum, 0.0);
}

}  // namespace inputs_test
}  // namespace whirl_twin
