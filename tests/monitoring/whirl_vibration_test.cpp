// The amplitude that alarms go by is that of the vibration over a revolution about the middle of
// the orbit: an ellipse whose axes lie on either side of a level raises one alarm, and sag none.
#include "monitoring/whirl_vibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "messages/alert.h"
#include "monitoring/vibration_alarms.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace whirl_vibration_test {

using Complex = std::complex<double>;

/// A motion of orders about a place: sum of forward e^{i k angle} + backward e^{-i k angle}.
struct Orbit {
  Complex sag, forward, backward, twice;
  double speed = 100.0;     ///< [rad/s]
  double beat = 0.0;        ///< [rad/s], of 1X
  double beat_depth = 0.0;  ///< part of 1X

  Complex at(double time) const {
    const double angle = speed * time;
    return sag +
           (1.0 + beat_depth * std::cos(beat * time)) *
               (forward * std::polar(1.0, angle) + backward * std::polar(1.0, -angle)) +
           twice * std::polar(1.0, 2.0 * angle);
  }
  state::WhirlState state(double time) const {
    state::WhirlState whirl = circularWhirl("rotor", time, 0.0, speed);
    whirl.x = at(time).real();
    whirl.y = at(time).imag();
    whirl.radius = std::abs(at(time));
    return whirl;
  }
};

/// Largest distance [m] from the middle of the box around a whole revolution that ends at `time`.
double amplitudeOf(const Orbit& orbit, double time) {
  constexpr int kPlaces = 90;
  double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
  const auto place = [&](int i) { return orbit.at(time - 2.0 * M_PI / orbit.speed * i / kPlaces); };
  for (int i = 0; i <= kPlaces; ++i) {
    left = std::min(left, place(i).real());
    right = std::max(right, place(i).real());
    bottom = std::min(bottom, place(i).imag());
    top = std::max(top, place(i).imag());
  }
  const Complex middle(0.5 * (left + right), 0.5 * (bottom + top));
  double largest = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    largest = std::max(largest, std::abs(place(i) - middle));
  }
  return largest;
}

TEST(WhirlVibration, OfATiltedEllipseIsItsSemiMajorAxisWhereverItsCentreLies) {
  for (const double speed : {3.0, 50.0, 700.0, -400.0}) {
    Orbit orbit;
    orbit.sag = {1.0e-3, -7.0e-3};
    orbit.forward = std::polar(3.0e-4, 0.7);
    orbit.backward = std::polar(2.0e-4, -0.2);
    orbit.speed = speed;
    WhirlVibration vibration;
    double amplitude = 0.0;
    for (int i = 0; i < 4000; ++i) {
      amplitude = vibration.take(orbit.state(1.0e-3 * i));
    }
    if (std::fabs(speed) > 2.0 * M_PI) {  // slower than once a second: of the last second's arc
      EXPECT_NEAR(amplitude, 5.0e-4, 0.005 * 5.0e-4) << speed;
    } else {
      EXPECT_LE(amplitude, 5.0e-4 * 1.01) << speed;
    }
  }
}

TEST(WhirlVibration, IsUnknownUntilARevolutionHasPassed) {
  const Orbit orbit{{}, 1.0e-3, 0.0, 0.0, 20.0};
  WhirlVibration vibration;
  double time = 0.0;
  for (; time < 0.31; time += 0.001) {
    EXPECT_TRUE(std::isnan(vibration.take(orbit.state(time)))) << time;
  }
  time += 0.01;
  EXPECT_NEAR(vibration.take(orbit.state(time)), 1.0e-3, 1.0e-5);
  EXPECT_TRUE(std::isnan(vibration.take(orbit.state(0.0)))) << "time begins again";
}

