// Equilibria of rotors on two oil films agree with statics and Ocvirk's closed form: the loads of
// two bearings follow from the weights by the law of the lever, and each journal's position from
// its load (Ocvirk, NACA TN 2808, 1952; Childs, Turbomachinery Rotordynamics, 1993).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "../scene/scenes.h"
#include "analysis/equilibria.h"
#include "scene/built_scene.h"

namespace whirl_twin {
namespace film_equilibria_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.80665;
constexpr double kDensity = 7850.0;

struct Film {
  int node = 0;
  double length = 0.0, diameter = 0.0, clearance = 0.0, viscosity = 0.0;
  double load = 0.0, eccentricity = 0.0;  ///< right values

  /// [m], where the load holds the journal: its attitude is atan(pi sqrt(1 - e^2) / 4 e).
  double x() const { return clearance * eccentricity * std::sin(attitude()); }
  double y() const { return -clearance * eccentricity * std::cos(attitude()); }
  double attitude() const {
    return std::atan2(kPi * std::sqrt(1.0 - eccentricity * eccentricity), 4.0 * eccentricity);
  }
  std::string text() const {
    return fmt::format(
        "{{node: {}, length: {:.17g}, diameter: {:.17g}, clearance: {:.17g}, viscosity: {:.17g}}}",
        node, length, diameter, clearance, viscosity);
  }
};

/// The oil with which a film holds its load at its eccentricity and a speed [rad/s].
double viscosityOf(const Film& film, double speed) {
  const double e = film.eccentricity;
  const double rest = 1.0 - e * e;
  const double load_number = e * std::sqrt(kPi * kPi * rest + 16.0 * e * e) / (rest * rest);
  const double radius = 0.5 * film.diameter;
  return film.load * 4.0 * film.clearance * film.clearance /
         (radius * film.length * film.length * film.length * speed * load_number);
}

struct DrawnRotor {
  std::string elements, discs;
  Film left, right;
  double speed = 0.0;  ///< [rad/s]

  BuiltScene built(const std::string& modes, double unbalance) const {
    return build(sceneOf(fmt::format(
        "{{step: 0.001, systems: {{r: {{model: flexible_rotor, parameters: {{speed: {:.17g}, "
        "youngs_modulus: 2.1e+11, density: {}, gravity_on_shaft: true, modes: {}, elements: [{}], "
        "discs: [{}], journal_bearings: [{}, {}]{}}}}}}}}}",
        speed, kDensity, modes, elements, discs, left.text(), right.text(),
        unbalance > 0.0 ? fmt::format(", unbalances: [{{node: 1, magnitude: {}}}]", unbalance)
                        : "")));
  }
};

/// With so many elements; the oil films have these eccentricities, the right one is another
/// bearing.
DrawnRotor drawn(std::mt19937& draws, int elements, double left, double right) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  DrawnRotor r;
  r.speed = between(100.0, 1200.0);
  const double length = between(0.4, 1.2) / elements;
  const double diameter = between(0.03, 0.06);
  r.elements = fmt::format("{{length: {:.17g}, outer_diameter: {:.17g}, count: {}}}", length,
                           diameter, elements);
  r.left.node = static_cast<int>(between(0.0, 0.25 * elements));
  r.right.node = elements - static_cast<int>(between(0.0, 0.25 * elements));
  const double span = length * (r.right.node - r.left.node);
  double weight = kGravity * kDensity * 0.25 * kPi * diameter * diameter * length * elements;
  double moment = weight * length * (0.5 * elements - r.left.node);  // about the left film
  for (int i = 0; i < 2; ++i) {
    const int node =
        static_cast<int>(between(r.left.node + 0.2 * elements, r.right.node - 0.2 * elements));
    const double mass = between(2.0, 20.0);
    r.discs += fmt::format(
        "{}{{node: {}, mass: {:.17g}, polar_inertia: {:.17g}, transverse_inertia: {:.17g}}}",
        i == 0 ? "" : ", ", node, mass, 5.0e-3 * mass, 3.0e-3 * mass);
    weight += kGravity * mass;
    moment += kGravity * mass * length * (node - r.left.node);
  }
  r.right.load = moment / span;
  r.left.load = weight - r.right.load;
  r.left.eccentricity = left;
  r.right.eccentricity = right;
  for (Film* film : {&r.left, &r.right}) {
    film->diameter = diameter;
    film->length = between(0.2, 0.5) * diameter;
    film->clearance = between(0.8e-3, 3.0e-3) * diameter;
    film->viscosity = viscosityOf(*film, r.speed);
  }
  return r;
}

