// Synchronous whirl: r/e = b^2 / sqrt((1 - b^2)^2 + (2 zeta b)^2), tan(phi) = 2 zeta b / (1 - b^2),
// b = w/p, from far below the critical speed to far above.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "running_system.h"

namespace whirl_twin {
namespace steady_whirl_test {

constexpr double kMass = 3.0;
constexpr double kP = 50.0;  // [rad/s]
constexpr double kEccentricity = 1e-4;
constexpr std::int64_t kStep = 1000000;  // [ns]

RunningSystem::Setup rotor(double zeta, double b) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", kMass},
                  {"stiffness", kMass * kP * kP},
                  {"damping", 2.0 * zeta * kP * kMass},
                  {"eccentricity", kEccentricity}};
  s.speed = b * kP;
  return s;
}

struct Whirl {
  double radius;
  double phase;
};

Whirl expected(double zeta, double b) {
  return {kEccentricity * b * b / std::hypot(1.0 - b * b, 2.0 * zeta * b),
          std::atan2(2.0 * zeta * b, 1.0 - b * b)};
}

void expectWhirl(const RunningSystem& rotor, const Whirl& expected, const std::string& where) {
  EXPECT_NEAR(std::hypot(rotor.q(0), rotor.q(1)), expected.radius, 1e-9 * expected.radius) << where;
  const double lag = rotor.drive().angle().remainder - std::atan2(rotor.q(1), rotor.q(0));
  EXPECT_NEAR(std::remainder(lag - expected.phase, 2.0 * M_PI), 0.0, 1e-9) << where;
}

class SteadyWhirl : public testing::TestWithParam<const char*> {};

TEST_P(SteadyWhirl, OnceOnTheOrbitStaysOnIt) {
  const bool exact = std::string(GetParam()) == "exponential";
  for (const double zeta : {1e-4, 1e-3, 0.01, 0.05, 0.3, 0.7, 1.0, 2.0}) {
    for (const double b : {0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.01, 1.1, 1.4142, 2.0, 10.0, 100.0}) {
      if (!exact && b > 2.0) {
        continue;  // Gauss-Legendre resolves a turn with ten steps to 1e-7, not to 1e-9
      }
      RunningSystem::Setup s = rotor(zeta, b);
      const Whirl whirl = expected(zeta, b);
      s.q = {whirl.radius * std::cos(whirl.phase), -whirl.radius * std::sin(whirl.phase)};
      s.v = {-s.speed * s.q[1], s.speed * s.q[0]};
      RunningSystem system(s, GetParam(), kStep);
      const std::string where = "zeta " + std::to_string(zeta) + ", w/p " + std::to_string(b);
      for (int i = 0; i < 20; ++i) {
        system.run(exact ? 97 : 17);
        expectWhirl(system, whirl, where);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, SteadyWhirl, testing::Values("exponential", "gauss_legendre_6"),
                         [](const auto& test) { return test.param; });

TEST(SteadyWhirlFromRest, IsReachedOnceTheFreeWhirlHasDied) {
  for (const double zeta : {0.02, 0.1, 0.5, 1.0, 2.0}) {
    for (const double b : {0.01, 0.5, 1.0, 1.5, 10.0, 100.0}) {
      RunningSystem system(rotor(zeta, b), "exponential", kStep);
      // The slower root decays by e^-40, also where damping is above critical.
      const double decay = zeta < 1.0 ? zeta : zeta - std::sqrt(zeta * zeta - 1.0);
      system.run(std::llround(40.0 / (decay * kP) * 1e3));
      expectWhirl(system, expected(zeta, b),
                  "zeta " + std::to_string(zeta) + ", w/p " + std::to_string(b));
    }
  }
}

TEST(SteadyWhirlPhase, CountsFromTheUnbalanceNotFromTheMark) {
  RunningSystem::Setup s = rotor(0.3, 0.7);
  s.parameters["eccentricity_angle"] = 0.8;
  RunningSystem system(s, "exponential", kStep);
  system.run(10000);
  Whirl whirl = expected(0.3, 0.7);
  whirl.phase -= 0.8;
  expectWhirl(system, whirl, "lag behind the mark");
}

}  // namespace steady_whirl_test
}  // namespace whirl_twin
