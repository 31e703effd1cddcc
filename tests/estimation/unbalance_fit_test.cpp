// Unbalance from a run-up and from steady speeds, of rotors whose unbalance is known.
#include "estimation/unbalance_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "analysis/synchronous_response.h"

namespace whirl_twin {
namespace unbalance_fit_test {

using Complex = std::complex<double>;
constexpr double kTurn = 6.283185307179586;
constexpr double kRadian = kTurn / 360.0;

/// A disc on a shaft, x and y: 2 kg, critical speed 60 rad/s, damping ratio 0.05.
LinearRotor jeffcott() {
  LinearRotor rotor;
  rotor.matrices = [](double) {
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity(), none = Eigen::Matrix2d::Zero();
    return Linearization{2.0 * one, 12.0 * one, none, 7200.0 * one, none};
  };
  rotor.load = Eigen::Vector2d::Zero();
  return rotor;
}
const Station kDisc{"disc", 0.0, Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY()};

std::vector<RotorProbe> twoProbes(double noise) {
  RotorProbe x, y;
  x.name = "x";
  x.along = Eigen::Vector2d::UnitX();
  y.name = "y";
  y.along = Eigen::Vector2d::UnitY();
  x.deviation = y.deviation = noise;
  return {x, y};
}

/// Response of the disc of mass 2 kg with the unbalance `unbalance` in a run-up from rest: by its
/// exact solution in the shaft's own coordinates, by small Runge-Kutta steps.
struct JeffcottRun {
  Complex unbalance = std::polar(2.0e-4, 0.9);  // kg m
  double step = 5.0e-4;                         // s
  std::function<double(double)> speed, angle;

