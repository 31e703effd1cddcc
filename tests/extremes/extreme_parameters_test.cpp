// Rotors with damping, stiffness and speed decades beyond the ordinary, against their closed forms
// in extended precision, by every suitable method.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../integration/running_system.h"
#include "../integration/whirl_closed_form.h"
#include "measured.h"

namespace whirl_twin {
namespace extreme_parameters_test {

using Complex = ClosedFormWhirl::Complex;

constexpr double kEccentricity = 1e-3;

RunningSystem::Setup rotorOf(double p, double zeta, double speed, double stiffness_ratio = 1.0) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0},
                  {"stiffness", p * p},
                  {"stiffness_y", stiffness_ratio * p * p},
                  {"damping", 2.0 * zeta * p},
                  {"eccentricity", kEccentricity}};
  s.speed = speed;
  s.q = {2e-3, -1e-3};
  s.v = {0.0, 1e-3 * p};
  return s;
}

/// The complete motion of one axis: 0 along x, 1 along y.
ClosedFormWhirl axis(const RunningSystem::Setup& s, std::size_t i) {
  const long double w = s.speed;
  const long double force = static_cast<long double>(kEccentricity) * w * w;
  const Complex aside(0.0L, -1.0L);
  return ClosedFormWhirl(s.parameters.at("damping"),
                         s.parameters.at(i == 0 ? "stiffness" : "stiffness_y"),
                         i == 0 ? Complex(force) : aside * force, w, s.q[i], s.v[i]);
}

/// Largest error of a coordinate over `looks` samples, relative to the largest value so far.
double largestError(const RunningSystem::Setup& s, const std::string& method, std::int64_t step,
                    std::int64_t steps, int looks) {
  RunningSystem rotor(s, method, step);
  const ClosedFormWhirl x = axis(s, 0);
  const ClosedFormWhirl y = axis(s, 1);
  double error = 0.0;
  double size_x = std::fabs(s.q[0]);
  double size_y = std::fabs(s.q[1]);
  for (int i = 1; i <= looks; ++i) {
    EXPECT_EQ(rotor.run(steps / looks), StepStatus::kOk) << method;
    const auto t = static_cast<long double>(steps / looks * i * step) / 1e9L;
    const auto exact_x = static_cast<double>(x(t).real());
    const auto exact_y = static_cast<double>(y(t).real());
    size_x = std::fmax(size_x, std::fabs(exact_x));
    size_y = std::fmax(size_y, std::fabs(exact_y));
    error = std::fmax(error, std::fabs(rotor.q(0) - exact_x) / size_x);
    error = std::fmax(error, std::fabs(rotor.q(1) - exact_y) / size_y);
  }
  return error;
}

class EveryMethodOfExtremes : public testing::TestWithParam<std::string> {};

// From no damping through critical, where two roots meet, to creeping: at zeta = 100 the roots lie
// four decades apart, p / 200 and 200 p.
TEST_P(EveryMethodOfExtremes, FollowsDampingFromNoneToAHundredTimesCritical) {
  constexpr double kP = 10.0;
  const bool exact = GetParam() == "exponential";
  // The exact step takes any step: 10 ms, p t = 100, rounding. The others take the fastest root by
  // 0.02: truncation below (0.02)^order, over p t = 10 or, of a fast root, until that has died.
  const double bound = (exact ? 0.0 : std::pow(0.02, orderOf(GetParam()))) + 1e-12;
  double largest = 0.0;
  for (const double zeta :
       {0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 1.0 - 1e-8, 1.0, 1.0 + 1e-8, 2.0, 10.0, 100.0}) {
    const double fastest = zeta > 1.0 ? 2.0 * zeta * kP : kP;
    const auto step = exact ? 10 * kMillisecond : static_cast<std::int64_t>(0.02 / fastest * 1e9);
    const double error = largestError(rotorOf(kP, zeta, 8.0), GetParam(), step,
                                      (exact ? 10 : 1) * kSecond / step, 4);
    EXPECT_LE(error, bound) << "zeta " << zeta;
    largest = std::fmax(largest, error);
  }
  expectWithin(bound, largest, "zeta 0 to 100 by " + GetParam() + ", relative error");
}

// Speeds over fourteen decades. In the exact step the shaft turns by up to 100 rad in a
// millisecond; in the others the faster of whirl and shaft by 0.01 rad, in semi-implicit Euler by a
// tenth of it.
TEST_P(EveryMethodOfExtremes, FollowsShaftSpeedsFromZeroToAHundredThousand) {
  constexpr double kP = 10.0;
  const int order = orderOf(GetParam());
  const double z = order == 1 ? 1e-3 : 1e-2;
  double largest = 0.0;
  for (const double speed : {0.0, 1e-9, 1e-3, 1.0, 10.5, 1e3, 1e5}) {
    const auto step = GetParam() == "exponential"
                          ? kMillisecond
                          : static_cast<std::int64_t>(z / std::fmax(speed, kP) * 1e9);
    largest =
        std::fmax(largest, largestError(rotorOf(kP, 0.01, speed), GetParam(), step, 20000, 4));
  }
  // Truncation of z^order over up to 200 rad. Rounding: below.
  expectWithin(100.0 * std::pow(z, order) + 1e-10, largest,
               "shaft speeds 0 to 1e5 rad/s by " + GetParam() + ", relative error");
}

