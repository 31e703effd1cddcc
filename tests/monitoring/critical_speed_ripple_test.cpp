// A speed that ripples about the edge of a band raises each alert once; a slow passage is no
// danger; the countdown of an approach counts.
#include <cmath>
#include <functional>
#include <set>

#include "watched_rotor.h"

namespace whirl_twin {
namespace critical_speed_ripple_test {

enum class Ripple { kSine, kTriangle, kSquare };

// 10 s of ripple about the mean, after rest beside the band. target_known: the ends of the moves.
void ripple(WatchedRotor& rotor, Ripple form, double mean, double part, double period,
            bool target_known) {
  const double amplitude = part * mean;
  for (double t = 0.0; t < 10.0; t += kStep) {
    const double turn = std::fmod(t / period + 0.75, 1.0);  // from the lowest speed
    double value = 0.0;
    double rate = 0.0;
    if (form == Ripple::kSine) {
      value = std::sin(2.0 * M_PI * turn);
      rate = 2.0 * M_PI / period * std::cos(2.0 * M_PI * turn);
    } else if (form == Ripple::kTriangle) {
      const bool rising = turn < 0.25 || turn >= 0.75;
      rate = rising ? 4.0 / period : -4.0 / period;
      value = rising ? 4.0 * (turn < 0.25 ? turn : turn - 1.0) : 2.0 - 4.0 * turn;
    } else {  // to the other end at once, and rest there
      const double ramp = 0.1 * period;
      const double since = std::fmod(t, 0.5 * period);
      const double from = std::fmod(t / period, 1.0) < 0.5 ? -1.0 : 1.0;
      rate = since < ramp ? -2.0 * from / ramp : 0.0;
      value = since < ramp ? from * (1.0 - 2.0 * since / ramp) : -from;
    }
    const bool up = rate > 0.0 || (rate == 0.0 && value > 0.0);
    const double target = target_known ? mean + (up ? amplitude : -amplitude) : kNaN;
    rotor.see(mean + amplitude * value, amplitude * rate, target);
  }
}

TEST(CriticalSpeedRipple, RaisesEachAlertAtMostOnceInTenSeconds) {
  for (const Ripple form : {Ripple::kSine, Ripple::kTriangle, Ripple::kSquare}) {
    for (const double edge : {80.0, 120.0, -80.0}) {
      for (const double part : {0.05, 0.1}) {
        for (const double period : {0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0}) {
          for (const bool target_known : {true, false}) {
            WatchedRotor rotor;
            ripple(rotor, form, edge, part, period, target_known);
            std::set<std::uint32_t> approaches;
            std::set<std::uint32_t> bands;
            for (const state::Alert& event : rotor.events) {
              (event.type == kApproach ? approaches : bands).insert(event.id);
            }
            const auto what = ::testing::Message()
                              << "form " << static_cast<int>(form) << ", edge " << edge << ", part "
                              << part << ", period " << period << ", target " << target_known;
            EXPECT_LE(approaches.size(), 1u) << what;
            EXPECT_EQ(bands.size(), 1u) << what;
          }
        }
      }
    }
  }
}

TEST(CriticalSpeedRipple, ASpeedThatTurnsBackToTheBandKeepsItsAlert) {
  WatchedRotor rotor;
  ripple(rotor, Ripple::kSine, 80.0, 0.1, 4.0, false);
  EXPECT_EQ(rotor.count(kInBand, false), 0);
  EXPECT_EQ(rotor.list.active().size(), 1u);
}

// API's bands reach far: an ordinary run-up takes longer than the dwell limit through them, up to
// twice as long.
TEST(CriticalSpeedPassage, ASlowSteadyPassageIsNoDanger) {
  for (const double acceleration : {14.0, 10.0, 6.8}) {
    for (const double target : {200.0, -200.0}) {
      WatchedRotor rotor;
      rotor.move(target, acceleration);
      EXPECT_EQ(rotor.count(kInBand, true), 1);
      EXPECT_EQ(rotor.event(kInBand, true).severity, state::Severity::kWarning);
      rotor.move(0.0, acceleration);
      EXPECT_EQ(rotor.count(kInBand, true), 2);
      EXPECT_EQ(rotor.event(kInBand, true, 1).severity, state::Severity::kWarning);
    }
  }
}

TEST(CriticalSpeedPassage, OneThatTakesTooLongIsDangerAtTheDwellLimit) {
  WatchedRotor rotor;
  rotor.move(200.0, 6.5);  // 6.15 s
  ASSERT_EQ(rotor.count(kInBand, true), 2);
  EXPECT_NEAR(rotor.event(kInBand, true, 1).time, 80.0 / 6.5 + 3.0, 2 * kStep);
}

TEST(CriticalSpeedPassage, BandsThatOverlapMayTakeOnceMoreForEach) {
  for (const double acceleration : {10.0, 8.0}) {  // 8 s, 10 s from 80 to 160 rad/s
    WatchedRotor rotor({criticalAt(100.0, 80.0, 120.0), criticalAt(140.0, 115.0, 160.0)});
    rotor.move(200.0, acceleration);
    bool danger = false;
    for (const state::Alert& event : rotor.events) {
      danger = danger || event.severity == state::Severity::kDanger;
    }
    EXPECT_EQ(danger, acceleration == 8.0);
  }
}

/// [s] after it enters the band at 80 rad/s that a shaft of this speed and acceleration is in
/// danger; NaN: never. Its target is not known.
double dangerAfter(const std::function<double(double)>& speed,
                   const std::function<double(double)>& acceleration) {
  WatchedRotor rotor;
  double entered = kNaN;
  for (double t = 0.0; t < 30.0; t += kStep) {
    rotor.see(speed(t), acceleration(t), kNaN);
    if (std::isnan(entered) && speed(t) >= 80.0) {
      entered = t;
    }
  }
  for (const state::Alert& event : rotor.events) {
    if (event.type == kInBand && event.severity == state::Severity::kDanger) {
      return event.time - entered;
    }
  }
  return kNaN;
}

// A motor that nears its speed: the acceleration falls as the shaft goes, and never is nothing.
TEST(CriticalSpeedPassage, AnAccelerationThatFallsIsJudgedAsItFalls) {
  const auto toward = [](double end, double time_constant) {
    const auto left = [=](double t) { return (end - 60.0) * std::exp(-t / time_constant); };
    return dangerAfter([=](double t) { return end - left(t); },
                       [=](double t) { return left(t) / time_constant; });
  };
  for (const double time_constant : {0.5, 1.0, 2.0}) {
    EXPECT_NEAR(toward(100.0, time_constant), 3.0, 0.01) << "it will stay";
  }
  // It still gains 7 rad/s^2 when the limit is over, and half as much a second later.
  EXPECT_GT(toward(118.0, 2.0), 3.0 - 0.01);
  EXPECT_LT(toward(118.0, 2.0), 4.7);
  EXPECT_TRUE(std::isnan(toward(200.0, 10.0))) << "it leaves after " << 10.0 * std::log(120. / 80.);
}

TEST(CriticalSpeedPassage, ARippleMakesNoPassageOfADwellAndNoDwellOfAPassage) {
  for (const double period : {0.4, 0.7, 1.0, 2.0, 3.0, 4.0}) {
    for (const double part : {0.01, 0.03, 0.05}) {
      const double rate = 2.0 * M_PI / period;
      const auto rippling = [=](double gain, double end) {
        const auto mean = [=](double t) { return std::min(60.0 + gain * t, end); };
        return dangerAfter([=](double t) { return mean(t) + part * 100.0 * std::sin(rate * t); },
                           [=](double t) {
                             return (mean(t) < end ? gain : 0.0) +
                                    part * 100.0 * rate * std::cos(rate * t);
                           });
      };
      const auto what = ::testing::Message() << "period " << period << ", part " << part;
      EXPECT_NEAR(rippling(50.0, 100.0), 3.0, 0.01) << what;
      EXPECT_TRUE(std::isnan(rippling(12.0, 200.0))) << what << ": " << rippling(12.0, 200.0);
    }
  }
}

TEST(CriticalSpeedPassage, OneThatMeansToStayIsDangerAtTheDwellLimit) {
  WatchedRotor rotor;
  rotor.move(115.0, 8.0);  // 4.4 s to there, the way out would take 5 s
  ASSERT_EQ(rotor.count(kInBand, true), 2);
  EXPECT_NEAR(rotor.event(kInBand, true, 1).time, 80.0 / 8.0 + 3.0, 2 * kStep);
}

TEST(CriticalSpeedPassage, OneThatStopsOnItsWayIsDangerThen) {
  WatchedRotor rotor;
  for (int step = 0; step < 4000; ++step) {
    rotor.see(80.0 + 0.007 * step, 7.0, kNaN);
  }
  EXPECT_EQ(rotor.count(kInBand, true), 1);
  rotor.see(108.0, 0.0, kNaN);
  ASSERT_EQ(rotor.count(kInBand, true), 2);
  EXPECT_EQ(rotor.event(kInBand, true, 1).severity, state::Severity::kDanger);
}

TEST(CriticalSpeedCountdown, IsToldAnewWhileItRuns) {
  WatchedRotor rotor;
  int published = 0;
  for (int step = 1; step <= 1900; ++step) {
    rotor.see(60.0 + 0.01 * step, 10.0, 200.0);
    published += rotor.list.takeChanged() ? 1 : 0;
    ASSERT_EQ(rotor.list.active().size(), 1u);
    EXPECT_NEAR(rotor.list.active()[0].time_to_entry, 2.0 - 0.001 * step, 1.0e-9);
  }
  EXPECT_NEAR(published, 10, 1) << "five times a second";
  EXPECT_EQ(rotor.events.size(), 1u) << "and raised once";
}

TEST(CriticalSpeedCountdown, ThatWouldTakeForEverIsNone) {
  WatchedRotor rotor;
  rotor.see(79.0, 1.0e-13, kNaN);
  const state::Alert approach = rotor.event(kApproach, true);
  EXPECT_TRUE(std::isnan(approach.time_to_entry));
  EXPECT_EQ(approach.text,
            "rotor: critical speed 100.0 rad/s (955 rpm), close to 79.0 rad/s (754 rpm): do not "
            "dwell between 80.0 rad/s (764 rpm) and 120.0 rad/s (1146 rpm)");
}

}  // namespace critical_speed_ripple_test
}  // namespace whirl_twin
