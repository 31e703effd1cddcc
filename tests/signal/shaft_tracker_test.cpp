#include "signal/shaft_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "signal/recorded_signal.h"

namespace whirl_twin {
namespace shaft_tracker_test {

constexpr double kTurn = ShaftAngle::kTurn;
constexpr double kNanosecond = 1.0e-9;  // s

/// A shaft whose angle [rad] at a time [s] is known; it does not turn back.
struct KnownShaft {
  std::function<double(double)> angle;
  double jitter = 0.0;   // [s]
  double missing = 0.0;  // share of the pulses
  double twice = 0.0;    // fraction of pulses followed by a spurious one before the next
  double dead_from = 1.0e9, dead_to = 0.0;  // [s], the pick-up fails

  /// Instants [ns] until a time [s].
  std::vector<std::int64_t> pulses(double until) const {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    const auto instantOf = [&](double wanted) {
      double low = 0.0, high = until;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (angle(middle) < wanted ? low : high) = middle;
      }
      return 0.5 * (low + high);
    };
    std::vector<std::int64_t> pulses;
    double next = instantOf(kTurn);
    for (int k = 1; kTurn * (k + 1) < angle(until); ++k) {
      const double t = next;
      next = instantOf(kTurn * (k + 1));
      const bool dead = t > dead_from && t < dead_to;
      if (!dead && uniform(random) >= missing) {
        pulses.push_back(std::llround((t + jitter * normal(random)) / kNanosecond));
      }
      if (!dead && uniform(random) < twice) {
        pulses.push_back(std::llround((t + uniform(random) * (next - t)) / kNanosecond));
      }
    }
    return pulses;
  }
};

/// Errors of the tracker, at instants between the last pulse but one and half a turn beyond the
/// last.
struct Errors {
  int asked = 0, known = 0, within_two = 0;
  double largest = 0.0;        // [rad], of the angle modulo a turn, where known
  double largest_total = 0.0;  // [rad], turns and all, less those before it was found
  double largest_speed = 0.0;  // [rad/s]
  double last_deviation = 0.0;
};

Errors follow(ShaftTracker& tracker, const KnownShaft& shaft, double until, double from = 0.0) {
  Errors errors;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.5);
  std::int64_t before = 0;
  double offset = std::nan("");
  for (const std::int64_t pulse : shaft.pulses(until)) {
    const std::int64_t previous = before;
    if (!tracker.take(pulse)) {
      continue;
    }
    before = pulse;
    if (static_cast<double>(pulse) * kNanosecond < from) {
      continue;
    }
    const std::int64_t instant =
        previous + std::llround(uniform(random) * static_cast<double>(pulse - previous));
    const ShaftEstimate found = tracker.at(instant);
    ++errors.asked;
    if (!found.known) {
      continue;
    }
    ++errors.known;
    const double t = static_cast<double>(instant) * kNanosecond;
    const double error = found.angle.total() - shaft.angle(t);
    if (std::isnan(offset)) {
      offset = kTurn * std::round(error / kTurn);
    }
    const double rest = std::remainder(error, kTurn);
    errors.within_two += std::fabs(rest) <= 2.0 * found.deviation ? 1 : 0;
    errors.largest = std::max(errors.largest, std::fabs(rest));
    errors.largest_total = std::max(errors.largest_total, std::fabs(error - offset));
    const double speed = (shaft.angle(t + 1.0e-5) - shaft.angle(t - 1.0e-5)) / 2.0e-5;
    errors.largest_speed = std::max(errors.largest_speed, std::fabs(found.speed - speed));
    errors.last_deviation = found.deviation;
  }
  return errors;
}

KnownShaft steadyShaft(double speed) {
  return {[speed](double t) { return 0.3 + speed * t; }};
}

TEST(ShaftTracker, FollowsASteadyShaftToItsClocksResolution) {
  ShaftTracker tracker({0.0, 1.0e-9, 1.0});
  const Errors errors = follow(tracker, steadyShaft(157.3), 5.0, 1.0);
  EXPECT_EQ(errors.known, errors.asked);
  EXPECT_LT(errors.largest_total, 1.0e-6);
  EXPECT_LT(errors.largest_speed, 1.0e-4);
  EXPECT_EQ(tracker.counts().refused + tracker.counts().missed, 0);
}

TEST(ShaftTracker, CountsAnglesFromTheMark) {
  ShaftTracker tracker({1.25, 1.0e-9, 1.0});
  for (const std::int64_t pulse : steadyShaft(100.0).pulses(1.0)) {
    tracker.take(pulse);
  }
  EXPECT_NEAR(tracker.at(tracker.newest()).angle.remainder, 1.25, 1.0e-6);
}

