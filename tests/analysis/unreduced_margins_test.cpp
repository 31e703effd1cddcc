// Full-order margins in the stability evaluation of a reduced-order rotor, against all eigenvalues
// of the full-order model in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "all_eigenvalues.h"
#include "analysis/full_order_margins.h"
#include "analysis/modal_reduction.h"
#include "mechanics/linear_rotor_dynamics.h"
#include "random_shafts.h"

namespace whirl_twin {
namespace unreduced_margins_test {

using Complex = std::complex<double>;

bool grows(const Complex& s) {
  return s.real() > 1.0e-12 * std::abs(s);
}

struct Truth {
  double decay_rate = std::numeric_limits<double>::infinity();
  double frequency = 0.0;  ///< [rad/s], of that
  bool grows = false, beyond = false;
};

Truth truthOf(const Linearization& l, double reach) {
  Truth truth;
  for (const Complex& s : allEigenvalues(l)) {
    truth.grows = truth.grows || grows(s);
    truth.beyond = truth.beyond || (grows(s) && std::abs(s) > reach);
    if ((std::abs(s) <= reach || grows(s)) && -s.real() < truth.decay_rate) {
      truth.decay_rate = -s.real();
      truth.frequency = std::abs(s);
    }
  }
  return truth;
}

/// With `count` modes, with these forces at its nodes.
std::shared_ptr<const Dynamics> reduced(const FlexibleShaft& shaft, int count,
                                        double highest_speed) {
  const RotorAssembly whole(shaft);
  const RotorReduction kept =
      reduceRotor(whole.linearRotor(), whole.stations(), highest_speed, count);
  const RotorAssembly assembly = whole.in(kept.shapes);
  RotorDescription description;
  description.model = "flexible_rotor";
  for (int i = 0; i < count; ++i) {
    description.coordinates.push_back({"q" + std::to_string(i), "m"});
  }
  description.stations = assembly.stations();
  LinearRotor rotor = assembly.linearRotor(std::make_shared<const FullOrderRotor>(
      FullOrderRotor{std::make_shared<const RotorAssembly>(whole), kept.shapes, {}}));
  rotor.highest_speed = highest_speed;
  return std::make_shared<const LinearRotorDynamics>(std::move(description), std::move(rotor));
}

TEST(FullOrderMargins, AreThoseOfAllEigenvaluesOfTheRotorHoweverFewShapesAreKept) {
  int disagreed = 0;
  int grew = 0;
  int beyond = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const RandomShaft drawn = randomShaft(seed, 5 + static_cast<int>(seed % 12));
    const RotorAssembly whole(drawn.shaft);
    const double highest = usualHighestSpeed(whole.linearRotor());
    const double reach = std::max(highest, drawn.speed);
    const Truth truth = truthOf(whole.matrices(drawn.speed), reach);
    const double rounding = 1.0e-9 * truth.frequency;
    for (const int count : {2, 4, 10}) {
      const auto dynamics = reduced(drawn.shaft, count, highest);
      const auto margins = FullOrderMargins::of(dynamics);
      ASSERT_TRUE(margins);
      const ReducedMargins found = margins->at(Eigen::VectorXd::Zero(count), drawn.speed);
      if (truth.beyond && !found.unreduced.grows) {
        ++beyond;  // outside the search range
        continue;
      }
      EXPECT_NEAR(found.unreduced.decay_rate, truth.decay_rate, rounding)
          << "seed " << seed << ", " << count << " shapes";
      EXPECT_EQ(found.unreduced.grows, truth.grows) << "seed " << seed;
      const Truth of_shapes = truthOf(dynamics->linearRotor().matrices(drawn.speed),
                                      std::numeric_limits<double>::infinity());
      EXPECT_NEAR(found.reduced.decay_rate, of_shapes.decay_rate, 1.0e-9 * of_shapes.frequency)
          << "seed " << seed << ", " << count << " shapes";
      EXPECT_EQ(found.disagree(), of_shapes.grows != truth.grows) << "seed " << seed;
      disagreed += found.disagree() ? 1 : 0;
      grew += truth.grows ? 1 : 0;
    }
  }
  EXPECT_GE(disagreed, 6) << "otherwise the draws tell nothing";
  EXPECT_GE(grew, 30);
  EXPECT_LE(beyond, 6);
}

TEST(FullOrderMargins, AreNoneOfARotorInAllItsCoordinates) {
  const RotorAssembly whole(randomShaft(1, 6).shaft);
  RotorDescription description;
  description.model = "flexible_rotor";
  for (Eigen::Index i = 0; i < whole.dof(); ++i) {
    description.coordinates.push_back({"q" + std::to_string(i), "m"});
  }
  description.stations = whole.stations();
  EXPECT_FALSE(FullOrderMargins::of(
      std::make_shared<const LinearRotorDynamics>(std::move(description), whole.linearRotor())));
}

}  // namespace unreduced_margins_test
}  // namespace whirl_twin