TEST(WhirlVibration, AShaftAtRestIsJudgedByTheLastSecond) {
  Orbit orbit{{0.0, -1.0e-3}, 0.0, 0.0, 0.0, 0.0};
  WhirlVibration vibration;
  double amplitude = 0.0;
  for (int i = 0; i < 1500; ++i) {
    state::WhirlState state = orbit.state(1.0e-3 * i);
    state.x += 2.0e-4 * std::sin(0.09 * i);  // it swings, 90 rad/s
    amplitude = vibration.take(state);
  }
  EXPECT_NEAR(amplitude, 2.0e-4, 2.0e-6);
}

/// 200 random orbits with sag, 2X and slow beats beside a level: the alarm changes at most as often
/// as the amplitude over a revolution passes the level upward and its hysteresis downward.
TEST(WhirlVibration, AnAlarmChangesNoMoreOftenThanTheVibrationPassesItsLevel) {
  constexpr double kLevel = 1.0e-3;
  constexpr double kStep = 1.0e-3;
  std::mt19937 random(20);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  int raised_by_radius = 0;
  for (int k = 0; k < 200; ++k) {
    int i = 0;
    Orbit orbit;
    orbit.speed = std::exp(uniform(std::log(10.0), std::log(1500.0)));
    const double size = kLevel * uniform(0.6, 1.4);
    const double part = uniform(0.5, 1.0);
    orbit.forward = std::polar(part * size, uniform(-3.0, 3.0));
    orbit.backward = std::polar((1.0 - part) * size, uniform(-3.0, 3.0));
    orbit.sag = std::polar(uniform(0.0, 5.0) * kLevel, uniform(-3.0, 3.0));
    orbit.twice = std::polar(uniform(0.0, 0.2) * size, uniform(-3.0, 3.0));
    orbit.beat = uniform(0.5, 3.0);
    orbit.beat_depth = uniform(0.0, 0.3);
    AlarmSettings settings;
    settings.amplitude["rotor"] = {{}, {kLevel}, {10.0 * kLevel}};
    AmplitudeAlarm alarm("rotor", settings);
    AlertList alerts;
    WhirlVibration vibration;
    int changes = 0, allowed = 1;  // the first verdict
    bool active = false, above = false;
    bool radius_above = false;
    for (double time = 0.0; time < 8.0; time += kStep) {
      const state::WhirlState state = orbit.state(time);
      alarm.update(time, vibration.take(state), orbit.speed, 0.0, alerts);
      const bool now = alerts.find("rotor", alert_type::kWhirlAmplitude) != nullptr;
      changes += now != active ? 1 : 0;
      active = now;
      // What a check with the exact amplitude would change, a little more willing.
      if (i++ % 10 == 0) {  // of beats of seconds
        const double exact = amplitudeOf(orbit, time);
        if (above ? exact < 0.985 * kLevel : exact > 0.995 * kLevel) {
          above = !above;
          ++allowed;
        }
      }
      raised_by_radius += !radius_above && state.radius > kLevel ? 1 : 0;
      radius_above = state.radius > kLevel;
    }
    EXPECT_LE(changes, allowed) << "orbit " << k << " at " << orbit.speed << " rad/s";
  }
  EXPECT_GT(raised_by_radius, 2000) << "the radius of an instant would flip alarms";
}

/// A rotor with gravity that runs true: what it sags is no vibration.
TEST(WhirlVibration, SagRaisesNothing) {
  AlarmSettings settings;
  settings.amplitude["rotor"] = {{}, {0.1e-3}, {0.2e-3}};
  AmplitudeAlarm alarm("rotor", settings);
  AlertList alerts;
  WhirlVibration vibration;
  const Orbit orbit{{0.0, -2.0e-3}, 0.05e-3, 0.0, 0.0, 150.0};
  for (double time = 0.0; time < 3.0; time += 1.0e-3) {
    alarm.update(time, vibration.take(orbit.state(time)), orbit.speed, 0.0, alerts);
  }
  EXPECT_EQ(alerts.find("rotor", alert_type::kWhirlAmplitude), nullptr);
}

}  // namespace whirl_vibration_test
}  // namespace whirl_twin