TEST(ShaftTracker, ItsDeviationIsThatOfItsErrors) {
  // A shaft that agrees with the filter's model: random-walk acceleration, jittering pulses.
  constexpr double kJerk = 40.0, kStep = 1.0e-4, kUntil = 60.0;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> angle{0.0}, speeds{200.0};
  double acceleration = 0.0;
  for (double t = 0.0; t < kUntil; t += kStep) {
    const double next = acceleration + std::sqrt(kJerk * kStep) * normal(random);
    const double mean = 0.5 * (acceleration + next);
    angle.push_back(angle.back() + speeds.back() * kStep + 0.5 * mean * kStep * kStep);
    speeds.push_back(speeds.back() + mean * kStep);
    acceleration = next - 0.02 * kStep * (speeds.back() - 200.0) * 10.0;  // stays near 200 rad/s
  }
  ASSERT_GT(*std::min_element(speeds.begin(), speeds.end()), 50.0);
  KnownShaft shaft{[&](double t) {
    const auto i = std::min(static_cast<std::size_t>(std::max(0.0, t) / kStep), angle.size() - 2);
    const double rest = t - kStep * static_cast<double>(i);
    return angle[i] + (angle[i + 1] - angle[i]) * rest / kStep;
  }};
  shaft.jitter = 2.0e-5;
  ShaftTracker tracker({0.0, shaft.jitter, kJerk});
  const Errors errors = follow(tracker, shaft, kUntil - 1.0, 1.0);
  ASSERT_GT(errors.known, 1000);
  const double share = static_cast<double>(errors.within_two) / errors.known;
  EXPECT_GT(share, 0.93);
  EXPECT_LT(share, 0.98);
}

TEST(ShaftTracker, FollowsARunUpWithJitterMissingAndDoublePulses) {
  KnownShaft shaft{[](double t) { return 20.0 * t + 0.5 * 20.0 * t * t; }};
  shaft.jitter = kTurn / 4096.0 / 200.0;  // a 4096th of a turn at the end
  shaft.missing = 0.1;
  shaft.twice = 0.05;
  ShaftTracker tracker({0.0, shaft.jitter, 10.0});
  const Errors errors = follow(tracker, shaft, 9.0, 1.5);
  EXPECT_EQ(errors.known, errors.asked);
  EXPECT_LT(errors.largest_total, 0.01);
  EXPECT_GT(errors.within_two, 0.95 * errors.known);
  EXPECT_NEAR(static_cast<double>(tracker.counts().missed), 15.0, 8.0);
  EXPECT_EQ(tracker.counts().locked, 1);
}

// Converters of 10 to 1,000 us with a scene that specifies 1 us, steady and in run-ups through a
// wide range: the pulses are accepted, and the angle is as accurate as with the right value.
TEST(ShaftTracker, LearnsTheJitterThatNobodyStated) {
  for (const double step : {1.0e-5, 3.9e-5, 1.0e-4, 3.0e-4}) {
    for (const double acceleration : {0.0, 10.0}) {
      KnownShaft shaft{
          [acceleration](double t) { return 0.3 + 60.0 * t + 0.5 * acceleration * t * t; }};
      const auto pulsesOf = [&] {
        std::vector<std::int64_t> pulses = shaft.pulses(20.0);
        for (std::int64_t& pulse : pulses) {
          const double steps = std::round(static_cast<double>(pulse) * kNanosecond / step);
          pulse = std::llround(steps * step / kNanosecond);
        }
        return pulses;
      };
      const double right = step / std::sqrt(12.0);
      ShaftTracker tracker({0.0, 1.0e-6, 10.0}), stated({0.0, right, 10.0});
      double worst = 0.0, worst_stated = 0.0;
      for (const std::int64_t pulse : pulsesOf()) {
        tracker.take(pulse);
        stated.take(pulse);
        const double t = static_cast<double>(pulse) * kNanosecond;
        if (t > 2.0) {
          ASSERT_TRUE(tracker.at(pulse).known) << step << ", " << acceleration << ", at " << t;
          const auto error = [&](const ShaftTracker& of) {
            return std::fabs(std::remainder(of.at(pulse).angle.total() - shaft.angle(t), kTurn));
          };
          worst = std::max(worst, error(tracker));
          worst_stated = std::max(worst_stated, error(stated));
        }
      }
      SCOPED_TRACE(testing::Message() << "step " << step << " s, " << acceleration << " rad/s^2");
      EXPECT_LT(tracker.counts().refused, tracker.counts().taken / 25 + 8);
      EXPECT_LT(tracker.refusedLately(), 4);
      EXPECT_LT(worst, 2.0 * worst_stated + 5.0e-3);
      if (right > 3.0e-5) {  // a finer one shows at some speeds only
        EXPECT_NEAR(tracker.jitter() / right, 1.0, 0.7);
      }
    }
  }
}

