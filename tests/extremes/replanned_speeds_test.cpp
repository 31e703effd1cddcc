// A shaft with new target speeds in the middle of a move, any number of times: within its limits to
// rounding, time-optimal, and inside a band only while it crosses it at its largest acceleration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "control/drive.h"
#include "measured.h"

namespace whirl_twin {
namespace replanned_speeds_test {

constexpr double kUlp = std::numeric_limits<double>::epsilon();
using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double anySize(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/// [s], of the fastest change, in extended precision: with the given initial acceleration, jerk to
/// a peak, constant acceleration, jerk to zero.
long double fastest(const SpeedSegment& now, const SpeedMove& move) {
  const long double jerk = move.max_jerk;
  const long double limit = move.max_acceleration;
  const long double a = now.acceleration;
  const long double stop = now.speed + a * std::abs(a) / (2.0L * jerk);
  const long double way = move.speed >= stop ? 1.0L : -1.0L;
  const long double start = way * a;
  const long double missing = way * (move.speed - stop);
  // Gained by a ramp from `start` up to a peak and down to nothing: peak^2 / J - start |start| /
  // 2J.
  const long double rest = std::max(0.0L, start);
  const long double free_peak = std::sqrt(jerk * missing + rest * rest);
  if (free_peak <= limit) {
    return std::abs(free_peak - start) / jerk + free_peak / jerk;
  }
  const long double ramps = std::max(0.0L, limit * limit - rest * rest) / jerk;
  return std::abs(limit - start) / jerk + (missing - ramps) / limit + limit / jerk;
}

SpeedSegment endOf(const SpeedSegment& piece, double t) {
  return {0.0, piece.speed + t * (piece.acceleration + 0.5 * t * piece.jerk),
          piece.acceleration + t * piece.jerk, 0.0};
}

TEST(ReplannedSpeeds, KeepTheirLimitsAndAreTheFastest) {
  Random random(31);
  double beyond = 0.0;  // ulp, of the largest acceleration that is allowed
  double slower = 0.0;  // of the duration
  double overshoot = 0.0;
  for (std::int64_t i = runOf(100000, 1000000); i > 0; --i) {
    const SpeedMove move{uniform(random, -1e3, 1e3), anySize(random, 0.1, 1e3),
                         anySize(random, 0.1, 1e3), 0.0};
    const SpeedSegment now{0.0, uniform(random, -1e3, 1e3),
                           i % 4 == 0 ? 0.0 : uniform(random, -2.0, 2.0) * move.max_acceleration,
                           0.0};
    const SpeedChange change = planSpeedChange(now.speed, now.acceleration, move);
    const double allowed = std::max(move.max_acceleration, std::abs(now.acceleration));
    const double stop = stoppingSpeed(now.speed, now.acceleration, move.max_jerk);
    const auto [lowest, highest] = std::minmax({now.speed, stop, move.speed});
    const double scale = std::max(std::abs(lowest), std::abs(highest));
    for (std::size_t k = 0; k < change.count; ++k) {
      const SpeedSegment& piece = change.segments[k];
      ASSERT_LE(std::abs(piece.jerk), move.max_jerk);
      for (const double share : {0.0, uniform(random, 0.0, 1.0), 1.0}) {
        const SpeedSegment there = endOf(piece, share * piece.duration);
        beyond = std::max(beyond, (std::abs(there.acceleration) - allowed) / (allowed * kUlp));
        overshoot = std::max({overshoot, (there.speed - highest) / (scale * kUlp),
                              (lowest - there.speed) / (scale * kUlp)});
      }
    }
    const long double least = fastest(now, move);
    slower = std::max(slower, static_cast<double>(std::abs(change.duration - least) / least));
  }
  expectWithin(4.0, beyond, "acceleration beyond its limit, ulp");
  expectWithin(4.0, overshoot, "speed beyond the ends of the move, ulp");
  expectWithin(1.0e-12, slower, "duration beside the closed form");
}

/// Bands of any number and width, none nearer to standstill than a run-up.
ExclusionBands anyBands(Random& random, double run_up) {
  std::vector<SpeedBand> bands(1 + random() % 4);
  for (SpeedBand& band : bands) {
    band.from = run_up + uniform(random, 1.0, 300.0);
    band.to = band.from + uniform(random, 1.0, 40.0);
  }
  return ExclusionBands(bands);
}

// Commands at any time; the drive is sampled over all of its pieces.
TEST(ReplannedSpeeds, AreInABandOnlyWhileTheyCrossItAtTheLargestAcceleration) {
  constexpr int kCommands = 10;
  constexpr int kLooks = 150;  // over a move
  Random random(32);
  double missing = 0.0;  // of the acceleration, inside of a band
  std::int64_t inside = 0;
  for (std::int64_t sequence = runOf(2000, 100000); sequence > 0; --sequence) {
    const double limit = anySize(random, 1.0, 100.0);
    const double jerk = sequence % 8 == 0 ? 0.0 : limit * anySize(random, 0.3, 30.0);
    const double run_up = jerk == 0.0 ? 0.0 : limit * limit / (2.0 * jerk);
    const double rounding = 1.0e-9 * (500.0 + run_up);
    const ExclusionBands bands = anyBands(random, run_up);
    const double start = bands.allowed(uniform(random, 0.0, 400.0), limit, jerk,
                                       std::numeric_limits<double>::quiet_NaN());
    Drive drive(start, 0.0, {}, 0, bands);
    std::int64_t now = 0;
    for (int command = 0; command < kCommands; ++command) {
      const double asked = command % 4 == 3 ? 0.0 : uniform(random, -50.0, 450.0);
      ASSERT_TRUE(drive.setSpeed(asked, limit, jerk));
      const double duration = drive.moveDuration();
      for (int look = 0; look <= kLooks; ++look) {
        const ShaftMotion motion = drive.at(duration * look / kLooks);
        for (const SpeedBand& band : bands.bands()) {
          if (motion.speed > band.from + rounding && motion.speed < band.to - rounding) {
            missing = std::max(missing, 1.0 - std::abs(motion.acceleration) / limit);
            ++inside;
          }
        }
      }
      ASSERT_FALSE(bands.bandOf(drive.targetSpeed(), limit, jerk)) << "it would stay in a band";
      Drive finished = drive;
      finished.begin(now + std::llround(duration * 1.0e9) + kMicrosecond);
      ASSERT_EQ(finished.at(0.0).speed, drive.targetSpeed());
      now += std::llround(uniform(random, 0.0, 1.1) * duration * 1.0e9);
      drive.begin(now);
    }
  }
  EXPECT_GT(inside, 10000);
  expectWithin(1.0e-9, missing, "acceleration missing inside of a band");
}

}  // namespace replanned_speeds_test
}  // namespace whirl_twin