INSTANTIATE_TEST_SUITE_P(OfExtremes, EveryMethodOfExtremes,
                         testing::ValuesIn(integratorsOf("jeffcott_rotor")),
                         [](const auto& test) { return test.param; });

// Far above its critical speed the rotor turns about its mass centre, r = -e. The mass centre's
// circle has the radius e (p/w)^2 |1 + 2 i zeta w/p|, here e times 1e-4. Two forces of e w^2, each
// rounded to 1e-16 of it, would bend the shaft by 1e-16 (w/p)^2 e, here 1e-8 e, if their rounding
// error were constant; it rotates, and its effect is (w/p) times smaller.
TEST(FarAboveTheCriticalSpeed, TheRotorTurnsAboutItsMassCentre) {
  constexpr double kP = 10.0;
  constexpr double kSpeed = 1e5;
  RunningSystem rotor(rotorOf(kP, 0.5, kSpeed), "exponential", kMillisecond);
  ASSERT_EQ(rotor.run(10000), StepStatus::kOk);  // zeta p t = 50
  const double angle = rotor.drive().at(0.0).angle;
  const double x = rotor.q(0) + kEccentricity * std::cos(angle);
  const double y = rotor.q(1) + kEccentricity * std::sin(angle);
  const double rounding = 1.2e-14 * (kSpeed / kP);
  expectWithin(rounding, std::fabs(std::hypot(x, y) / kEccentricity - kP / kSpeed),
               "mass centre at 1e4 times the critical speed, error / e");
}

// kx = 1 N/m, ky = 1e12 N/m: a slow swing of 6 s one way, a whirr of 6 us the other. The exact
// step takes both at once: 1000 rad of the fast one in a millisecond.
TEST(StiffnessRatioOfABillionThousands, OfTwoAxesIsStepped) {
  const RunningSystem::Setup s = rotorOf(1.0, 0.0, 0.7, 1e12);
  // The fast axis rotates with a relative rounding of 1e-16 for p t = 1e7 rad, or has p h = 1000
  // rounded by half a unit, once.
  expectWithin(1e-7, largestError(s, "exponential", kMillisecond, 10000, 10),
               "stiffness ratio 1e12, both axes, exact step of 1 ms");
  for (const std::string& method : integratorsOf("jeffcott_rotor")) {
    // All of them, at 0.02 rad of the fast axis a step; 4 ms take it by 4000 rad. The slow axis
    // hardly moves; an error in its restoring force would still show.
    if (method == "exponential") {
      continue;
    }
    expectWithin(4000.0 * detuning(method, 0.02) + 1e-10, largestError(s, method, 20, 200000, 4),
                 "stiffness ratio 1e12, both axes, 20 ns steps of " + method);
  }
}

/// Two unit masses: one on a spring of 1 N/m to the ground, joined to the other by k [N/m].
/// Eigenvalues p^2 = ((1 + 2 k) -+ sqrt(1 + 4 k^2)) / 2, of product k.
struct JoinedMasses {
  explicit JoinedMasses(double k) {
    setup.model = "linear_system";
    setup.settings.matrices["mass"] = Eigen::Matrix2d::Identity();
    setup.settings.matrices["stiffness"] =
        (Eigen::Matrix2d() << 1.0 + k, -k, -k, k).finished();  // 1 + 1e12 is exact
    const long double stiff = k;
    const long double fast = 0.5L * (1.0L + 2.0L * stiff + std::sqrt(1.0L + 4.0L * stiff * stiff));
    slow_frequency = std::sqrt(stiff / fast);
    // Its mode: q2 / q1 = k / (k - p^2).
    const long double p2 = stiff / fast;
    setup.q = {1e-3, static_cast<double>(1e-3L * stiff / (stiff - p2))};
  }
  RunningSystem::Setup setup;
  long double slow_frequency;
};

// A joint 1e12 times as stiff as what holds the pair: together they swing at sqrt(1/2) rad/s. Once
// the two springs are summed in a matrix, an entry of 1 + k holds the soft one only to eps k, and
// so does what any step computes from it: the slow frequency is right to eps k, no better.
TEST(StiffnessRatioOfABillionThousands, OfTwoJoinedMassesLeavesTheSlowSwing) {
  for (const double k : {1e4, 1e8, 1e12}) {
    const JoinedMasses masses(k);
    for (const char* method : {"exponential", "gauss_legendre_6"}) {
      RunningSystem pair(masses.setup, method, 10 * kMillisecond);
      double error = 0.0;
      for (int i = 1; i <= 10; ++i) {
        ASSERT_EQ(pair.run(1000), StepStatus::kOk);
        const double exact =
            1e-3 * static_cast<double>(std::cos(masses.slow_frequency * 10.0L * i));
        error = std::fmax(error, std::fabs(pair.q(0) - exact) / 1e-3);
        error = std::fmax(error, std::fabs(pair.q(1) - exact) / 1e-3 - 2.0 / k);
      }
      // p t = 71, and a few roundings of the step's matrix.
      expectWithin(2.0 * 2.2e-16 * k * 71.0, error,
                   fmt::format("joined masses, stiffness ratio {:.0e}, by {}", k, method));
    }
  }
}

}  // namespace extreme_parameters_test
}  // namespace whirl_twin
