// The claims of the shipped scenes of controlled pendulums and engines: swung up and caught, held
// upright, carried without swing, held at speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "../scene/scenes.h"
#include "accuracy/step_choice.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace controlled_pendulums_test {

constexpr double kPi = 3.141592653589793;
constexpr std::size_t kTheta = 1;  // of the cart and its rod, after x

Scene shipped(const std::string& name) {
  return readSceneFile(std::string(WHIRL_TWIN_SOURCE) + "/config/scenes/" + name + ".yaml");
}

class Running {
 public:
  explicit Running(const Scene& scene) : twin_(withStepsChosen(scene)) {}

  void runTo(
      double time, const std::function<void()>& look = [] {}) {
    while (twin_.time() < time) {
      twin_.step();
      look();
    }
  }
  double q(std::size_t system, std::size_t i) const { return motion(system)[i]; }
  double v(std::size_t system, std::size_t i) const {
    return motion(system)[twin_.running(system).dof() + i];
  }
  double input(std::size_t system) const { return twin_.inputs(system).value(0, 0.0); }

 private:
  std::array<double, 4> motion(std::size_t system) const {
    std::array<double, 4> state{};
    twin_.running(system).motion(state.data());
    return state;
  }

  Twin twin_;
};

double fromUpright(double angle) {
  return std::remainder(angle - kPi, 2.0 * kPi);
}

TEST(ControlledPendulums, SwingThemselvesUpAndAreCaught) {
  Running run(shipped("swing_up"));
  std::array<double, 2> most{};
  int turns = 0;
  double rate = 0.0;
  run.runTo(30.0, [&] {
    for (std::size_t s = 0; s < most.size(); ++s) {
      most[s] = std::max(most[s], std::fabs(run.input(s)));
    }
    const double now = run.v(0, 0);
    turns += rate * now < 0.0 && std::fabs(fromUpright(run.q(0, 0))) > 1.0 ? 1 : 0;
    rate = now;
  });
  EXPECT_GE(turns, 3) << "swing by swing";
  EXPECT_LE(most[0], 0.6) << "a quarter of what holds the arm level";
  EXPECT_LE(most[1], 10.0);
  EXPECT_NEAR(fromUpright(run.q(0, 0)), 0.0, 1e-6);
  EXPECT_NEAR(fromUpright(run.q(1, kTheta)), 0.0, 1e-4);
  EXPECT_NEAR(run.q(1, 0), 0.0, 1e-3) << "the cart is back";
}

TEST(ControlledPendulums, StandUprightOnOneMotorEach) {
  Running run(shipped("upright"));
  const double fallen_at_once = std::fabs(fromUpright(run.q(0, 0)));
  EXPECT_GT(fallen_at_once, 0.02);
  run.runTo(10.0);
  for (const std::size_t system : {0u, 1u}) {
    EXPECT_NEAR(run.q(system, 0), kPi, 1e-4) << system;
    EXPECT_NEAR(run.q(system, 1), 0.0, 1e-4) << system;
  }
  Scene late = shipped("upright");
  late.controllers[0].delay = 12000000;  // ns: six samples
  Running shaking(late);
  shaking.runTo(9.0);
  double fastest = 0.0;
  shaking.runTo(10.0, [&] { fastest = std::max(fastest, std::fabs(shaking.v(0, 0))); });
  EXPECT_GT(fastest, 1.0) << "it does not come to rest";
}

// The residual swing once the trolley has stopped. The shaper removes it as far as the swing is
// linear: at 4.6 degrees its period is longer by 4e-4.
TEST(ControlledPendulums, CarryALoadWithoutSwing) {
  Running run(shipped("crane"));
  run.runTo(15.0);
  std::array<double, 3> swing{};
  run.runTo(22.0, [&] {
    for (std::size_t s = 0; s < swing.size(); ++s) {
      swing[s] = std::max(swing[s], std::fabs(run.q(s, kTheta)));
    }
  });
  EXPECT_NEAR(swing[0] * 180.0 / kPi, 8.2, 0.05);
  EXPECT_LT(swing[1], 1e-3 * swing[0]);
  EXPECT_LT(swing[2], 1e-2 * swing[0]);
  EXPECT_NEAR(run.q(1, 0), 4.0, 1e-3);
  EXPECT_NEAR(run.q(2, 0), 3.5, 1e-3);
}

TEST(ControlledPendulums, HoldAnEngineThatHunts) {
  Scene loaded = shipped("throttle");
  for (SystemSpec& engine : loaded.systems) {
    engine.parameters["load"] = 24.0;
  }
  for (const Scene& scene : {shipped("throttle"), loaded}) {
    Running run(scene);
    run.runTo(40.0);
    std::array<double, 2> least{100.0, 100.0}, most{};
    run.runTo(50.0, [&] {
      for (std::size_t s = 0; s < most.size(); ++s) {
        least[s] = std::min(least[s], run.v(s, 1));
        most[s] = std::max(most[s], run.v(s, 1));
      }
    });
    EXPECT_GT(most[0] - least[0], 1.0) << "hunts";
    EXPECT_NEAR(least[1], 8.0, 2e-3);
    EXPECT_NEAR(most[1], 8.0, 2e-3);
  }
}

}  // namespace controlled_pendulums_test
}  // namespace whirl_twin
