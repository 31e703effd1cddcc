// Swing-up by energy: the number of swings for the acceleration of the pivot, a torque-limited
// pendulum swung up and caught from any state, a cart returned with its pendulum upright, and
// hysteresis of the catch.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "example_controllers.h"

namespace whirl_twin {
namespace swing_up_test {

constexpr double kPi = 3.141592653589793;

/// A step of the classical Runge-Kutta method of a pendulum with g = l = 1 whose pivot is
/// accelerated by a and on which a torque u acts; angle, rate, place of the pivot, its rate.
using State = std::array<double, 4>;
State step(const State& s, double h, double torque, double a) {
  const auto rates = [&](const State& x) {
    return State{x[1], -std::sin(x[0]) - a * std::cos(x[0]) + torque, x[3], a};
  };
  const auto after = [&](const State& x, const State& r, double t) {
    State y = x;
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] += t * r[i];
    }
    return y;
  };
  const State k1 = rates(s);
  const State k2 = rates(after(s, k1, 0.5 * h));
  const State k3 = rates(after(s, k2, 0.5 * h));
  const State k4 = rates(after(s, k3, h));
  State end = s;
  for (std::size_t i = 0; i < end.size(); ++i) {
    end[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  return end;
}

ParameterValues swinging(double drive, double energy_gain) {
  return {{"frequency", 1.0},
          {"drive", drive},
          {"energy_gain", energy_gain},
          {"catch", 0.3},
          {"release", 0.6}};
}

Settings held(const std::vector<double>& gain, const std::string& by) {
  Settings settings = matrices({{"gain", row(gain)}});
  settings.choices["by"] = by;
  return settings;
}

/// Number of reversals before it has the energy of the upright, with pivot acceleration up to n g.
int swingsBy(double n) {
  constexpr double kPeriod = 1e-3;
  ParameterValues values = swinging(n, 1e4);
  values["catch"] = values["release"] = 1e-6;
  const auto law = made("swing_up", values, held({0.0, 0.0}, "pivot"), planOf(1.0 / kPeriod, 2, 1));
  State s{};
  int swings = 1;
  for (int k = 0; k < 200000; ++k) {
    double u = 0.0;
    law->update(sampleOf(s.data(), k), &u);
    const double rate = s[1];
    s = step(s, kPeriod, 0.0, u);
    if (0.5 * s[1] * s[1] - std::cos(s[0]) >= 1.0 - 1e-3) {
      return swings;
    }
    swings += rate * s[1] < 0.0 ? 1 : 0;
  }
  return -1;
}

// The smallest acceleration for 1, 2, 3, 4 and 5 swings, in g (Astrom and Furuta 2000): 4/3,
// 1/sqrt(3), 0.38807, 0.29468, 0.23674.
TEST(SwingUp, TakesAsManySwingsAsTheAccelerationAllows) {
  const double least[] = {4.0 / 3.0, 1.0 / std::sqrt(3.0), 0.38807, 0.29468, 0.23674};
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(swingsBy(1.01 * least[k]), k + 1) << least[k];
    EXPECT_EQ(swingsBy(0.99 * least[k]), k + 2) << least[k];
  }
}

// A torque of 0.3 m g l cannot lift it; k = [3, 2] holds it upright, for 3 > 1.
TEST(SwingUp, CatchesATorqueLimitedPendulumFromAnywhere) {
  constexpr double kPeriod = 5e-3;
  ControllerPlan plan = planOf(1.0 / kPeriod, 2, 1);
  plan.limits = {0.3};
  ParameterValues values = swinging(0.3, 10.0);
  values["catch"] = 0.08;
  values["release"] = 0.5;
  const auto law = made("swing_up", values, held({3.0, 2.0}, "torque"), plan);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int run = 0; run < 1000; ++run) {
    State s{kPi * unit(random), 2.0 * unit(random), 0.0, 0.0};
    law->reset();
    const auto away = [&] { return std::hypot(std::remainder(s[0] - kPi, 2.0 * kPi), s[1]); };
    for (int k = 0; k < 16000 && away() > 1e-6; ++k) {
      double u = 0.0;
      law->update(sampleOf(s.data(), k), &u);
      s = step(s, kPeriod, std::clamp(u, -0.3, 0.3), 0.0);
    }
    ASSERT_LE(away(), 1e-6) << "run " << run;
  }
}