  /// z at each step.
  std::vector<Complex> z(double duration) const {
    const auto acceleration = [&](double t, Complex z, Complex v) {
      const double h = 1.0e-5;
      const double a = (speed(t + h) - speed(t - h)) / (2.0 * h);
      const Complex force =
          unbalance * Complex(speed(t) * speed(t), -a) * std::polar(1.0, angle(t));
      return (force - 12.0 * v - 7200.0 * z) / 2.0;
    };
    std::vector<Complex> all;
    Complex z, v;
    for (int i = 0; i * step < duration; ++i) {
      all.push_back(z);
      constexpr int kFiner = 4;
      const double h = step / kFiner;
      for (int k = 0; k < kFiner; ++k) {
        const double t = i * step + k * h;
        const Complex a1 = acceleration(t, z, v);
        const Complex a2 = acceleration(t + 0.5 * h, z + 0.5 * h * v, v + 0.5 * h * a1);
        const Complex a3 =
            acceleration(t + 0.5 * h, z + 0.5 * h * v + 0.25 * h * h * a1, v + 0.5 * h * a2);
        const Complex a4 = acceleration(t + h, z + h * v + 0.5 * h * h * a2, v + h * a3);
        z += h * v + h * h / 6.0 * (a1 + a2 + a3);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      }
    }
    return all;
  }
};

ProbeReading reading(std::int64_t i, double time, double angle, double speed, Complex z) {
  ProbeReading r;
  r.index = i;
  r.time = time;
  r.turns = static_cast<std::int64_t>(std::floor(angle / kTurn));
  r.remainder = angle - kTurn * static_cast<double>(r.turns);
  r.speed = speed;
  r.values = Eigen::Vector2d(z.real(), z.imag());
  return r;
}

/// Run-outs 12e-6 m at 0.4 rad and 8e-6 m at -1 rad, of x and y, and what is noise.
Complex shown(Complex z, double angle, Complex noise) {
  return z + Complex(12e-6 * std::cos(angle + 0.4), 8e-6 * std::cos(angle - 1.0)) +
         Complex(1e-4, -3e-4) + noise;
}

TEST(UnbalanceFit, FindsTheUnbalanceOfARunUpThroughTheCriticalSpeed) {
  JeffcottRun run;
  run.speed = [](double t) { return 10.0 * t; };
  run.angle = [](double t) { return 5.0 * t * t; };
  const std::vector<Complex> z = run.z(10.0);
  UnbalanceFit fit(jeffcott(), {{"disc", kDisc}}, twoProbes(0.0));
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double t = static_cast<double>(i) * run.step;
    const double angle = run.angle(t);
    fit.take(
        reading(static_cast<std::int64_t>(i), t, angle, run.speed(t), shown(z[i], angle, 0.0)));
  }
  const UnbalanceEstimate result = fit.estimate();
  ASSERT_TRUE(result.planes[0].identifiable);
  EXPECT_NEAR(std::abs(result.planes[0].value), 2.0e-4, 1e-9 * 2.0e-4);
  EXPECT_NEAR(std::arg(result.planes[0].value), 0.9, 1e-9);
  EXPECT_LT(std::abs(result.run_outs[0].value - std::polar(12e-6, 0.4)), 1e-13);
  EXPECT_LT(std::abs(result.run_outs[1].value - std::polar(8e-6, -1.0)), 1e-13);
  EXPECT_TRUE(result.unidentifiable.empty());
  EXPECT_LT(result.noise, 1e-12);
}

// Two stamps that are one but for rounding are not the distance of samples.
TEST(UnbalanceFit, IsNotMisledByTwoStampsAtOneInstant) {
  JeffcottRun run;
  run.speed = [](double t) { return 10.0 * t; };
  run.angle = [](double t) { return 5.0 * t * t; };
  const std::vector<Complex> z = run.z(10.0);
  UnbalanceFit fit(jeffcott(), {{"disc", kDisc}}, twoProbes(0.0));
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double t = static_cast<double>(i) * run.step;
    const double angle = run.angle(t);
    const auto index = static_cast<std::int64_t>(i);
    fit.take(reading(index, t, angle, run.speed(t), shown(z[i], angle, 0.0)));
    if (i == 1000) {
      fit.take(reading(index, t + 1.0e-14, angle, run.speed(t), shown(z[i], angle, 0.0)));
    }
  }
  const UnbalanceEstimate result = fit.estimate();
  ASSERT_TRUE(result.planes[0].identifiable);
  EXPECT_LT(std::abs(result.planes[0].value - run.unbalance), 1e-6 * 2.0e-4);
}

// 3 um of noise, and ambient vibration that is not white: 2 % and 2 degrees, deviations that hold.
TEST(UnbalanceFit, IsWithinTwoPercentAndTwoDegreesAfterTenSecondsOfANoisyRunUp) {
  JeffcottRun run;
  run.speed = [](double t) { return 10.0 * t; };
  run.angle = [](double t) { return 5.0 * t * t; };
  const std::vector<Complex> z = run.z(10.0);
  int inside = 0;
  constexpr int kRuns = 50;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    UnbalanceFit fit(jeffcott(), {{"disc", kDisc}}, twoProbes(3e-6));
    Complex ambient;
    const Complex decayed = std::exp(Complex(-3.0, 60.0) * run.step);
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double t = static_cast<double>(i) * run.step;
      const double angle = run.angle(t);
      ambient = decayed * ambient + 2e-6 * std::sqrt(1.0 - std::norm(decayed)) *
                                        Complex(normal(random), normal(random));
      const Complex noise = ambient + 3e-6 * Complex(normal(random), normal(random));
      fit.take(
          reading(static_cast<std::int64_t>(i), t, angle, run.speed(t), shown(z[i], angle, noise)));
    }
    const UnbalanceEstimate result = fit.estimate();
    const PhasorEstimate& disc = result.planes[0];
    ASSERT_TRUE(disc.identifiable);
    EXPECT_NEAR(std::abs(disc.value), 2.0e-4, 0.02 * 2.0e-4);
    EXPECT_NEAR(std::arg(disc.value), 0.9, 2.0 * kRadian);
    EXPECT_LT(disc.deviation, 0.01 * 2.0e-4);
    EXPECT_NEAR(result.beyond_noise, std::hypot(1.0, 2.0 / 3.0), 0.1);
    inside += std::fabs(disc.value.real() - run.unbalance.real()) < 2.0 * disc.deviation;
    inside += std::fabs(disc.value.imag() - run.unbalance.imag()) < 2.0 * disc.deviation;
  }
  EXPECT_GE(inside, 0.88 * 2 * kRuns);
}

