// Dry friction with sticking: closed forms of oscillators with Coulomb friction, piece by piece; a
// plank carried along by a roller; Den Hartog's forced motion; arms that stick; and that friction
// never adds energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "allocation_guard.h"
#include "running_system.h"

namespace whirl_twin {
namespace dry_friction_test {

using Real = long double;
using Given = RunningSystem::Setup;

constexpr std::int64_t kMillisecond = 1000000;
const char* const kMethods[] = {"gauss_legendre_6", "dormand_prince_8", "stoermer"};

Given oscillator(double friction, const InputSignal& force, double x, double damping = 0.0) {
  Given s;
  s.model = "mass_spring_damper";
  s.parameters = {
      {"mass", 1.0}, {"stiffness", 100.0}, {"damping", damping}, {"friction_force", friction}};
  s.inputs = {{"force", force}};
  s.q = {x};
  return s;
}

/// x'' + w^2 x = P cos(W t) - F sign(x') with stops, of mass 1, in phases whose closed forms are
/// joined where the mass sticks or starts to slide; instants by bisection.
class ClosedForm {
 public:
  ClosedForm(Real w, Real friction, Real force, Real forced, Real x)
      : w_(w), friction_(friction), force_(force), forced_(forced), x_(x) {
    begin(0.0L);
  }

  Real at(Real time) {
    constexpr Real kLook = 1.0e-4L;
    while (seen_ < time) {
      const Real next = std::min(seen_ + kLook, time);
      if (!ends(next)) {
        seen_ = next;
        continue;
      }
      Real low = seen_;
      Real high = next;
      for (int i = 0; i < 80; ++i) {
        const Real middle = 0.5L * (low + high);
        (ends(middle) ? high : low) = middle;
      }
      x_ = position(high);
      begin(high);
    }
    return position(time);
  }

 private:
  Real push(Real t) const { return force_ * std::cos(forced_ * t) - w_ * w_ * x_; }
  void begin(Real t) {
    from_ = seen_ = t;
    const Real pushed = push(t);
    sign_ = std::fabs(pushed) <= friction_ ? 0 : pushed > 0.0L ? 1 : -1;
    // The periodic part and the mean, then the residual free motion.
    steady_ = force_ / (w_ * w_ - forced_ * forced_);
    mean_ = -sign_ * friction_ / (w_ * w_);
    cosine_ = x_ - mean_ - steady_ * std::cos(forced_ * t);
    sine_ = steady_ * forced_ * std::sin(forced_ * t) / w_;
  }
  Real position(Real t) const {
    if (sign_ == 0) {
      return x_;
    }
    const Real past = w_ * (t - from_);
    return mean_ + steady_ * std::cos(forced_ * t) + cosine_ * std::cos(past) +
           sine_ * std::sin(past);
  }
  Real rate(Real t) const {
    const Real past = w_ * (t - from_);
    return -steady_ * forced_ * std::sin(forced_ * t) +
           w_ * (sine_ * std::cos(past) - cosine_ * std::sin(past));
  }
  bool ends(Real t) const {
    if (sign_ == 0) {
      return std::fabs(push(t)) > friction_;
    }
    return t > from_ + 1.0e-9L && sign_ * rate(t) < 0.0L;
  }

