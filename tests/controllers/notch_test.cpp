// The synchronous notch: the poles that it adds, with phase and without, against those of
// control.md's levitated mass; the residual synchronous current, and the centre of rotation of the
// rotor then; changes and loss of the speed; pairs and single probes; errors.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "algebra/dense.h"
#include "example_controllers.h"

namespace whirl_twin {
namespace notch_test {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

// A mass of 1 kg that a magnetic bearing's negative stiffness of 1 N/m pushes away, held by kp = 2,
// kd = sqrt(2): its sensitivity at j w.
Complex sensitivity(double w) {
  return -(w * w + 1.0) / Complex(1.0 - w * w, std::sqrt(2.0) * w);
}

ParameterValues levitation(double notch_rate, double phase) {
  return {{"kp", 2.0}, {"kd", std::sqrt(2.0)}, {"notch_rate", notch_rate}, {"notch_phase", phase}};
}

/// The pole nearest to j speed of the loop, x'' = x + u in two axes, samples `period` apart.
Complex poleNear(double speed, double phase, double period) {
  const auto controller = made("pid", levitation(0.01, phase), {}, planOf(1.0 / period, 2));
  const DiscreteStateSpace law = *controller->linear(speed);
  const double ch = std::cosh(period);
  const double sh = std::sinh(period);
  MatrixXd a = MatrixXd::Zero(4, 4);  // x, x', y, y'
  MatrixXd b = MatrixXd::Zero(4, 2);
  MatrixXd c = MatrixXd::Zero(2, 4);
  for (Index i = 0; i < 2; ++i) {
    a.block<2, 2>(2 * i, 2 * i) << ch, sh, sh, ch;
    b.block<2, 1>(2 * i, i) << ch - 1.0, sh;
    c(i, 2 * i) = 1.0;
  }
  MatrixXd loop(4 + law.states(), 4 + law.states());
  loop << a + b * law.d * c, b * law.c, law.b * c, law.a;
  const EigenPairs solver = eigenvalues(loop);
  Complex nearest(1e9, 0.0);
  for (const Complex& z : solver.values) {
    const Complex s = std::log(z) / period;
    if (std::abs(s - Complex(0, speed)) < std::abs(nearest - Complex(0, speed))) {
      nearest = s;
    }
  }
  return nearest;
}

/// In the limit of short sampling periods: the remaining error is of third order.
Complex continuousPoleNear(double speed, double phase) {
  constexpr double kPeriod = 4e-3;
  const Complex one = poleNear(speed, phase, kPeriod);
  const Complex half = poleNear(speed, phase, kPeriod / 2);
  const Complex quarter = poleNear(speed, phase, kPeriod / 4);
  return (one - 6.0 * half + 8.0 * quarter) / 3.0;
}

// Of the continuous loop, worked out for this project: without a phase a slow notch is unstable
// below sqrt(kp - 1) = 1 rad/s.
TEST(Notch, AddsThePolesOfTheContinuousLoop) {
  constexpr double kDigits = 1e-8;
  EXPECT_LT(std::abs(continuousPoleNear(0.5, 0.0) - Complex(0.008726204, 0.491912004)), kDigits);
  EXPECT_LT(std::abs(continuousPoleNear(0.5, -std::arg(sensitivity(0.5))) -
                     Complex(-0.012378508, 0.499911088)),
            kDigits);
  EXPECT_LT(std::abs(continuousPoleNear(2.0, 0.0) - Complex(-0.008848213, 1.991620553)), kDigits);
  EXPECT_LT(std::abs(continuousPoleNear(2.0, -std::arg(sensitivity(2.0))) -
                     Complex(-0.012188247, 2.000021488)),
            kDigits);
}

// A single probe's notch has the pole of a pair's to first order in its rate, in any axis by
// itself.
TEST(Notch, OfASingleProbeIsStableByTheSamePhase) {
  for (const double speed : {0.5, 2.0}) {
    const double period = 1e-3;
    const double phase = -std::arg(sensitivity(speed));
    const auto pole = [&](double turned) {
      const auto controller = made("pid", levitation(0.01, turned), choice("notch_axes", "single"),
                                   planOf(1.0 / period, 1));
      const DiscreteStateSpace law = *controller->linear(speed);
      const double ch = std::cosh(period);
      const double sh = std::sinh(period);
      const MatrixXd a = (MatrixXd(2, 2) << ch, sh, sh, ch).finished();
      const MatrixXd b = Eigen::Vector2d(ch - 1.0, sh);
      const MatrixXd c = row({1, 0});
      MatrixXd loop(2 + law.states(), 2 + law.states());
      loop << a + b * law.d * c, b * law.c, law.b * c, law.a;
      return std::log(eigenvalues(loop).values.cwiseAbs().maxCoeff()) / period;
    };
    EXPECT_NEAR(pole(phase), -0.01 * std::abs(sensitivity(speed)), 1e-3);
    EXPECT_GT(pole(phase + 3.14), 0.005);
  }
}

struct Unbalanced {
  double current;    ///< largest of the last turns
  double amplitude;  ///< [m], likewise
};

/// The mass with its centre of mass 1 m off rotates with the shaft, x'' = x + u + w^2 e^(j w t).
Unbalanced unbalanced(double speed, double notch_rate) {
  constexpr double kPeriod = 0.01;
  const double phase = notch_rate > 0.0 ? -std::arg(sensitivity(speed)) : 0.0;
  const auto controller = made("pid", levitation(notch_rate, phase), {}, planOf(1.0 / kPeriod, 2));
  Complex x(0.0);
  Complex v(0.0);
  Unbalanced last{0.0, 0.0};
  const int samples = 100000;
  for (int k = 0; k < samples; ++k) {
    const double angle = speed * kPeriod * k;
    const double y[] = {x.real(), x.imag()};
    double out[2];
    controller->update({y, k, k * 10000000L, shaftAngle(angle), speed}, out);
    const Complex u(out[0], out[1]);
    // Exactly over the sample: x = homogeneous + what u and the unbalance give, p e^(j w t) - u.
    const Complex p = -speed * speed / (speed * speed + 1.0) * std::polar(1.0, angle);
    const Complex turn = std::polar(1.0, speed * kPeriod);
    const Complex free = x - p + u;
    const Complex free_rate = v - Complex(0, speed) * p;
    x = std::cosh(kPeriod) * free + std::sinh(kPeriod) * free_rate + p * turn - u;
    v = std::sinh(kPeriod) * free + std::cosh(kPeriod) * free_rate + Complex(0, speed) * p * turn;
    if (k > samples - 2000) {
      last.current = std::max(last.current, std::abs(u));
      last.amplitude = std::max(last.amplitude, std::abs(x));
    }
  }
  return last;
}

// With no current at its speed the mass turns at -e m w^2 / (m w^2 + k_s).
TEST(Notch, TakesTheCurrentAtTheShaftsSpeedAway) {
  for (const double speed : {0.5, 0.9, 3.0}) {
    const Unbalanced before = unbalanced(speed, 0.0);
    const Unbalanced with = unbalanced(speed, 0.05);
    EXPECT_GT(before.current, 0.1) << speed;
    EXPECT_LT(with.current, 1e-6 * before.current) << speed;
    EXPECT_NEAR(with.amplitude, speed * speed / (speed * speed + 1.0), 1e-6) << speed;
  }
}

/// Output of a gain of -1 for y = (1, 0) rotating with a shaft: 1 without a notch.
class TurningProbe {
 public:
  explicit TurningProbe(double hold)
      : law_(made("state_feedback", {{"notch_rate", 1.0}, {"notch_hold", hold}},
                  matrices({{"gain", -MatrixXd::Identity(2, 2)}}), planOf(100.0, 2))) {}

