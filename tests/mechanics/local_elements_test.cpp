// Nodal forces of elements around a shaft: closed forms of oil films on circular orbits, contact
// and friction, and derivatives consistent with the forces.
#include "mechanics/local_elements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace whirl_twin {
namespace local_elements_test {

constexpr double kPi = 3.14159265358979323846;
constexpr ShortJournalBearing kBearing{0.02, 0.05, 1.0e-4, 0.03};

NodalForce pushOf(const NodalForceLaw& law, const LocalState& at) {
  NodalForce push;
  EXPECT_TRUE(law.push(at, push));
  return push;
}

/// With the damping that is the rotor's own.
NodalForce wholePushOf(const OilFilm& film, const LocalState& at) {
  NodalForce push = pushOf(*localLaw(film), at);
  for (std::size_t i = 0; i < 2; ++i) {
    push.force[i] -= film.linearDamping() * at.rate[i];
  }
  return push;
}

// On a circular orbit about the middle the short pi film answers with a stiffness towards the
// middle and a damping along the orbit (Vance, Rotordynamics of Turbomachinery, 1988, ch. 6).
TEST(SqueezeFilm, HasTheClosedFormOfACircularOrbit) {
  const OilFilm film{kBearing, false};
  const double c = kBearing.clearance;
  const double scale =
      kBearing.viscosity * 0.5 * kBearing.diameter * std::pow(kBearing.length, 3) / (c * c * c);
  const double whirl = 120.0;
  for (const double e : {0.05, 0.4, 0.8}) {
    const double rest = 1.0 - e * e;
    const double stiffness = 2.0 * scale * e * whirl / (rest * rest);
    const double damping = 0.5 * kPi * scale / std::pow(rest, 1.5);
    // Where the shaft turns does not matter.
    const LocalState at{{e * c, 0.0}, {0.0, whirl * e * c}, {}, 777.0};
    const NodalForce push = wholePushOf(film, at);
    EXPECT_NEAR(push.force[0], -stiffness * e * c, 1e-9 * stiffness * c) << e;
    EXPECT_NEAR(push.force[1], -damping * whirl * e * c, 1e-9 * damping * whirl * c) << e;
  }
}

// Ocvirk's journal bearing: it carries the load on his locus, with the coefficients of
// coefficients(), and a whirl at half its speed meets no resistance.
TEST(JournalFilm, CarriesItsLoadOnOcvirksLocus) {
  const OilFilm film{kBearing, true};
  const auto law = localLaw(film);
  const double load = 300.0;
  const double speed = 250.0;
  const JournalPosition rest = kBearing.staticPosition(load, speed);
  const double e = rest.eccentricity;
  EXPECT_NEAR(std::tan(rest.attitude), kPi * std::sqrt(1.0 - e * e) / (4.0 * e), 1e-12);
  const LocalState at{{rest.x, rest.y}, {}, {}, speed};
  const NodalForce push = pushOf(*law, at);
  EXPECT_NEAR(push.force[0], 0.0, 1e-7 * load);
  EXPECT_NEAR(push.force[1], load, 1e-7 * load);
  const BearingCoefficients b = kBearing.coefficients(load, speed);
  const LocalSlopes slopes = law->slopes(at);
  Eigen::Matrix2d k, c;
  k << b.kxx, b.kxy, b.kyx, b.kyy;
  c << b.cxx, b.cxy, b.cyx, b.cyy;
  c.diagonal().array() -= film.linearDamping();
  EXPECT_LT((slopes.stiffness - k).norm(), 1e-12 * k.norm());
  EXPECT_LT((slopes.damping - c).norm(), 1e-12 * c.norm());
  const double radius = 0.5 * kBearing.clearance;
  const NodalForce whirling =
      wholePushOf(film, {{radius, 0.0}, {0.0, 0.5 * speed * radius}, {}, speed});
  EXPECT_LT(std::hypot(whirling.force[0], whirling.force[1]), 1e-6 * load);
}

TEST(JournalFilm, HasNoPlaceBeyondItsClearance) {
  const auto law = localLaw(OilFilm{kBearing, true});
  NodalForce push;
  for (const double x : {kBearing.clearance, 2.0 * kBearing.clearance, std::nan("")}) {
    EXPECT_FALSE(law->push({{x, 0.0}, {}, {}, 100.0}, push)) << x;
  }
  EXPECT_NEAR(law->room({0.0, -0.6e-4}), 0.4e-4, 1e-18);
}

TEST(RubElement, TouchesBeyondItsClearanceOnlyAndDragsAgainstTheSliding) {
  const Rub rub{1.0e-3, 1.0e6, 50.0, 0.2, 0.1};
  const auto law = localLaw(rub);
  LocalState at{{0.6e-3, 0.7e-3}, {1.0, -1.0}, {}, 100.0};
  EXPECT_EQ(pushOf(*law, at).force, (std::array<double, 2>{0.0, 0.0}));
  at.place = {0.0, 1.5e-3};
  at.rate = {0.0, 0.02};
  // At the top the surface slides along -x where the shaft turns forwards.
  const NodalForce push = pushOf(*law, at);
  const double load = 1.0e6 * 0.5e-3;
  EXPECT_NEAR(push.force[1], -load - 50.0 * 0.02, 1e-9 * load);
  EXPECT_NEAR(push.force[0], 0.2 * load, 1e-7 * load);
  // Rolling along the wall backwards it does not slide.
  at.rate = {0.1 * 100.0, 0.0};
  EXPECT_NEAR(pushOf(*law, at).force[0], 0.0, 1e-9 * load);
}

TEST(CubicSpring, PullsTowardsTheMiddleWithTheThirdPower) {
  const auto law = localLaw(CubicSpring{2.0e12});
  const NodalForce push = pushOf(*law, {{3.0e-4, -4.0e-4}, {5.0, 5.0}, {}, 10.0});
  EXPECT_NEAR(push.force[0], -2.0e12 * 25.0e-8 * 3.0e-4, 1e-9);
  EXPECT_NEAR(push.force[1], 2.0e12 * 25.0e-8 * 4.0e-4, 1e-9);
}

TEST(LocalElements, TellTheSlopesOfWhatTheyPushWith) {
  const std::vector<std::shared_ptr<const NodalForceLaw>> laws{
      localLaw(CubicSpring{2.0e12}), localLaw(Rub{4.0e-5, 1.0e6, 50.0, 0.2, 0.1}),
      localLaw(OilFilm{kBearing, true}), localLaw(OilFilm{kBearing, false})};
  const LocalState at{{3.0e-5, -5.0e-5}, {2.0e-3, 4.0e-3}, {}, 90.0};
  for (const auto& law : laws) {
    const LocalSlopes slopes = law->slopes(at);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const bool rate : {false, true}) {
        const double by = rate ? 1.0e-8 : 1.0e-11;
        LocalState more = at, less = at;
        (rate ? more.rate : more.place)[axis] += by;
        (rate ? less.rate : less.place)[axis] -= by;
        const NodalForce up = pushOf(*law, more);
        const NodalForce down = pushOf(*law, less);
        const Eigen::Matrix2d& slope = rate ? slopes.damping : slopes.stiffness;
        for (std::size_t i = 0; i < 2; ++i) {
          EXPECT_NEAR(slope(static_cast<int>(i), static_cast<int>(axis)),
                      -(up.force[i] - down.force[i]) / (2.0 * by), 1e-5 * (1.0 + slope.norm()));
        }
      }
    }
  }
}

}  // namespace local_elements_test
}  // namespace whirl_twin
