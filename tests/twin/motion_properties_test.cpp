// Properties of motions over random parameters: momenta of cyclic coordinates are conserved, two
// sets of coordinates give one motion, a heavy hub keeps its speed, and the stability verdict on an
// equilibrium agrees with the motion in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../integration/running_system.h"
#include "analysis/equilibria.h"

namespace whirl_twin {
namespace motion_properties_test {

constexpr int kDraws = 200;
constexpr std::int64_t kMillisecond = 1000000;

class Motions : public testing::Test {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double decades(double low, double high) { return std::pow(10.0, between(low, high)); }
  std::mt19937 random_{31415926};
};

Eigen::VectorXd vector(const std::vector<double>& x, std::size_t from, std::size_t count) {
  return Eigen::Map<const Eigen::VectorXd>(x.data() + from, static_cast<Eigen::Index>(count));
}

/// Momentum of a coordinate, now.
double momentum(const RunningSystem& system, Eigen::Index coordinate) {
  const std::vector<double> state = system.state();
  const std::size_t n = state.size() / 2;
  return system.dynamics().momenta(vector(state, 0, n), vector(state, n, n), {})[coordinate];
}

/// Largest relative change of a momentum over ten seconds.
double drift(const RunningSystem::Setup& setup, Eigen::Index coordinate) {
  RunningSystem system(setup, "gauss_legendre_6", kMillisecond);
  const double start = momentum(system, coordinate);
  double largest = 0.0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(system.run(100), StepStatus::kOk);
    largest = std::max(largest, std::fabs(momentum(system, coordinate) - start));
  }
  return largest / std::fabs(start);
}

TEST_F(Motions, ThePendulumsMomentumAboutTheVerticalIsConserved) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RunningSystem::Setup s;
    s.model = "rotating_pendulum";
    const double m = decades(-1.0, 1.0);
    const double l = between(0.3, 2.0);
    s.parameters = {{"mass", m},
                    {"length", l},
                    {"hub_inertia", m * l * l * decades(-1.0, 1.0)},
                    {"damping", m * l * l * between(0.0, 0.5)}};
    s.q = {between(0.2, 2.5), between(-3.0, 3.0)};
    s.v = {between(-2.0, 2.0), between(1.0, 6.0)};
    ASSERT_LT(drift(s, 1), 1e-11) << draw;
  }
}

TEST_F(Motions, TheFlywheelsMomentumIsConserved) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RunningSystem::Setup s;
    s.model = "sliding_mass_flywheel";
    const bool symmetric = draw % 2 == 0;
    s.settings.choices["symmetric"] = symmetric ? "true" : "false";
    const double m = between(0.1, 1.0);
    const double k = between(50.0, 300.0);
    s.parameters = {{"inertia", between(0.02, 0.5)},
                    {"slider_mass", m},
                    {"stiffness", k},
                    {"free_length", between(0.1, 0.4)}};
    const double w = std::sqrt(k / m) * between(0.1, 0.7);
    s.q = symmetric ? std::vector<double>{0.3, 0.0} : std::vector<double>{0.3, 0.25, 0.0};
    s.v = symmetric ? std::vector<double>{0.2, w} : std::vector<double>{0.2, -0.1, w};
    ASSERT_LT(drift(s, symmetric ? 1 : 2), 1e-11) << draw;
  }
}

TEST_F(Motions, AFreeCartsMomentumIsConserved) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RunningSystem::Setup s;
    s.model = "cart_pendulum";
    s.parameters = {{"cart_mass", decades(-1.0, 1.0)},
                    {"rod_mass", decades(-1.0, 1.0)},
                    {"rod_length", between(0.3, 2.0)},
                    {"stiffness", 0.0}};
    s.q = {0.0, between(-3.0, 3.0)};
    s.v = {between(0.5, 2.0), between(-2.0, 2.0)};
    ASSERT_LT(drift(s, 0), 1e-11) << draw;
  }
}

// theta3 = theta2 - theta1. Small enough that the motion does not amplify errors: at large angles
// two roundings part by 4e5 in ten seconds.
TEST_F(Motions, AbsoluteAndRelativeAnglesTellOneDoublePendulum) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RunningSystem::Setup s;
    s.model = "double_pendulum";
    const double l1 = between(0.5, 2.0);
    const double l2 = between(0.5, 2.0);
    s.parameters = {{"mass1", between(0.5, 2.0)},
                    {"mass2", between(0.5, 2.0)},
                    {"length1", l1},
                    {"length2", l2},
                    {"center1", l1 * between(0.4, 1.0)},
                    {"center2", l2 * between(0.4, 1.0)},
                    {"inertia1", between(0.0, 0.1)},
                    {"inertia2", between(0.0, 0.1)},
                    {"damping1", between(0.0, 0.2)},
                    {"damping2", between(0.0, 0.2)}};
    s.q = {between(-0.5, 0.5), between(-0.5, 0.5)};
    s.v = {between(-0.5, 0.5), between(-0.5, 0.5)};
    RunningSystem::Setup relative = s;
    relative.settings.choices["coordinates"] = "relative";
    relative.q[1] -= relative.q[0];
    relative.v[1] -= relative.v[0];
    RunningSystem a(s, "gauss_legendre_6", kMillisecond);
    RunningSystem b(relative, "gauss_legendre_6", kMillisecond);
    EXPECT_NEAR(a.energies().jacobi, b.energies().jacobi, 1e-13 * (1.0 + a.energies().jacobi));
    ASSERT_EQ(a.run(3000), StepStatus::kOk);
    ASSERT_EQ(b.run(3000), StepStatus::kOk);
    ASSERT_NEAR(a.q(0), b.q(0), 1e-10) << draw;
    ASSERT_NEAR(a.q(1), b.q(0) + b.q(1), 1e-10) << draw;
    ASSERT_NEAR(a.v(1), b.v(0) + b.v(1), 1e-9) << draw;
  }
}