/// Steady speeds one after the other, each 3 s long, of the steady response.
UnbalanceEstimate atSteadySpeeds(const std::vector<double>& speeds, bool run_out_known) {
  std::vector<RotorProbe> probes = twoProbes(1e-9);
  for (RotorProbe& probe : probes) {
    probe.run_out_known = run_out_known;
    probe.run_out = probe.name == "x" ? std::polar(12e-6, 0.4) : std::polar(8e-6, -1.0);
  }
  UnbalanceFit fit(jeffcott(), {{"disc", kDisc}}, probes);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::int64_t index = 0;
  double begin = 0.0;
  for (const double speed : speeds) {
    const Complex response = std::polar(2.0e-4, 0.9) * speed * speed /
                             Complex(7200.0 - 2.0 * speed * speed, 12.0 * speed);
    for (int i = 0; i < 3000; ++i) {
      const double t = 1e-3 * i;
      const double angle = speed * t;
      fit.take(reading(index++, begin + t, angle, speed,
                       shown(response * std::polar(1.0, angle), angle,
                             1e-9 * Complex(normal(random), normal(random)))));
    }
    begin += 10.0;
  }
  return fit.estimate();
}

TEST(UnbalanceFit, DoesNotTellRunOutFromUnbalanceAtOneSpeedAndSaysSo) {
  const UnbalanceEstimate one = atSteadySpeeds({45.0}, false);
  EXPECT_FALSE(one.planes[0].identifiable);
  EXPECT_FALSE(one.run_outs[0].identifiable);
  ASSERT_EQ(one.unidentifiable.size(), 2u);  // two real directions: one of each part
  for (const UnidentifiableCombination& combination : one.unidentifiable) {
    // In them the run-out is the response of the disc to the unbalance, with opposite sign.
    const Complex x = combination.planes[0] * 2025.0 / Complex(7200.0 - 4050.0, 540.0);
    EXPECT_LT(std::abs(combination.run_outs[0] + x), 1e-6 * std::abs(x));
    EXPECT_LT(std::abs(combination.run_outs[1] - Complex(0.0, 1.0) * x), 1e-6 * std::abs(x));
  }
  const UnbalanceEstimate two = atSteadySpeeds({45.0, 75.0}, false);
  EXPECT_TRUE(two.unidentifiable.empty());
  ASSERT_TRUE(two.planes[0].identifiable);
  EXPECT_LT(std::abs(two.planes[0].value - std::polar(2.0e-4, 0.9)), 1e-8);
  const UnbalanceEstimate known = atSteadySpeeds({45.0}, true);
  EXPECT_TRUE(known.unidentifiable.empty());
  EXPECT_LT(std::abs(known.planes[0].value - std::polar(2.0e-4, 0.9)), 1e-8);
}

/// Two discs that tilt on their shaft and are gyroscopic: 4 coordinates, matrices that change with
/// speed.
LinearRotor gyroscopic() {
  LinearRotor rotor;
  rotor.speed_dependent = true;
  rotor.matrices = [](double speed) {
    Eigen::Matrix4d m = Eigen::Vector4d(3.0, 3.0, 0.06, 0.06).asDiagonal();
    Eigen::Matrix4d k = Eigen::Vector4d(3.2e4, 3.6e4, 900.0, 900.0).asDiagonal();
    k(0, 3) = k(3, 0) = 1500.0;
    k(1, 2) = k(2, 1) = -1500.0;
    Eigen::Matrix4d c = Eigen::Vector4d(20.0, 20.0, 0.4, 0.4).asDiagonal();
    Eigen::Matrix4d g = Eigen::Matrix4d::Zero();
    g(2, 3) = 0.09 * speed;
    g(3, 2) = -0.09 * speed;
    return Linearization{m, c, g, k, Eigen::Matrix4d::Zero()};
  };
  rotor.load = Eigen::Vector4d::Zero();
  return rotor;
}

