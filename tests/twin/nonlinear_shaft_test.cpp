// Rubs, oil films and cubic springs at nodes of a flexible rotor, against closed forms and against
// the same elements of the Jeffcott rotor, which uses other methods.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "analysis/equilibria.h"
#include "mechanics/rotors/short_journal_bearing.h"
#include "scene/scene_error.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace nonlinear_shaft_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHalf = 0.2;  // m, of the shaft

/// A light shaft of two elements in rigid bearings, with a stiffness [N/m] in its middle.
double diameterOf(double stiffness) {
  const double length = 2.0 * kHalf;
  return std::pow(64.0 / kPi * stiffness * std::pow(length, 3) / (48.0 * 2.0e11), 0.25);
}

std::string shaftOf(double stiffness, const std::string& more) {
  return fmt::format(
      "{{model: flexible_rotor, drive: shaft, parameters: {{youngs_modulus: 2.0e+11, density: "
      "1.0e-3, shear_deformation: false, elements: [{{length: {}, outer_diameter: {:.17g}, count: "
      "2}}], {}}}",
      kHalf, diameterOf(stiffness), more);
}

/// A disc of mass 4 in the middle of it, 500 rad/s if nothing else holds it.
std::string discOf(const std::string& more) {
  return shaftOf(1.0e6,
                 "discs: [{node: 1, mass: 4.0, polar_inertia: 1.0e-3, transverse_inertia: "
                 "1.0e-3}], bearings: [{node: 0, kxx: 1.0e+12}, {node: 2, kxx: 1.0e+12}, {node: 1, "
                 "cxx: 60.0}], " +
                     more);
}

/// On two films, its ends with a mass of 0.1 kg each.
constexpr const char* kEnds =
    "{node: 0, mass: 0.1, polar_inertia: 1.0e-9, transverse_inertia: 1.0e-9}, {node: 2, mass: 0.1, "
    "polar_inertia: 1.0e-9, transverse_inertia: 1.0e-9}";
constexpr const char* kFilm = "length: 0.01, diameter: 0.025, clearance: 1.0e-4, viscosity: 0.1";
std::string filmsOf(const std::string& more) {
  return shaftOf(
      20000.0,
      fmt::format("gravity_on_shaft: true, discs: [{{node: 1, mass: 2.0, polar_inertia: "
                  "1.0e-3, transverse_inertia: 1.0e-3}}, {}], journal_bearings: [{{node: 0, {}}}, "
                  "{{node: 2, {}}}], unbalances: [{{node: 1, magnitude: 1.0e-5}}], {}",
                  kEnds, kFilm, kFilm, more));
}

Scene sceneWith(double step, const std::string& drive, const std::string& systems) {
  return sceneOf(fmt::format("{{step: {:.9f}, drives: {{shaft: {{{}}}}}, systems: {{{}}}}}", step,
                             drive, systems));
}

void run(Twin& twin, double step, double seconds) {
  const auto steps = std::llround(seconds / step);
  for (std::int64_t i = 0; i < steps; ++i) {
    twin.step();
    for (std::size_t s = 0; s < twin.systems().size(); ++s) {
      ASSERT_EQ(twin.status(s), StepStatus::kOk) << "system " << s << ", step " << i;
    }
  }
}

/// x and y of a station of a system.
Eigen::Vector2d placeOf(const Twin& twin, std::size_t system, const std::string& station) {
  std::vector<double> motion(2 * twin.running(system).dof());
  twin.running(system).motion(motion.data());
  const Eigen::Map<const Eigen::VectorXd> q(motion.data(),
                                            static_cast<Eigen::Index>(motion.size() / 2));
  for (const Station& at : twin.systems()[system]->dynamics->stations()) {
    if (at.name == station) {
      return {at.along_x.dot(q), at.along_y.dot(q)};
    }
  }
  ADD_FAILURE() << "no station " << station;
  return {0.0, 0.0};
}

