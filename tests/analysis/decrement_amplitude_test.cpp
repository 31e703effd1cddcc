// The linear damping limit, up to which amplitude a logarithmic decrement is valid: closed forms of
// the first harmonic.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/validity.h"
#include "models_under_test.h"

namespace whirl_twin {
namespace decrement_amplitude_test {

SteadyMotion restOf(const Dynamics& dynamics) {
  return {Eigen::VectorXd::Zero(dynamics.dof()), Eigen::VectorXd::Zero(dynamics.dof())};
}

TEST(LinearDampingLimit, OfALinearRotorIsAny) {
  const auto rotor =
      dynamicsOf("jeffcott_rotor", {{"mass", 2.0}, {"stiffness", 7200.0}, {"damping", 12.0}}, 0.0);
  const auto found = linearDampingLimit(*rotor, restOf(*rotor), 100.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->coordinate, "whirl");
  EXPECT_TRUE(std::isinf(found->amplitude));
}

// m l^2 q'' + c q' + m g l sin q = 0: the first harmonic of sin(a cos) is 2 J1(a), so that the
// frequency falls as 1 + (2 J1(a) / a - 1) / 2, and the decrement, 2 pi times decay rate over
// frequency, has grown by a tenth where that is 1 / 1.1.
TEST(LinearDampingLimit, OfAPendulumIsWhereItsSwingIsSlower) {
  const auto pendulum = dynamicsOf("pendulum", {{"mass", 1.0}, {"length", 1.0}, {"damping", 0.05}});
  const auto found = linearDampingLimit(*pendulum, restOf(*pendulum), 0.0);
  ASSERT_TRUE(found);
  const double a = found->amplitude;
  EXPECT_NEAR(1.0 + 0.5 * (2.0 * std::cyl_bessel_j(1.0, a) / a - 1.0), 1.0 / 1.1, 1.0e-4);
  EXPECT_GT(a, 1.1);
  EXPECT_LT(a, 1.35);
}

// It turns at the stator's radius with all its decrement, and meets it a little beyond.
TEST(LinearDampingLimit, OfARotorEndsAtItsStator) {
  for (const double clearance : {1.0e-4, 1.0e-3}) {
    const auto rotor = dynamicsOf("jeffcott_rotor",
                                  {{"mass", 2.0},
                                   {"stiffness", 7200.0},
                                   {"damping", 12.0},
                                   {"rub_stiffness", 4.0e5},
                                   {"rub_damping", 60.0},
                                   {"rub_friction", 0.1},
                                   {"rotor_radius", 0.05},
                                   {"rub_clearance", clearance}},
                                  0.0);
    const auto found = linearDampingLimit(*rotor, restOf(*rotor), 100.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->coordinate, "whirl");
    EXPECT_GE(found->amplitude, clearance * (1.0 - 1.0e-9));
    EXPECT_LE(found->amplitude, 1.1 * clearance);
  }
}

}  // namespace decrement_amplitude_test
}  // namespace whirl_twin
