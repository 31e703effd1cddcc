// A shaft that has turned by a billion radians: the rotor moves as at the same angle of the first
// turn. (The angle in one double would have a resolution of 1.2e-7 rad.)
#include <gtest/gtest.h>

#include <cmath>

#include "../scene/scenes.h"
#include "measured.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace turned_shaft_test {

constexpr double kBillion = 1e9;  // [rad]
/// 1e9 rad less 159154943 turns of 2 pi, to the last digit of a double.
constexpr double kRemainder = 0.5773954235013852;

std::string rotorScene(const std::string& integrator, const std::string& drive,
                       const std::string& step) {
  return "{step: " + step + ", drives: {shaft: {" + drive +
         "}}, systems: {rotor: {model: jeffcott_rotor, drive: shaft, integrator: " + integrator +
         ", parameters: {mass: 2, stiffness: 800, damping: 1.6, eccentricity: 1.0e-3, "
         "eccentricity_angle: 0.3, bow: 1.0e-4}, initial: {x: 1.0e-3}}}}";
}

struct Watched {
  explicit Watched(const std::string& yaml)
      : twin(sceneOf(yaml)), observer(twin), record(twin.layout().size) {}
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      twin.step();
      twin.write(record.data());
      observer.observe(record.data());
    }
  }
  Twin twin;
  Observer observer;
  std::vector<double> record;
};

class AfterABillionRadians : public testing::TestWithParam<std::string> {};

TEST_P(AfterABillionRadians, WhirlAndPhaseAreThoseOfTheFirstTurn) {
  Watched far(rotorScene(GetParam(), "speed: 15, angle: 1.0e9", "0.001"));
  Watched near(rotorScene(GetParam(), "speed: 15, angle: 0.5773954235013852", "0.001"));
  // The remainders are within a rounding of each other; what follows is to the roundings it makes.
  double whirl = 0.0;
  double phase = 0.0;
  for (int i = 0; i < 200; ++i) {
    far.run(50);
    near.run(50);
    const state::WhirlState a = far.observer.whirl(0);
    const state::WhirlState b = near.observer.whirl(0);
    ASSERT_TRUE(a.phase_valid && b.phase_valid);
    whirl = std::fmax(whirl, std::hypot(a.x - b.x, a.y - b.y) / b.radius);
    phase = std::fmax(phase, std::fabs(std::remainder(a.phase - b.phase, 2.0 * M_PI)));
    // The total has the resolution of a double.
    EXPECT_NEAR(a.shaft_angle - b.shaft_angle, kBillion - kRemainder, 2.4e-7);
  }
  expectWithin(1e-12, whirl, "whirl after 1e9 rad by " + GetParam() + ", relative difference");
  expectWithin(1e-12, phase, "phase after 1e9 rad by " + GetParam() + ", difference [rad]");
}

INSTANTIATE_TEST_SUITE_P(Methods, AfterABillionRadians,
                         testing::ValuesIn(integratorsOf("jeffcott_rotor")),
                         [](const auto& test) { return test.param; });

// The same angle, reached by turning: 1e4 s at 1e5 rad/s, in steps of 10 s and of a millisecond.
TEST(ShaftTurnedByABillionRadians, StandsAtTheRemainder) {
  for (const auto& [step, steps] : {std::pair("10", 1000), std::pair("0.001", 10000000)}) {
    Twin twin(sceneOf(rotorScene("exponential", "speed: 1.0e5", step)));
    for (int i = 0; i < steps; ++i) {
      twin.step();
    }
    EXPECT_EQ(twin.status(0), StepStatus::kOk);
    EXPECT_EQ(twin.drive(0).angle().turns, 159154943);
    expectWithin(1e-14, std::fabs(twin.drive(0).angle().remainder - kRemainder),
                 fmt::format("shaft angle turned to 1e9 rad in steps of {} s [rad]", step));
    EXPECT_EQ(twin.drive(0).angle().total(), kBillion);
  }
}

}  // namespace turned_shaft_test
}  // namespace whirl_twin