// The same rub by two models and two methods, a lift-off or a touch every few milliseconds.
TEST(LocalElements, RubAsAJeffcottRotorDoes) {
  Twin twin(sceneWith(
      2.0e-5, "speed: 480.0",
      "j: {model: jeffcott_rotor, drive: shaft, integrator: gauss_legendre_6, parameters: {mass: "
      "4.0, stiffness: 1.0e+6, damping: 60.0, eccentricity: 1.0e-4, rub_stiffness: 5.0e+5, "
      "rub_clearance: 1.0e-4, rub_friction: 0.1, rub_damping: 100.0, rotor_radius: 0.05}}, f: " +
          discOf("unbalances: [{node: 1, magnitude: 4.0e-4}], rubs: [{node: 1, clearance: 1.0e-4, "
                 "stiffness: 5.0e+5, damping: 100.0, friction: 0.1, radius: 0.05}], modes: 0}")));
  run(twin, 2.0e-5, 0.1);
  const Eigen::Vector2d jeffcott = placeOf(twin, 0, "disc");
  EXPECT_GT(jeffcott.norm(), 1.5e-4);  // it rubs
  EXPECT_LT((placeOf(twin, 1, "node_1") - jeffcott).norm(), 3e-5 * jeffcott.norm());
}

// Dropped into its films, two on each journal's side, from the middle.
TEST(LocalElements, SettleInFilmsAsAJeffcottRotorDoes) {
  Twin twin(sceneWith(
      1.0e-4, "speed: 150.0",
      "j: {model: jeffcott_rotor, drive: shaft, integrator: gauss_legendre_6, parameters: {mass: "
      "2.0, stiffness: 20000.0, eccentricity: 5.0e-6, gravity_on_shaft: true, bearing_length: "
      "0.01, bearing_diameter: 0.025, bearing_clearance: 1.0e-4, bearing_viscosity: 0.1, "
      "journal_mass: 0.2}, initial: {}}, f: " +
          filmsOf("modes: 0}, initial: {}")));
  run(twin, 1.0e-4, 0.1);
  const Eigen::Vector2d jeffcott = placeOf(twin, 0, "disc");
  EXPECT_LT((placeOf(twin, 1, "node_1") - jeffcott).norm(), 2e-6 * jeffcott.norm());
}

// A Jeffcott rotor in its oil films by the exact step of its linear part, in a run-up, against
// another method of another order at a quarter of the step. It starts away from the films'
// equilibrium: within a tenth of the first step they carry it.
TEST(LocalElements, OfAJeffcottRotorInFilmsGoAsByAnotherMethod) {
  const auto rotor = [](double step, const char* integrator) {
    return sceneWith(
        step, "speed: 60.0, profile: [{speed: 150.0, max_acceleration: 300.0, dwell: 1.0}]",
        fmt::format("j: {{model: jeffcott_rotor, drive: shaft, integrator: {}, parameters: {{mass: "
                    "2.0, stiffness: 20000.0, damping: 2.0, internal_damping: 3.0, "
                    "cross_coupling: 50.0, eccentricity: 5.0e-5, bow: 1.0e-5, gravity_on_shaft: "
                    "true, bearing_length: 0.01, bearing_diameter: 0.025, bearing_clearance: "
                    "1.0e-4, bearing_viscosity: 0.1, journal_mass: 0.2}}, initial: {{y: -1.0e-3, "
                    "journal_y: -2.0e-5}}}}",
                    integrator));
  };
  Twin twin(rotor(5.0e-4, "exponential"));
  Twin judge(rotor(1.25e-4, "gauss_legendre_6"));
  run(twin, 5.0e-4, 0.1);
  run(judge, 1.25e-4, 0.1);
  const Eigen::Vector2d disc = placeOf(judge, 0, "disc");
  const Eigen::Vector2d place = placeOf(twin, 0, "disc");
  EXPECT_LT((place - disc).norm(), 1e-7 * disc.norm());
  twin.reset();
  run(twin, 5.0e-4, 0.1);
  EXPECT_EQ(placeOf(twin, 0, "disc"), place) << "the same numbers after a reset";
}