TEST(DrivenWhirl, IsTheSteadyResponseAfterALongTimeAtASpeed) {
  LinearRotor rotor = gyroscopic();
  rotor.forces.push_back({Eigen::Vector4cd(1e-4, Complex(0.0, -1e-4), 0.0, 0.0), 1, true});
  DrivenWhirl whirl(rotor, rotor.forces);
  whirl.start(20.0);
  double speed = 20.0;
  for (int i = 0; i < 60000; ++i) {
    const double next = std::min(150.0, speed + 0.02);
    whirl.advance(1e-3, 1e-3 * 0.5 * (speed + next), next);
    speed = next;
  }
  const Eigen::VectorXcd steady = synchronousResponse(rotor, {}, 150.0).q;
  EXPECT_LT((whirl.amplitudes().col(0) - steady).norm(), 2e-3 * steady.norm());
  whirl.start(150.0);
  EXPECT_LT((whirl.amplitudes().col(0) - steady).norm(), 2e-3 * steady.norm());
}

TEST(DrivenWhirl, IsTheRunUpOfTheEquationsOfMotion) {
  LinearRotor rotor = gyroscopic();
  rotor.forces.push_back({Eigen::Vector4cd(1e-4, Complex(0.0, -1e-4), 0.0, 0.0), 1, true});
  rotor.forces.push_back({Eigen::Vector4cd(0.3, Complex(0.0, -0.2), 0.0, 0.0), 1, false});
  DrivenWhirl whirl(rotor, rotor.forces);
  whirl.start(0.0);
  // 12 rad/s^2 through both critical speeds; the unsimplified equations by Runge-Kutta.
  Eigen::Vector4d q = whirl.amplitudes().rowwise().sum().real(), v = Eigen::Vector4d::Zero();
  const auto acceleration = [&](double t, const Eigen::Vector4d& x, const Eigen::Vector4d& rate) {
    const Linearization at = rotor.matrices(12.0 * t);
    return Eigen::Vector4d(at.mass.diagonal().cwiseInverse().asDiagonal() *
                           (rotor.shaftForce(6.0 * t * t, 12.0 * t, 12.0) -
                            (at.damping + at.gyroscopic) * rate - at.stiffness * x));
  };
  const double h = 5e-4;
  double largest = 0.0, off = 0.0;
  for (int i = 0; i < 24000; ++i) {
    const double t = i * h;
    const Eigen::Vector4d a1 = acceleration(t, q, v);
    const Eigen::Vector4d a2 = acceleration(t + 0.5 * h, q + 0.5 * h * v, v + 0.5 * h * a1);
    const Eigen::Vector4d a3 =
        acceleration(t + 0.5 * h, q + 0.5 * h * v + 0.25 * h * h * a1, v + 0.5 * h * a2);
    const Eigen::Vector4d a4 = acceleration(t + h, q + h * v + 0.5 * h * h * a2, v + h * a3);
    q += h * v + h * h / 6.0 * (a1 + a2 + a3);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    const double now = t + h;
    whirl.advance(h, 6.0 * (now * now - t * t), 12.0 * now);
    const Eigen::Vector4d model =
        (whirl.amplitudes().rowwise().sum() * std::polar(1.0, 6.0 * now * now)).real();
    largest = std::max(largest, q.norm());
    off = std::max(off, (model - q).norm());
  }
  EXPECT_LT(off, 6e-3 * largest);
}

}  // namespace unbalance_fit_test
}  // namespace whirl_twin