TEST(SwingUp, BringsTheCartBack) {
  constexpr double kPeriod = 2e-3;
  // a = -(k1 phi + k2 phi' + k3 x + k4 x'), phi'' = phi + a, x'' = a:
  // s^4 + (k2 + k4) s^3 + (k1 + k3 - 1) s^2 - k4 s - k3 = (s + 1)^2 (s + 0.2)^2, slow in x, for the
  // swings leave the cart several lengths away.
  const std::vector<double> gain{2.88, 2.88, -0.04, -0.48};
  const auto law =
      made("swing_up", swinging(0.6, 10.0), held(gain, "pivot"), planOf(1.0 / kPeriod, 4, 1));
  State s{0.01, 0.0, 0.0, 0.0};
  bool up = false;
  for (int k = 0; k < 60000; ++k) {
    double u = 0.0;
    law->update(sampleOf(s.data(), k), &u);
    s = step(s, kPeriod, 0.0, u);
    up = up || std::cos(s[0]) < -0.9;
  }
  EXPECT_TRUE(up);
  EXPECT_NEAR(std::remainder(s[0] - kPi, 2.0 * kPi), 0.0, 1e-6);
  EXPECT_NEAR(s[2], 0.0, 1e-6);
}

TEST(SwingUp, LetsGoBeyondReleaseOnly) {
  const auto law =
      made("swing_up", swinging(1.0, 10.0), held({5.0, 0.0}, "torque"), planOf(100.0, 2, 1));
  const auto at = [&](double from_upright) {
    const double y[] = {kPi + from_upright - 4.0 * kPi, 0.0};
    double u = 0.0;
    law->update(sampleOf(y), &u);
    return u;
  };
  EXPECT_NEAR(at(0.5), 1.0, 1e-12) << "not caught yet: full drive";
  EXPECT_NEAR(at(0.25), -1.25, 1e-12) << "caught";
  EXPECT_NEAR(at(0.5), -2.5, 1e-12) << "still";
  EXPECT_NEAR(at(-0.59), 2.95, 1e-12);
  EXPECT_NEAR(at(0.7), 1.0, 1e-12) << "let go";
  EXPECT_NEAR(at(0.5), 1.0, 1e-12);
  at(0.1);
  law->reset();
  EXPECT_NEAR(at(0.5), 1.0, 1e-12);
}

TEST(SwingUp, RefusesWhatDoesNotFit) {
  const ControllerPlan plan = planOf(100.0, 2, 1);
  const auto refused = [&](ParameterValues values, const std::vector<double>& gain,
                           const ControllerPlan& around) {
    return inputError("swing_up", values, held(gain, "torque"), around).first;
  };
  EXPECT_EQ(refused(swinging(1.0, 10.0), {1.0}, plan), "gain");
  EXPECT_EQ(refused(swinging(1.0, 10.0), {1.0}, planOf(100.0, 1, 1)), "gain");
  EXPECT_EQ(refused(swinging(1.0, 10.0), {1.0, 1.0}, planOf(100.0, 2, 2)), "gain");
  ParameterValues tight = swinging(1.0, 10.0);
  tight["release"] = 0.2;
  EXPECT_EQ(refused(tight, {1.0, 1.0}, plan), "release");
  ControllerPlan limited = plan;
  limited.limits = {0.5};
  EXPECT_EQ(refused(swinging(1.0, 10.0), {1.0, 1.0}, limited), "drive");
}

}  // namespace swing_up_test
}  // namespace whirl_twin