// Where the weight is carried: Ocvirk's locus, by Newton's method on all coordinates.
TEST(LocalElements, RestWhereTheirFilmsCarryTheWeight) {
  const Scene scene = sceneWith(1.0e-4, "speed: 150.0", "f: " + filmsOf("modes: auto}"));
  const Dynamics& dynamics = *scene.systems[0].setup->made.dynamics;
  const std::vector<Equilibrium> found = equilibria(dynamics, 150.0);
  ASSERT_EQ(found.size(), 1u);
  const ShortJournalBearing film{0.01, 0.025, 1.0e-4, 0.1};
  const double weight = 2.2 * 9.80665;
  const JournalPosition rest = film.staticPosition(0.5 * weight, 150.0);
  for (const Station& station : dynamics.stations()) {
    if (station.name == "node_0" || station.name == "node_2") {
      EXPECT_NEAR(station.along_x.dot(found[0].q), rest.x, 1e-6 * film.clearance);
      EXPECT_NEAR(station.along_y.dot(found[0].q), rest.y, 1e-6 * film.clearance);
    } else {
      EXPECT_NEAR(station.along_y.dot(found[0].q), rest.y - 2.0 * 9.80665 / 20000.0,
                  1e-6 * film.clearance);
    }
  }
  EXPECT_TRUE(found[0].stability.bounded());
  // Linear about there, it is the rotor on coefficients of that load.
  const auto linear = sceneWith(
      1.0e-4, "speed: 150.0",
      "f: " +
          shaftOf(20000.0,
                  fmt::format(
                      "discs: [{{node: 1, mass: 2.0, polar_inertia: 1.0e-3, "
                      "transverse_inertia: 1.0e-3}}, {}], journal_bearings: [{{node: 0, {}, load: "
                      "{:.17g}}}, {{node: 2, {}, load: {:.17g}}}], modes: 0}}",
                      kEnds, kFilm, 0.5 * weight, kFilm, 0.5 * weight)));
  const Scene full = sceneWith(1.0e-4, "speed: 150.0", "f: " + filmsOf("modes: 0}"));
  const Dynamics& in_films = *full.systems[0].setup->made.dynamics;
  const std::vector<Equilibrium> at = equilibria(in_films, 150.0);
  ASSERT_EQ(at.size(), 1u);
  const Linearization l = linearizationAtRest(in_films, at[0].q, 150.0);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(in_films.dof());
  const Linearization e = linearizationAtRest(*linear.systems[0].setup->made.dynamics, zero, 150.0);
  EXPECT_LT((l.stiffness - e.stiffness).norm(), 1e-6 * e.stiffness.norm());
  EXPECT_LT((l.circulatory - e.circulatory).norm(), 1e-6 * e.circulatory.norm());
  EXPECT_LT((l.damping - e.damping).norm(), 1e-6 * e.damping.norm());
}

// Duffing's oscillator has its period in closed form, by a complete elliptic integral.
TEST(LocalElements, SwingOnACubicSpringWithDuffingsPeriod) {
  const double mass = 4.0, linear = 1.0e6, cubic = 4.0e13, amplitude = 2.0e-4;
  const double hardened = (linear + cubic * amplitude * amplitude) / mass;
  const double modulus = std::sqrt(0.5 * cubic * amplitude * amplitude / mass / hardened);
  const double period = 4.0 * std::comp_ellint_1(modulus) / std::sqrt(hardened);
  EXPECT_LT(period, 0.7 * 2.0 * kPi / 500.0);  // far from that of small motions
  const double step = std::round(period / 200.0 * 1e9) * 1e-9;
  Twin twin(sceneWith(
      step, "speed: 0.0",
      "f: " + shaftOf(linear, fmt::format("discs: [{{node: 1, mass: 4.0, polar_inertia: 1.0e-3, "
                                          "transverse_inertia: 1.0e-3}}], bearings: [{{node: 0, "
                                          "kxx: 1.0e+12}}, {{node: 2, kxx: 1.0e+12}}], "
                                          "cubic_springs: [{{node: 1, stiffness: {}}}], modes: "
                                          "2}}, initial: {{q1: {}}}",
                                          cubic, amplitude))));
  const Eigen::Vector2d start = placeOf(twin, 0, "node_1");
  for (int turn = 0; turn < 20; ++turn) {
    run(twin, step, 100 * step);
    EXPECT_LT((placeOf(twin, 0, "node_1") + start).norm(), 1e-3 * start.norm()) << turn;
    run(twin, step, 100 * step);
    EXPECT_LT((placeOf(twin, 0, "node_1") - start).norm(), 1e-3 * start.norm()) << turn;
  }
}