TEST(ShaftTracker, AStatedJitterHoldsWhereThePulsesDoNotContradictIt) {
  KnownShaft shaft = steadyShaft(150.0);
  shaft.jitter = 2.0e-5;
  ShaftTracker tracker({0.0, 2.0e-5, 10.0});
  int other = 0, all = 0;
  for (const std::int64_t pulse : shaft.pulses(60.0)) {
    tracker.take(pulse);
    ++all;
    other += tracker.jitter() != 2.0e-5 ? 1 : 0;
  }
  EXPECT_LT(other, all / 20);
}

TEST(ShaftTracker, CountsWhatWasRefusedLately) {
  ShaftTracker tracker({0.0, 1.0e-6, 1.0});
  std::int64_t last = 0;
  for (const std::int64_t pulse : steadyShaft(100.0).pulses(5.0)) {
    tracker.take(pulse);
    last = pulse;
  }
  EXPECT_EQ(tracker.refusedLately(), 0);
  std::mt19937_64 random(7);  // a broken pick-up: pulses at random
  std::exponential_distribution<double> wait(60.0);
  for (int i = 0; i < 40; ++i) {
    last += std::llround(wait(random) / kNanosecond) + 1;
    tracker.take(last);
  }
  EXPECT_GT(tracker.refusedLately(), ShaftTracker::kLately / 2);
}

TEST(ShaftTracker, RefusesPulsesThatAreNone) {
  KnownShaft shaft = steadyShaft(120.0);
  shaft.jitter = kTurn / 4096.0 / 120.0;
  shaft.twice = 0.05;
  ShaftTracker tracker({0.0, shaft.jitter, 1.0});
  const Errors errors = follow(tracker, shaft, 60.0, 1.0);
  EXPECT_EQ(errors.known, errors.asked);
  EXPECT_LT(errors.largest_total, 0.01);
  EXPECT_GT(errors.within_two, 0.95 * errors.known);
  EXPECT_NEAR(static_cast<double>(tracker.counts().refused), 57.0, 25.0);
  EXPECT_EQ(tracker.counts().missed, 0);
}

TEST(ShaftTracker, CountsTheTurnsOfAGapThatItCanBridge) {
  KnownShaft shaft{[](double t) { return 100.0 * t + 0.5 * 1.5 * t * t; }};
  shaft.jitter = 1.0e-6;
  shaft.dead_from = 4.0;
  shaft.dead_to = 6.0;
  ShaftTracker tracker({0.0, 1.0e-6, 1.0e-3});
  const Errors errors = follow(tracker, shaft, 10.0, 1.0);
  EXPECT_LT(errors.largest_total, 0.2);
  EXPECT_EQ(tracker.counts().locked, 1);
  EXPECT_NEAR(static_cast<double>(tracker.counts().missed), 215.0 / kTurn, 1.0);
  EXPECT_NEAR(tracker.at(tracker.newest()).angle.total(),
              shaft.angle(static_cast<double>(tracker.newest()) * kNanosecond) - kTurn,
              0.01);  // the first pulse begins turn 0
}

TEST(ShaftTracker, LosesAShaftHonestlyAndFindsItAgain) {
  // In a gap of two seconds without data, it goes from 100 to 160 rad/s.
  const auto angle = [](double t) {
    const double late = std::clamp(t - 4.0, 0.0, 2.0);
    return 100.0 * t + 15.0 * late * late + 60.0 * std::max(0.0, t - 6.0);
  };
  KnownShaft shaft{angle};
  shaft.dead_from = 4.0;
  shaft.dead_to = 6.0;
  ShaftTracker tracker({0.0, 1.0e-6, 100.0});
  std::int64_t last = 0;
  double deviation = 0.0;
  for (const std::int64_t pulse : shaft.pulses(4.0)) {
    tracker.take(pulse);
    last = pulse;
  }
  for (const double gap : {0.01, 0.1, 0.5, 2.0}) {
    const ShaftEstimate now = tracker.at(last + std::llround(gap / kNanosecond));
    EXPECT_GT(now.deviation, deviation);
    deviation = now.deviation;
    EXPECT_EQ(now.known, gap < 1.0);
  }
  std::vector<std::int64_t> after;
  for (const std::int64_t pulse : shaft.pulses(9.0)) {
    if (pulse > 6'000'000'000) {
      after.push_back(pulse);
    }
  }
  ASSERT_GT(after.size(), 30u);
  for (std::size_t i = 0; i < after.size(); ++i) {
    tracker.take(after[i]);
    const ShaftEstimate now = tracker.at(after[i]);
    if (now.known) {
      EXPECT_GE(i, 3u);
      const double t = static_cast<double>(after[i]) * kNanosecond;
      EXPECT_NEAR(std::remainder(now.angle.total() - angle(t), kTurn), 0.0, 1.0e-3);
      EXPECT_NEAR(now.speed, 160.0, 0.5);
    }
  }
  EXPECT_TRUE(tracker.at(after.back()).known);
  EXPECT_EQ(tracker.counts().locked, 2);
}