// The speed of a free pendulum varies by the relative amount m l^2 / J, and its motion by as much.
TEST_F(Motions, AHugeHubHoldsItsSpeedLikeADrivenShaft) {
  for (int draw = 0; draw < 50; ++draw) {
    RunningSystem::Setup held;
    held.model = "spinning_pendulum";
    const double m = between(0.2, 2.0);
    const double l = between(0.2, 1.0);
    held.parameters = {{"mass", m}, {"length", l}};
    held.speed = between(1.0, 6.0);
    held.q = {between(0.2, 1.0)};
    held.v = {between(-0.5, 0.5)};
    RunningSystem shaft(held, "gauss_legendre_6", kMillisecond);
    ASSERT_EQ(shaft.run(3000), StepStatus::kOk);
    double previous = 1.0;
    for (const double heavy : {1e3, 1e5, 1e7}) {
      RunningSystem::Setup free;
      free.model = "rotating_pendulum";
      free.parameters = {{"mass", m}, {"length", l}, {"hub_inertia", heavy * m * l * l}};
      free.q = {held.q[0], 0.0};
      free.v = {held.v[0], held.speed};
      RunningSystem hub(free, "gauss_legendre_6", kMillisecond);
      ASSERT_EQ(hub.run(3000), StepStatus::kOk);
      const double apart = std::fabs(hub.q(0) - shaft.q(0));
      EXPECT_LT(apart, 200.0 / heavy) << draw << ": " << heavy;
      EXPECT_LT(apart, 0.05 * previous + 1e-9) << "a hundred times the inertia, a hundredth as far";
      previous = apart;
    }
  }
}

/// Growth of a small deviation from rest, as a rate [1/s], seen from `settle` seconds on.
double growth(RunningSystem::Setup setup, const Eigen::VectorXd& rest, double duration) {
  for (std::size_t i = 0; i < setup.q.size(); ++i) {
    setup.q[i] = rest[static_cast<Eigen::Index>(i)] + 1e-9 * (1.0 + static_cast<double>(i));
  }
  RunningSystem system(setup, "gauss_legendre_6", kMillisecond);
  const auto size = [&] {
    double squares = 0.0;
    for (std::size_t i = 0; i < setup.q.size(); ++i) {
      const double q = system.q(i) - rest[static_cast<Eigen::Index>(i)];
      squares += q * q + system.v(i) * system.v(i);
    }
    return std::sqrt(squares);
  };
  const auto half = std::llround(duration * 500.0);
  EXPECT_EQ(system.run(half), StepStatus::kOk);
  const double middle = size();
  EXPECT_EQ(system.run(half), StepStatus::kOk);
  return std::log(size() / middle) / (0.5 * duration);
}

// Routh's test, the eigenvalues and the growth seen in time agree, unless the verdict is uncertain.
TEST_F(Motions, TheVerdictOnARestIsWhatIsSeenInTime) {
  int unstable = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RunningSystem::Setup s;
    if (draw % 2 == 0) {
      s.model = "double_pendulum";
      s.parameters = {{"mass1", between(0.5, 2.0)},    {"mass2", between(0.5, 2.0)},
                      {"length1", between(0.5, 2.0)},  {"length2", between(0.5, 2.0)},
                      {"damping1", between(0.1, 0.5)}, {"damping2", between(0.1, 0.5)}};
      s.q = s.v = {0.0, 0.0};
    } else {
      s.model = "sprung_inverted_pendulum";
      s.parameters = {{"mass", between(0.5, 2.0)},
                      {"length", between(0.5, 2.0)},
                      {"stiffness", between(5.0, 40.0)},
                      {"damping", between(0.1, 1.0)}};
      s.q = s.v = {0.0};
    }
    const ModelInfo& model = *findModel(s.model);
    const auto dynamics = model.setUp(completed(model, s.parameters), {}, s.gravity).dynamics;
    for (const Equilibrium& e : equilibria(*dynamics, 0.0)) {
      const Verdict verdict = e.stability.routh.verdict;
      if (verdict == Verdict::kUncertain) {
        continue;
      }
      const double fastest = -e.stability.decay_rate;  // largest real part [1/s]
      if (std::fabs(fastest) < 0.02) {
        continue;  // too slow to be seen in the time given
      }
      // Long enough to decide, short enough that a deviation of 1e-9 stays small.
      const double rate = growth(s, e.q, 12.0 / std::fabs(fastest));
      ASSERT_EQ(verdict == Verdict::kUnstable, rate > 0.0) << s.model << " " << draw << " " << rate;
      ASSERT_EQ(verdict == Verdict::kUnstable, fastest > 0.0);
      unstable += verdict == Verdict::kUnstable ? 1 : 0;
    }
  }
  EXPECT_GT(unstable, 100) << "both kinds are met";
}

}  // namespace motion_properties_test
}  // namespace whirl_twin