// Dropped into films and whirling there, to the fifth order.
TEST(LocalElements, AreSteppedToTheFifthOrder) {
  const auto after = [](double step) {
    Twin twin(sceneWith(step, "speed: 300.0", "f: " + filmsOf("modes: auto}, initial: {}")));
    run(twin, step, 0.064);
    return placeOf(twin, 0, "node_0");
  };
  const Eigen::Vector2d exact = after(1.5625e-5);
  const double coarse = (after(1.25e-4) - exact).norm();
  const double fine = (after(6.25e-5) - exact).norm();
  EXPECT_GT(std::log2(coarse / fine), 4.5);
  EXPECT_LT(fine, 1e-9 * 1.0e-4);
  // Steps far longer than the film takes to stop a journal's end are good ones.
  EXPECT_LT((after(2.0e-3) - exact).norm(), 1e-5 * 1.0e-4);
}

// In a run-up the response of the stations is known only approximately: forces and positions are
// consistent all the same. Their work is counted by the step at constant speed, by a quadrature in
// a run-up.
TEST(LocalElements, CloseTheEnergyBalanceAtConstantSpeedAndInARunUp) {
  const auto after = [](double step, const std::string& drive, double& open) {
    Twin twin(sceneWith(
        step, drive,
        "f: " + filmsOf("rubs: [{node: 1, clearance: 1.0e-3, stiffness: 2.0e+4, damping: 10.0, "
                        "friction: 0.1, radius: 0.1}], modes: auto}, initial: {}")));
    Observer observer(twin);
    std::vector<double> record(twin.layout().size);
    open = 0.0;
    const auto steps = std::llround(0.128 / step);
    for (std::int64_t i = 0; i < steps; ++i) {
      twin.step();
      EXPECT_EQ(twin.status(0), StepStatus::kOk);
      twin.write(record.data());
      observer.observe(record.data());
      open = std::max(open, std::fabs(observer.energyResidual(0)));
    }
    return placeOf(twin, 0, "node_0");
  };
  double open = 0.0;
  after(5.0e-4, "speed: 200.0", open);
  EXPECT_LT(open, 1e-13);
  const std::string run_up =
      "speed: 100.0, profile: [{speed: 300.0, max_acceleration: 2000.0, dwell: 0.02}]";
  const Eigen::Vector2d exact = after(1.25e-4, run_up, open);
  EXPECT_LT(open, 1e-6);
  const Eigen::Vector2d coarse = after(5.0e-4, run_up, open);
  EXPECT_LT(open, 1e-4);
  EXPECT_LT((coarse - exact).norm(), 1e-3 * 1.0e-4);
}

TEST(LocalElements, StepWithoutAllocations) {
  Twin twin(sceneWith(
      5.0e-4, "speed: 100.0, profile: [{speed: 110.0, max_acceleration: 500.0}]",
      "f: " + filmsOf("rubs: [{node: 1, clearance: 1.0e-5, stiffness: 2.0e+4}], cubic_springs: "
                      "[{node: 1, stiffness: 1.0e+10}], modes: auto}")));
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    twin.step();
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(twin.status(0), StepStatus::kOk);
}

// A reduced-order rotor has the equilibria and motions in its films of the full-order one: its
// modes represent the effect of a force at each of them.
TEST(LocalElements, SeeTheWholeShaftInAReducedOne) {
  const auto rotor = [](const std::string& modes) {
    return fmt::format(
        "{{model: flexible_rotor, drive: shaft, parameters: {{youngs_modulus: 2.1e+11, density: "
        "7850.0, gravity_on_shaft: true, elements: [{{length: 0.1, outer_diameter: 0.04, count: "
        "8}}], discs: [{{node: 3, mass: 12.0, polar_inertia: 0.06, transverse_inertia: 0.035}}], "
        "journal_bearings: [{{node: 1, length: 0.02, diameter: 0.04, clearance: 8.0e-5, viscosity: "
        "0.20}}, {{node: 7, length: 0.02, diameter: 0.04, clearance: 8.0e-5, viscosity: 0.20}}], "
        "unbalances: [{{node: 3, magnitude: 5.0e-4}}], modes: {}}}",
        modes);
  };
  Twin twin(sceneWith(2.5e-4, "speed: 200.0",
                      "whole: " + rotor("0") + "}, reduced: " + rotor("auto") + "}"));
  run(twin, 2.5e-4, 0.1);
  EXPECT_LT(twin.running(1).dof(), twin.running(0).dof());
  for (const char* station : {"node_1", "node_3", "node_7"}) {
    const Eigen::Vector2d whole = placeOf(twin, 0, station);
    EXPECT_GT(whole.norm(), 1e-6);
    EXPECT_LT((placeOf(twin, 1, station) - whole).norm(), 1e-4 * 8.0e-5) << station;
  }
}