TEST(ShaftTracker, FollowsAShaftWhoseAccelerationJumps) {
  KnownShaft shaft{[](double t) {
    const double late = std::max(0.0, t - 3.0);
    return 60.0 * t + 0.5 * 40.0 * late * late;
  }};
  ShaftTracker tracker({0.0, 1.0e-6, 1.0});
  const Errors errors = follow(tracker, shaft, 6.0, 4.0);
  EXPECT_EQ(errors.known, errors.asked);
  EXPECT_LT(errors.largest_total, 0.02);
}

// From a steady speed into run-ups that no filter of a steady shaft expects: four pulses later it
// follows them, with the acceleration to 2 %.
TEST(ShaftTracker, FollowsAFastRunUpFromItsFourthPulseOn) {
  for (const double acceleration : {20.0, 90.0, 300.0, 900.0}) {
    KnownShaft shaft{[acceleration](double t) {
      const double late = std::max(0.0, t - 3.0);
      return 0.3 + 24.0 * t + 0.5 * acceleration * late * late;
    }};
    ShaftTracker tracker({0.0, 1.0e-6, 10.0});
    int after = 0;
    for (const std::int64_t pulse : shaft.pulses(5.0)) {
      tracker.take(pulse);
      const double t = static_cast<double>(pulse) * kNanosecond;
      after += t > 3.0 ? 1 : 0;
      if (after >= 5) {
        const ShaftEstimate found = tracker.at(pulse);
        ASSERT_TRUE(found.known) << acceleration << ", pulse " << after;
        EXPECT_NEAR(found.speed, 24.0 + acceleration * (t - 3.0), 0.02 * found.speed);
        EXPECT_NEAR(found.acceleration, acceleration, 0.02 * acceleration)
            << acceleration << ", pulse " << after;
      }
    }
    ASSERT_GT(after, 8);
  }
}

TEST(ShaftTracker, FindsTheSpeedAfterHavingSeenEverySecondPulseOnly) {
  const KnownShaft shaft = steadyShaft(100.0);
  const std::vector<std::int64_t> pulses = shaft.pulses(10.0);
  ShaftTracker tracker({0.0, 1.0e-6, 1.0});
  for (std::size_t i = 0; i < pulses.size(); i += i < 20 ? 2 : 1) {
    tracker.take(pulses[i]);
    if (i == 18) {
      EXPECT_NEAR(tracker.at(pulses[i]).speed, 50.0, 1.0);  // as it must look
    }
  }
  EXPECT_NEAR(tracker.at(pulses.back()).speed, 100.0, 1.0e-2);
}

TEST(ShaftTracker, OfAShaftThatStandsNothingIsKnown) {
  ShaftTracker tracker({0.0, 1.0e-6, 10.0});
  EXPECT_FALSE(tracker.at(0).known);
  EXPECT_EQ(tracker.at(1'000'000'000).speed, 0.0);
  // Runs down to a stop within ten seconds, and starts again at twenty.
  const auto angle = [](double t) {
    const double down = std::min(t, 10.0), up = std::max(0.0, t - 20.0);
    return 100.0 * down - 5.0 * down * down + 5.0 * up * up;
  };
  for (const std::int64_t pulse : KnownShaft{angle}.pulses(19.0)) {
    tracker.take(pulse);
  }
  const std::int64_t turns = tracker.at(tracker.newest()).angle.turns;
  EXPECT_FALSE(tracker.at(15'000'000'000).known);
  EXPECT_GE(tracker.at(15'000'000'000).speed, 0.0);
  for (const std::int64_t pulse : KnownShaft{angle}.pulses(26.0)) {
    if (pulse > 20'000'000'000) {
      tracker.take(pulse);
    }
  }
  const ShaftEstimate now = tracker.at(tracker.newest());
  EXPECT_TRUE(now.known);
  EXPECT_NEAR(now.speed, 10.0 * (static_cast<double>(tracker.newest()) * kNanosecond - 20.0), 0.2);
  EXPECT_GT(now.angle.turns, turns);
}

TEST(ShaftTracker, APulseThatIsNotLaterIsRefused) {
  ShaftTracker tracker;
  EXPECT_FALSE(tracker.take(100));
  EXPECT_FALSE(tracker.take(100));
  EXPECT_FALSE(tracker.take(50));
  EXPECT_EQ(tracker.counts().refused, 2);
}

TEST(RecordedSignal, TheSpeedKeptForLongest) {
  EXPECT_NEAR(longestKeptSpeed({{10.0, 1.0}, {100.0, 3.0}, {100.5, 2.0}, {200.0, 4.0}}), 100.2,
              1e-9);
}

}  // namespace shaft_tracker_test
}  // namespace whirl_twin
