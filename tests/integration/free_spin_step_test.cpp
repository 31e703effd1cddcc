// The angle of a shaft on a motor, where a step exceeds the range of numbers.
#include <gtest/gtest.h>

#include <array>

#include "integration/runge_kutta_4.h"
#include "integration/stepped_system.h"
#include "mechanics/rotors/free_spin.h"
#include "mechanics/rotors/jeffcott_rotor.h"

namespace whirl_twin {
namespace free_spin_step_test {

using Rotor = FreeSpin<JeffcottRotor>;

constexpr double kStep = 1.0e-3;  // s

Rotor rotor() {
  Rotor r;
  r.mass = 5.0;
  r.stiffness = r.stiffness_y = 2.0e5;
  r.damping = r.damping_y = 40.0;
  r.eccentricity = 2.0e-4;
  r.polar_inertia = 0.02;
  r.motor = Motor::falling(0.3, 400.0);
  return r;
}

class FreeSpinStep : public testing::Test {
 protected:
  using Array = std::array<double, 3>;
  void set(const Array& q, const Array& v) { system_.set(q.data(), v.data()); }
  std::array<double, 7> state() const {
    std::array<double, 7> all{};
    system_.write(all.data());
    return all;
  }
  const Drive drive_{0.0, 0.0};
  SteppedSystem<Rotor, RungeKutta4> system_{rotor(), drive_, InputForce(), kStep, 1};
};

// 1e11 rad in a step: a double of that size keeps 1e-5 rad of its phase.
TEST_F(FreeSpinStep, ThatTurnsTooFarIsRefusedAndLeavesTheState) {
  set({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0e14});
  const auto before = state();
  EXPECT_EQ(system_.step(0.0), StepStatus::kOutOfRange);
  EXPECT_EQ(state(), before);
}

TEST_F(FreeSpinStep, FromAnAngleWithoutAPhaseIsRefused) {
  set({0.0, 0.0, 1.0e300}, {0.0, 0.0, 0.0});
  EXPECT_EQ(system_.step(0.0), StepStatus::kOutOfRange);
}

TEST_F(FreeSpinStep, FromMillionsOfTurnsGoesOn) {
  set({0.0, 0.0, 1.0e9}, {0.0, 0.0, 400.0});
  EXPECT_EQ(system_.step(0.0), StepStatus::kOk);
  EXPECT_NEAR(state()[2] - 1.0e9, 400.0 * kStep, 1.0e-3);
}

}  // namespace free_spin_step_test
}  // namespace whirl_twin