  double next(double speed, double target) {
    angle_ += 0.01 * speed;
    const double y[] = {std::cos(angle_), std::sin(angle_)};
    double u[2];
    law_->update({y, 0, 0, shaftAngle(angle_), target}, u);
    return std::hypot(u[0], u[1]);
  }
  double next(double speed) { return next(speed, speed); }

 private:
  std::unique_ptr<Controller> law_;
  double angle_ = 0.3;
};

TEST(Notch, HoldsWhileTheSpeedChangesFast) {
  TurningProbe probe(0.1);
  double u = 1.0;
  for (int k = 0; k < 150; ++k) {
    u = probe.next(10.0);
  }
  // e^-1.5 remains; 10 * 0.1 * 1 / s is the fastest change at which it adapts.
  EXPECT_NEAR(u, std::exp(-1.5), 0.01);
  double speed = 10.0;
  const double before = u;
  for (int k = 0; k < 150; ++k) {
    speed += 0.05;
    u = probe.next(speed);
  }
  EXPECT_NEAR(u, before, 0.01) << "what it has learnt stays taken off";
  for (int k = 0; k < 150; ++k) {
    speed += 0.005;
    u = probe.next(speed);
  }
  EXPECT_NEAR(u, std::exp(-3.0), 0.01);
}

TEST(Notch, StandsAsideWhileThereIsNoKeyphasor) {
  for (const double lost : {std::numeric_limits<double>::quiet_NaN(), 0.0}) {
    TurningProbe probe(0.1);
    double before = 1.0;
    for (int k = 0; k < 150; ++k) {
      before = probe.next(10.0);
    }
    for (int k = 0; k < 50; ++k) {
      EXPECT_NEAR(probe.next(10.0, lost), 1.0, 1e-12);
    }
    EXPECT_NEAR(probe.next(10.0), before, 0.01) << "what it has learnt it keeps";
  }
}

TEST(Notch, GoesByATableOfPhases) {
  Settings settings;
  settings.tables["notch_phases"] = {{{{"speed", 1.0}, {"phase", 0.2}}, {}},
                                     {{{"speed", 3.0}, {"phase", 1.0}}, {}}};
  const auto tabled = made("pid", levitation(0.01, 0.0), settings, planOf(100.0, 2));
  const auto at = [&](double speed) { return tabled->linear(speed)->b; };
  for (const auto& [speed, phase] : {std::pair(0.1, 0.2), std::pair(1.5, 0.4), std::pair(3.0, 1.0),
                                     std::pair(9.0, 1.0), std::pair(-1.5, 0.4)}) {
    const auto expected =
        made("pid", levitation(0.01, phase), {}, planOf(100.0, 2))->linear(speed)->b;
    EXPECT_LT((at(speed) - expected).norm(), 1e-15) << speed;
  }
}

TEST(Notch, RefusesWhatCannotBe) {
  EXPECT_EQ(inputError("pid", levitation(0.01, 0.0), {}, planOf(100.0, 3)).first, "notch_axes");
  EXPECT_EQ(inputError("pid", levitation(100.0, 0.0), {}, planOf(100.0, 2)).first, "notch_rate");
  Settings settings;
  settings.tables["notch_phases"] = {{{{"speed", 1.0}, {"phase", 0.2}}, {}},
                                     {{{"speed", 1.0}, {"phase", 1.0}}, {}}};
  EXPECT_EQ(inputError("pid", levitation(0.01, 0.0), settings, planOf(100.0, 2)).first,
            "notch_phases[1].speed");
  settings.tables["notch_phases"].pop_back();
  EXPECT_EQ(inputError("pid", levitation(0.01, 0.3), settings, planOf(100.0, 2)).first,
            "notch_phase");
}

}  // namespace notch_test
}  // namespace whirl_twin