  Real w_, friction_, force_, forced_, x_;
  Real from_ = 0.0L, seen_ = 0.0L, steady_ = 0.0L, mean_ = 0.0L, cosine_ = 0.0L, sine_ = 0.0L;
  int sign_ = 0;
};

TEST(DryFriction, AFreeSwingLosesTheSameInEachTurnAndStops) {
  for (const std::string method : kMethods) {
    SCOPED_TRACE(method);
    RunningSystem system(oscillator(0.5, {}, 0.1), method, kMillisecond);
    ClosedForm expected(10.0L, 0.5L, 0.0L, 0.0L, 0.1L);
    for (int i = 1; i <= 4000; ++i) {
      ASSERT_EQ(system.run(1), StepStatus::kOk);
      ASSERT_NEAR(system.q(0), static_cast<double>(expected.at(i * 1.0e-3L)), 1e-11) << i;
    }
    // 100 mm less 10 mm in each half turn; below F / k = 5 mm it is held.
    EXPECT_NEAR(system.q(0), 0.0, 1e-11);
    EXPECT_EQ(system.v(0), 0.0);
  }
}

TEST(DryFriction, ForcedMotionsWithStopsFollowTheirClosedForm) {
  std::mt19937_64 random(3);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int stuck = 0;
  for (int i = 0; i < 30; ++i) {
    const double friction = between(0.2, 2.0);
    const double force = friction * between(0.5, 3.0);
    const double forced = between(2.0, 25.0);
    const double x = between(-0.05, 0.05);
    const std::string method = kMethods[i % 3];
    SCOPED_TRACE(method + " friction " + std::to_string(friction) + " force " +
                 std::to_string(force) + " at " + std::to_string(forced) + " from " +
                 std::to_string(x));
    RunningSystem system(oscillator(friction, InputSignal::harmonic(force, forced, 0.0), x), method,
                         kMillisecond);
    ClosedForm expected(10.0L, friction, force, forced, x);
    for (int step = 1; step <= 3000; ++step) {
      ASSERT_EQ(system.run(1), StepStatus::kOk);
      stuck += system.v(0) == 0.0 ? 1 : 0;
      ASSERT_NEAR(system.q(0), static_cast<double>(expected.at(step * 1.0e-3L)), 2e-9) << step;
    }
  }
  EXPECT_GT(stuck, 5000);
}

TEST(DryFriction, ForcedWithoutStopsHasDenHartogsAmplitude) {
  // J. P. Den Hartog, Trans. ASME 53 (1931), APM-53-9: x / (P / k) = sqrt(V^2 - (F / P)^2 U^2),
  // V = 1 / (1 - r^2), U = sin(pi / r) / (r (1 + cos(pi / r))).
  for (const double r : {0.8, 1.3, 2.2}) {
    const double force = 2.0;
    const double friction = 0.6;
    RunningSystem system(oscillator(friction, InputSignal::harmonic(force, 10.0 * r, 0.0), 0.02),
                         "gauss_legendre_6", kMillisecond);
    ASSERT_EQ(system.run(200000), StepStatus::kOk);
    double largest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      ASSERT_EQ(system.run(1), StepStatus::kOk);
      largest = std::max(largest, std::fabs(system.q(0)));
    }
    const double v = 1.0 / (1.0 - r * r);
    const double u = std::sin(M_PI / r) / (r * (1.0 + std::cos(M_PI / r)));
    const double expected = force / 100.0 * std::sqrt(v * v - std::pow(friction / force * u, 2.0));
    EXPECT_NEAR(largest, expected, 2e-4 * expected) << r;  // as seen every millisecond
  }
}

TEST(DryFriction, AnArmThatItHoldsStaysForADay) {
  Given s;
  s.model = "pendulum";
  s.gravity = 9.80665;
  s.parameters = {{"mass", 0.49}, {"length", 0.1}, {"damping", 0.01}, {"coulomb", 0.3}};
  s.q = {0.3};
  for (const char* method : {"gauss_legendre_6", "runge_kutta_4", "semi_implicit_euler",
                             "velocity_verlet", "implicit_midpoint", "stoermer"}) {
    RunningSystem system(s, method, 1000 * kMillisecond);
    ASSERT_EQ(system.run(86400), StepStatus::kOk) << method;
    EXPECT_EQ(system.q(0), 0.3) << method;
    EXPECT_EQ(system.v(0), 0.0) << method;
  }
  // Its weight is m g l sin(theta) = 0.1420 N m; with less friction it falls.
  s.parameters["coulomb"] = 0.1419;
  RunningSystem falling(s, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(falling.run(1000), StepStatus::kOk);
  EXPECT_LT(falling.q(0), 0.2999);
  const std::vector<DryHold> holds = falling.dynamics().dryHolds(
      Eigen::VectorXd::Constant(1, 0.3), Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), {});
  ASSERT_EQ(holds.size(), 1u);
  EXPECT_FALSE(holds[0].held);
}

TEST(DryFriction, ARollerCarriesThePlankUntilItIsInTheMiddle) {
  // From x0 at rest it slides, x0 cos(p t), until its velocity equals that of the roller ahead; it
  // sticks to that until the other roller's friction exceeds that of the first, in the middle. From
  // there on it slides with the amplitude vs / p and reaches the speed of a roller in every pass.
  const double mu = 0.3;
  const double a = 0.0762;
  const double h = 0.0127;
  const double vs = 0.2;
  const double p = std::sqrt(mu * 9.81 / (a - mu * h));
  Given s;
  s.model = "friction_oscillator";
  s.parameters = {{"mass", 1.0},
                  {"friction_coefficient", mu},
                  {"half_spacing", a},
                  {"height", h},
                  {"roller_speed", vs}};
  s.q = {0.05};
  const double sticks = std::asin(vs / (0.05 * p)) / p;
  const double held_from = 0.05 * std::cos(p * sticks);
  const double loose = sticks + held_from / vs;
  for (const std::string method : kMethods) {
    RunningSystem system(s, method, kMillisecond);
    for (int i = 1; i <= 10000; ++i) {
      ASSERT_EQ(system.run(1), StepStatus::kOk);
      const double t = 1.0e-3 * i;
      const double x = t < sticks  ? 0.05 * std::cos(p * t)
                       : t < loose ? held_from - vs * (t - sticks)
                                   : -vs / p * std::sin(p * (t - loose));
      ASSERT_NEAR(system.q(0), x, 1e-9) << method << " at " << t;
    }
  }
}

TEST(DryFriction, APlankThatIsAsFastAsARollerInTheMiddleSlidesFromThere) {
  // There the share that would hold it is 1, and beyond it would have to be more.
  Given s;
  s.model = "friction_oscillator";
  s.parameters = {{"mass", 1.0},
                  {"friction_coefficient", 0.3},
                  {"half_spacing", 0.0762},
                  {"height", 0.0127},
                  {"roller_speed", 0.2}};
  const double p = std::sqrt(0.3 * 9.81 / (0.0762 - 0.3 * 0.0127));
  for (const double side : {1.0, -1.0}) {
    s.v = {side * 0.2};
    RunningSystem system(s, "gauss_legendre_6", kMillisecond);
    for (int i = 0; i < 3000; ++i) {
      ASSERT_EQ(system.run(1), StepStatus::kOk) << i;
      ASSERT_NEAR(system.q(0), side * 0.2 / p * std::sin(p * system.time()), 1e-9) << i;
    }
  }
}

TEST(DryFriction, APlankOnAFloorIsHeldByItsWeight) {
  Given s;
  s.model = "friction_oscillator";
  s.parameters = {{"mass", 2.0},
                  {"friction_coefficient", 0.3},
                  {"half_spacing", 0.5},
                  {"height", 0.0},
                  {"roller_speed", 0.0}};
  s.v = {1.0};
  RunningSystem system(s, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(system.run(1000), StepStatus::kOk);
  EXPECT_NEAR(system.q(0), 1.0 / (2.0 * 0.3 * 9.81), 1e-12);  // v^2 / (2 mu g)
  EXPECT_EQ(system.v(0), 0.0);
}

TEST(DryFriction, ACartStaysWhileItsRodSwingsAndGoesWhenThatPullsHarder) {
  // The rod about a fixed hinge pulls sideways with m2 (l / 2) (theta'' cos - theta'^2 sin).
  Given s;
  s.model = "cart_pendulum";
  s.parameters = {{"cart_mass", 1.0},
                  {"rod_mass", 0.5},
                  {"rod_length", 0.4},
                  {"stiffness", 0.0},
                  {"friction_force", 2.0}};
  s.q = {0.05, 0.4};
  double pull = 0.0;
  RunningSystem held(s, "gauss_legendre_6", kMillisecond);
  for (int i = 0; i < 5000; ++i) {
    ASSERT_EQ(held.run(1), StepStatus::kOk);
    const double theta = held.q(1);
    const double swing = -1.5 * 9.81 / 0.4 * std::sin(theta);
    pull = std::max(
        pull, std::fabs(0.1 * (swing * std::cos(theta) - held.v(1) * held.v(1) * std::sin(theta))));
  }
  EXPECT_EQ(held.q(0), 0.05);
  EXPECT_NEAR(held.energies().jacobi, 0.5 * 9.81 * 0.2 * (1.0 - std::cos(0.4)), 1e-12);
  s.parameters["friction_force"] = 0.9 * pull;
  RunningSystem loose(s, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(loose.run(5000), StepStatus::kOk);
  EXPECT_GT(std::fabs(loose.q(0) - 0.05), 1e-5);
  EXPECT_LT(std::fabs(loose.q(0) - 0.05), 1e-2);
}

Given doublePendulum(std::mt19937_64& random, const char* coordinates) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Given s;
  s.model = "double_pendulum";
  s.settings.choices["coordinates"] = coordinates;
  s.parameters = {{"mass1", between(0.5, 2.0)},    {"mass2", between(0.5, 2.0)},
                  {"length1", between(0.5, 1.5)},  {"length2", between(0.5, 1.5)},
                  {"coulomb1", between(0.1, 5.0)}, {"coulomb2", between(0.05, 2.0)},
                  {"damping1", between(0.0, 0.1)}};
  s.q = {between(-2.0, 2.0), between(-2.0, 2.0)};
  s.v = {between(-2.0, 2.0), between(-2.0, 2.0)};
  return s;
}

TEST(DryFriction, MethodsAgreeOnADoublePendulumThatSticksAndEnergyIsAccountedFor) {
  std::mt19937_64 random(7);
  int joints_held = 0;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const Given s = doublePendulum(random, i % 2 == 0 ? "absolute" : "relative");
    RunningSystem first(s, "gauss_legendre_6", kMillisecond);
    RunningSystem second(s, "dormand_prince_8", kMillisecond);
    const double start = first.energies().jacobi;
    double before = start;
    for (int step = 0; step < 3000; ++step) {
      ASSERT_EQ(first.run(1), StepStatus::kOk);
      ASSERT_EQ(second.run(1), StepStatus::kOk);
      const double energy = first.energies().jacobi;
      ASSERT_LE(energy, before + 1e-12) << "friction gave energy at " << step;
      before = energy;
      const double relative = i % 2 == 0 ? first.v(1) - first.v(0) : first.v(1);
      joints_held += first.v(0) == 0.0 ? 1 : 0;
      joints_held += std::fabs(relative) < 1e-14 ? 1 : 0;
    }
    EXPECT_NEAR(first.q(0), second.q(0), 1e-8);
    EXPECT_NEAR(first.q(1), second.q(1), 1e-8);
    EXPECT_NEAR(start + first.work(), before, 1e-9 * (1.0 + std::fabs(start)));
  }
  EXPECT_GT(joints_held, 20000);
}

TEST(DryFriction, BothFormsOfTheDoublePendulumAreOne) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 5; ++i) {
    Given s = doublePendulum(random, "absolute");
    RunningSystem absolute(s, "gauss_legendre_6", kMillisecond);
    s.settings.choices["coordinates"] = "relative";
    s.q[1] -= s.q[0];
    s.v[1] -= s.v[0];
    RunningSystem relative(s, "gauss_legendre_6", kMillisecond);
    ASSERT_EQ(absolute.run(3000), StepStatus::kOk);
    ASSERT_EQ(relative.run(3000), StepStatus::kOk);
    EXPECT_NEAR(absolute.q(0), relative.q(0), 1e-9);
    EXPECT_NEAR(absolute.q(1), relative.q(0) + relative.q(1), 1e-9);
  }
}

