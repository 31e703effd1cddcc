// Balanced on a saddle: exactly there a system stays, with any method; next to it, it falls at the
// rate of the linearized motion.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "../integration/running_system.h"
#include "measured.h"

namespace whirl_twin {
namespace saddles_test {

/// A saddle at q = 0, and its rate [1/s]: a nudge grows as cosh(rate t).
struct Saddle {
  const char* name;
  RunningSystem::Setup setup;
  double rate;
};

Saddle invertedPendulum() {
  RunningSystem::Setup s;
  s.model = "sprung_inverted_pendulum";
  s.parameters = {{"mass", 1.0}, {"length", 1.0}, {"stiffness", 0.0}};
  s.gravity = 9.0;
  return {"InvertedPendulum", s, 3.0};
}

/// Above w = sqrt(g/l) the hanging position repels: rate^2 = w^2 - g/l.
Saddle spinningPendulum() {
  RunningSystem::Setup s;
  s.model = "spinning_pendulum";
  s.parameters = {{"mass", 0.5}, {"length", 1.0}};
  s.gravity = 9.0;
  s.speed = 5.0;
  return {"SpinningPendulum", s, 4.0};
}

struct Case {
  Saddle saddle;
  std::string method;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.saddle.name << " by " << c.method;
}

std::vector<Case> everyCase() {
  std::vector<Case> all;
  for (const Saddle& saddle : {invertedPendulum(), spinningPendulum()}) {
    for (const std::string& method : integratorsOf(saddle.setup.model)) {
      all.push_back({saddle, method});
    }
  }
  return all;
}

class OnASaddle : public testing::TestWithParam<Case> {};

// rate t = 100 and more: a deviation of 5e-324 would have become 1e-280, one of 1e-16 a fall.
TEST_P(OnASaddle, AnExactStartStaysForGood) {
  RunningSystem system(GetParam().saddle.setup, GetParam().method, kMillisecond);
  ASSERT_EQ(system.run(100000), StepStatus::kOk);
  EXPECT_EQ(system.q(0), 0.0);
  EXPECT_EQ(system.v(0), 0.0);
}

TEST_P(OnASaddle, ANudgeGrowsAtItsRate) {
  constexpr double kNudge = 1e-12;
  const double rate = GetParam().saddle.rate;
  RunningSystem::Setup s = GetParam().saddle.setup;
  s.q = {kNudge};
  RunningSystem system(s, GetParam().method, kMillisecond);
  double error = 0.0;
  for (int i = 1; i <= 10; ++i) {
    ASSERT_EQ(system.run(static_cast<std::int64_t>(1600.0 / rate)), StepStatus::kOk);
    const double exact = kNudge * std::cosh(rate * system.time());  // 4e-6 in the end
    error = std::fmax(error, std::fabs(system.q(0) / exact - 1.0));
  }
  // The relative frequency error of a method is that of its rate, over rate t = 16 (and a little);
  // semi-implicit Euler divides the initial deviation between growth and decay with an error of
  // rate h / 2. The equation's own cubic term: (4e-6)^2.
  const double z = rate * 1e-3;
  const double bound =
      17.0 * detuning(GetParam().method, z) + (orderOf(GetParam().method) == 1 ? z : 0.0) + 2e-11;
  expectWithin(bound, error,
               fmt::format("growth of a nudge, {} by {}, relative error", GetParam().saddle.name,
                           GetParam().method));
}

INSTANTIATE_TEST_SUITE_P(Balanced, OnASaddle, testing::ValuesIn(everyCase()), [](const auto& test) {
  return test.param.saddle.name + ("_" + test.param.method);
});

// Above the threshold of its rotating damping a balanced rotor's centre is unstable: w > p (1 +
// c/c_i). It stays there all the same.
TEST(ABalancedRotorAboveItsThreshold, StaysInTheCentreItIsRepelledFrom) {
  for (const std::string& method : integratorsOf("jeffcott_rotor")) {
    RunningSystem::Setup s;
    s.model = "jeffcott_rotor";
    s.parameters = {
        {"mass", 1.0}, {"stiffness", 400.0}, {"damping", 1.0}, {"internal_damping", 1.0}};
    s.speed = 80.0;
    RunningSystem rotor(s, method, kMillisecond);
    ASSERT_EQ(rotor.run(100000), StepStatus::kOk);
    EXPECT_EQ(std::hypot(rotor.q(0), rotor.q(1)), 0.0) << method;
    s.q = {1e-300, 0.0};
    RunningSystem nudged(s, method, kMillisecond);
    ASSERT_EQ(nudged.run(10000), StepStatus::kOk);
    // At w = 80 the rate is near (c_i (w/p - 1) - c) / 2 m = 1 /s.
    EXPECT_GT(std::hypot(nudged.q(0), nudged.q(1)), 1e-300 * std::exp(5.0)) << method;
  }
}

}  // namespace saddles_test
}  // namespace whirl_twin