// A damper's ring is the pedestal of the bearing: nothing else is coupled to its film.
TEST(LocalElements, DampTheRingOfABearing) {
  const Scene scene = sceneWith(
      1.0e-4, "speed: 150.0",
      "f: " +
          shaftOf(1.0e6, fmt::format("discs: [{{node: 1, mass: 4.0}}], bearings: [{{node: 0, kxx: "
                                     "1.0e+7}}, {{node: 2, kxx: 1.0e+7}}], pedestals: [{{node: 2, "
                                     "mass: 1.0, kxx: 1.0e+6}}], squeeze_films: [{{node: 2, {}}}], "
                                     "modes: 0}}",
                                     kFilm)));
  const Dynamics& dynamics = *scene.systems[0].setup->made.dynamics;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(dynamics.dof());
  Eigen::VectorXd v = q;
  const auto coordinates = dynamics.coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (coordinates[i].name == "pedestal_x_2") {
      v[static_cast<Eigen::Index>(i)] = 1.0e-3;
      const Eigen::VectorXd force = dynamics.residualForce(q, v, {0.0, 0.0, 150.0, 0.0});
      // About the middle: pi mu R L^3 / (2 c^3).
      const double damping = 0.5 * kPi * 0.1 * 0.0125 * 1.0e-6 / 1.0e-12;
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        EXPECT_NEAR(force[k], k == static_cast<Eigen::Index>(i) ? -1.0e-3 * damping : 0.0,
                    1e-8 * damping)
            << k;
      }
      return;
    }
  }
  ADD_FAILURE() << "no ring";
}

// A shaft that does not turn sinks through its oil, ever more slowly, and never touches.
TEST(LocalElements, SinkInTheirFilmsAtRest) {
  Twin twin(sceneWith(1.0e-3, "speed: 0.0", "f: " + filmsOf("modes: auto}")));
  run(twin, 1.0e-3, 5.0);
  const Eigen::Vector2d place = placeOf(twin, 0, "node_0");
  EXPECT_LT(place[1], -0.9e-4);
  EXPECT_GT(place[1], -1.0e-4);
}

TEST(LocalElements, AreRefusedWhereTheyDoNotFitTogether) {
  struct Refused {
    std::string elements, message;
  };
  for (const Refused& r : std::vector<Refused>{
           {"rubs: [{node: 3, clearance: 1.0e-3, stiffness: 1.0}]",
            "rubs[0].node: must be a whole number from 0 to 2, found 3"},
           {"rubs: [{node: 1, clearance: 1.0e-3, stiffness: 1.0, friction: 0.1}]",
            "rubs[0].radius: must be > 0 m with friction"},
           {"cubic_springs: [{node: 1, stiffness: 1.0}, {node: 1, stiffness: 2.0}]",
            "cubic_springs[1].node: duplicate: node 1 already has one"},
           {"squeeze_films: [{node: 1, length: 0.01, diameter: 0.02, clearance: 1.0e-4}]",
            "squeeze_films[0].viscosity: missing"}}) {
    try {
      sceneWith(1.0e-3, "speed: 10.0", "f: " + discOf(r.elements + "}"));
      ADD_FAILURE() << "was accepted: " << r.elements;
    } catch (const SceneError& error) {
      ASSERT_EQ(error.errors().size(), 1u) << error.what();
      EXPECT_EQ(error.errors()[0].rfind("test.yaml: systems.f.parameters." + r.message, 0), 0u)
          << error.errors()[0];
    }
  }
}

}  // namespace nonlinear_shaft_test
}  // namespace whirl_twin