TEST(DryFriction, RoundedOffItComesToTheSameWithANarrowWidth) {
  std::mt19937_64 random(13);
  Given s = doublePendulum(random, "absolute");
  RunningSystem exact(s, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(exact.run(1000), StepStatus::kOk);
  double last = 0.0;
  for (const double width : {1e-2, 1e-3}) {
    s.parameters["coulomb_rate"] = width;
    s.substeps = 20;
    RunningSystem rounded(s, "gauss_legendre_6", kMillisecond);
    ASSERT_EQ(rounded.run(1000), StepStatus::kOk);
    const double apart = std::hypot(rounded.q(0) - exact.q(0), rounded.q(1) - exact.q(1));
    EXPECT_LT(apart, 2.0 * width);
    if (last > 0.0) {
      EXPECT_LT(apart, 0.3 * last);
    }
    last = apart;
  }
}

TEST(DryFriction, StepsWithEventsAllocateNothing) {
  std::mt19937_64 random(17);
  Given s = doublePendulum(random, "relative");
  s.inputs = {{"torque1", InputSignal::harmonic(2.0, 3.0, 0.0)}};
  for (const std::string method : kMethods) {
    RunningSystem system(s, method, kMillisecond);
    const AllocationGuard guard;
    const StepStatus status = system.run(3000);
    EXPECT_EQ(guard.allocations(), 0u) << method;
    EXPECT_EQ(status, StepStatus::kOk);
  }
}

}  // namespace dry_friction_test
}  // namespace whirl_twin