/// The operating point of the built rotor against the right positions of its journals.
void expectAtRest(const DrawnRotor& right, const std::string& modes, double unbalance) {
  SCOPED_TRACE(fmt::format("e {} and {}, {} rad/s, modes {}, unbalance {}", right.left.eccentricity,
                           right.right.eccentricity, right.speed, modes, unbalance));
  const BuiltScene scene = right.built(modes, unbalance);
  const Dynamics& dynamics = *scene.systems[0]->dynamics;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  const auto point = operatingPoint(dynamics, zero, zero, right.speed);
  ASSERT_TRUE(point.has_value());
  const EvaluationPoint<double> at{0.0, 0.0, right.speed, 0.0};
  int gaps = 0;
  for (const Condition& gap : dynamics.conditions(point->q, zero, zero, at)) {
    const Film& film =
        gap.name == fmt::format("gap_journal_{}", right.left.node) ? right.left : right.right;
    EXPECT_NEAR(1.0 - gap.margin / film.clearance, film.eccentricity, 1.0e-6) << gap.name;
    ++gaps;
  }
  EXPECT_EQ(gaps, 2);
  if (modes == "0") {
    const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
    for (const Film* film : {&right.left, &right.right}) {
      for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const double place = point->q[static_cast<Eigen::Index>(i)];
        if (coordinates[i].name == fmt::format("x_{}", film->node)) {
          EXPECT_NEAR(place, film->x(), 1.0e-6 * film->clearance);
        } else if (coordinates[i].name == fmt::format("y_{}", film->node)) {
          EXPECT_NEAR(place, film->y(), 1.0e-6 * film->clearance);
        }
      }
    }
  }
}

TEST(FilmEquilibria, OfRotorsDrawnAtRandomAreThoseOfStaticsAndOcvirk) {
  std::mt19937 draws(20261127);
  const double eccentricities[][2] = {{0.05, 0.05}, {0.2, 0.6}, {0.51, 0.51}, {0.6, 0.55},
                                      {0.7, 0.1},   {0.8, 0.8}, {0.05, 0.95}, {0.9, 0.5},
                                      {0.95, 0.95}, {0.3, 0.75}};
  const int elements[] = {4, 5, 6, 8, 10, 12, 7, 9, 5, 14};
  for (int i = 0; i < 10; ++i) {
    const DrawnRotor rotor = drawn(draws, elements[i], eccentricities[i][0], eccentricities[i][1]);
    expectAtRest(rotor, "0", 0.0);
    expectAtRest(rotor, "0", 1.0e-12);
  }
}

TEST(FilmEquilibria, OfRotorsInReducedModesAreTheSame) {
  std::mt19937 draws(7);
  for (const double e : {0.3, 0.6, 0.9}) {
    const DrawnRotor rotor = drawn(draws, 16, e, 0.9 * e);
    expectAtRest(rotor, "auto", 0.0);
    expectAtRest(rotor, "auto", 1.0e-12);
  }
}

TEST(FilmEquilibria, OfARotorOfManyElementsAreTheSame) {
  std::mt19937 draws(11);
  expectAtRest(drawn(draws, 40, 0.9, 0.6), "0", 0.0);
}

}  // namespace film_equilibria_test
}  // namespace whirl_twin
