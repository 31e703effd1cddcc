// Ensembles: reading, random draws, and that samples equal the same systems stepped alone.
#include "twin/ensemble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "models/model_registry.h"
#include "running_twin.h"
#include "scene/ensemble_draw.h"
#include "twin/ensemble_observer.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace ensemble_test {

std::string rotorScene(const std::string& more) {
  return R"(
step: 0.001
drives: {shaft: {speed: 0.0, profile: [{speed: 150.0, max_acceleration: 500.0, max_jerk: 9000.0}]}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1, stiffness: 1.0e4, damping: 10, eccentricity: 1.0e-4}
)" + more;
}

std::string pendulumScene(const std::string& more,
                          const std::string& integrator = "gauss_legendre_6") {
  return R"(
step: 0.001
systems:
  arms:
    model: double_pendulum
    integrator: )" +
         integrator + R"(
    parameters: {mass1: 1, mass2: 2, length1: 1, length2: 0.5}
    initial: {theta1: 1.0, theta2: -0.5}
)" + more;
}

std::vector<std::string> errorsOf(const std::string& yaml) {
  try {
    sceneOf(yaml);
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

std::string errorOf(const std::string& yaml) {
  const std::vector<std::string> errors = errorsOf(yaml);
  EXPECT_EQ(errors.size(), 1u) << yaml;
  return errors.empty() ? "" : errors[0];
}

std::vector<double> recordOf(const Twin& twin) {
  std::vector<double> record(twin.ensemble(0)->recordSize());
  twin.ensemble(0)->write(twin.stepCount(), record.data());
  return record;
}

TEST(EnsembleReader, ReadsWhatIsSpread) {
  const Scene scene = sceneOf(rotorScene(R"(
    initial: {x: 2.0e-4}
    count: 30
    seed: 5
    spread:
      stiffness: {relative_half_width: 0.1}
      eccentricity: {standard_deviation: 1.0e-5}
      initial.x: {half_width: 1.0e-4}
      initial.y_rate: {standard_deviation: 0.01})"));
  const EnsembleSpec& e = scene.systems[0].ensemble;
  EXPECT_EQ(e.count, 30u);
  EXPECT_EQ(e.seed, 5u);
  ASSERT_EQ(e.spread.size(), 4u);
  EXPECT_DOUBLE_EQ(e.spread[0].width, 1.0e3) << "N/m";
  EXPECT_FALSE(e.spread[0].normal);
  EXPECT_TRUE(e.spread[1].normal);
  EXPECT_EQ(e.spread[2].kind, Spread::Kind::kCoordinate);
  EXPECT_EQ(e.spread[3].kind, Spread::Kind::kRate);
  EXPECT_EQ(e.spread[3].coordinate, 1u);
  EXPECT_EQ(sceneOf(rotorScene("")).systems[0].ensemble.count, 0u);
}

TEST(EnsembleReader, SaysWhatIsWrong) {
  EXPECT_EQ(errorOf(rotorScene("    count: 10\n")),
            "test.yaml: systems.rotor.spread: missing; must name the parameters or initial values "
            "that differ between the samples");
  EXPECT_EQ(errorOf(rotorScene("    seed: 3\n")),
            "test.yaml: systems.rotor.seed: needs a spread, from which the samples are drawn");
  EXPECT_EQ(
      errorOf(rotorScene("    count: 10\n    spread: {stifness: {half_width: 0.1}}\n")),
      "test.yaml: systems.rotor.spread.stifness: unknown parameter of jeffcott_rotor; did you "
      "mean 'stiffness'?");
  EXPECT_EQ(errorOf(rotorScene("    count: 10\n    spread: {initial.z: {half_width: 0.1}}\n")),
            "test.yaml: systems.rotor.spread.initial.z: unknown coordinate of jeffcott_rotor; did "
            "you mean 'initial.x'?");
  EXPECT_EQ(errorOf(rotorScene("    count: 10\n    spread: {mass: {}}\n")),
            "test.yaml: systems.rotor.spread.mass: must have one of standard_deviation, "
            "half_width, relative_standard_deviation, relative_half_width, found none");
  EXPECT_EQ(errorOf(rotorScene("    count: 10\n    spread: {bow: {relative_half_width: 0.1}}\n")),
            "test.yaml: systems.rotor.spread.bow.relative_half_width: is relative, but the value "
            "is 0: give the width in m");
  EXPECT_EQ(errorOf(rotorScene(
                "    count: 9\n    spread: {stiffness: {relative_half_width: 1.0e305}}\n")),
            "test.yaml: systems.rotor.spread.stiffness.relative_half_width: exceeds the range of a "
            "double");
  EXPECT_EQ(errorsOf(rotorScene("    count: 0\n    seed: -1\n    spread: 3\n")).size(), 3u);
  EXPECT_EQ(errorOf(rotorScene("    count: 4\n    spread: {mass: {half_width: -1}}\n")),
            "test.yaml: systems.rotor.spread.mass.half_width: must be > 0 kg, found -1");
  EXPECT_EQ(
      errorOf(rotorScene("    count: 4\n    spread: {initial.x_rate: {standard_deviation: 0}}\n")),
      "test.yaml: systems.rotor.spread.initial.x_rate.standard_deviation: must be > 0 m/s, "
      "found 0");
  EXPECT_EQ(errorOf(rotorScene("    count: 4\n    spread: {damping: {half_width: 1, "
                               "standard_deviation: 1}}\n")),
            "test.yaml: systems.rotor.spread.damping: must have one of standard_deviation, "
            "half_width, relative_standard_deviation, relative_half_width, found several");
}

TEST(EnsembleDraw, MembersDependOnTheSeedAndTheirNumberOnly) {
  const auto drawn = [](const std::string& count, const std::string& seed, std::size_t index) {
    const Scene scene = sceneOf(rotorScene("    count: " + count + "\n    seed: " + seed +
                                           "\n    spread: {mass: {half_width: 0.5}}\n"));
    return drawnMember(scene.systems[0], *findModel("jeffcott_rotor"), index).values[0];
  };
  EXPECT_EQ(drawn("10", "1", 7), drawn("1000", "1", 7));
  EXPECT_NE(drawn("10", "1", 7), drawn("10", "1", 8));
  EXPECT_NE(drawn("10", "1", 7), drawn("10", "2", 7));
  // The same on every machine: the engine is the standard's, the distribution Boost's.
  EXPECT_DOUBLE_EQ(drawn("10", "1", 0), 0.5395535586382264);
}

// Of 20000 draws the mean is off by 1/140 of the standard deviation, which itself is known to
// 1/200: five times that.
TEST(EnsembleDraw, HasTheMeanAndWidthAskedFor) {
  const Scene scene = sceneOf(rotorScene(R"(
    count: 20000
    spread: {stiffness: {standard_deviation: 500}, damping: {relative_half_width: 0.3}})"));
  std::vector<double> stiffness;
  std::vector<double> damping;
  for (std::size_t i = 0; i < 20000; ++i) {
    const DrawnMember member = drawnMember(scene.systems[0], *findModel("jeffcott_rotor"), i);
    stiffness.push_back(member.spec.parameters.at("stiffness"));
    damping.push_back(member.spec.parameters.at("damping"));
    ASSERT_EQ(member.values, (std::vector<double>{stiffness.back(), damping.back()}));
    ASSERT_EQ(member.spec.parameters.at("stiffness_y"), stiffness.back()) << "goes with it";
    ASSERT_EQ(member.spec.ensemble.count, 0u);
  }
  const auto moments = [](const std::vector<double>& values) {
    double mean = 0.0;
    double square = 0.0;
    for (const double x : values) {
      mean += x / 20000.0;
    }
    for (const double x : values) {
      square += (x - mean) * (x - mean) / 19999.0;
    }
    return std::pair(mean, std::sqrt(square));
  };
  const auto [k_mean, k_deviation] = moments(stiffness);
  EXPECT_NEAR(k_mean, 1.0e4, 5.0 * 500.0 / 140.0);
  EXPECT_NEAR(k_deviation, 500.0, 5.0 * 500.0 / 200.0);
  const auto [c_mean, c_deviation] = moments(damping);
  EXPECT_NEAR(c_mean, 10.0, 5.0 * 1.73 / 140.0);
  EXPECT_NEAR(c_deviation, 3.0 / std::sqrt(3.0), 5.0 * 1.73 / 200.0);
  EXPECT_GE(*std::min_element(damping.begin(), damping.end()), 7.0);
  EXPECT_LE(*std::max_element(damping.begin(), damping.end()), 13.0);
}

// Of 20000 draws a correlation r is off by (1 - r^2)/141 of itself: five times that.
TEST(EnsembleDraw, HasTheCorrelationsAskedFor) {
  const Scene scene = sceneOf(rotorScene(R"(
    count: 20000
    spread:
      stiffness: {standard_deviation: 500}
      mass: {standard_deviation: 0.05}
      damping: {standard_deviation: 0.5}
      eccentricity: {half_width: 1.0e-5}
      initial.x: {standard_deviation: 1.0e-4}
      correlations:
        - [mass, stiffness, 0.95]
        - [damping, stiffness, -0.3]
        - [initial.x, stiffness, -0.3]
        - [damping, initial.x, 1])"));
  constexpr int kDraws = 20000;
  Eigen::MatrixXd draws(kDraws, 5);
  for (int i = 0; i < kDraws; ++i) {
    const std::vector<double> values =
        drawnMember(scene.systems[0], *findModel("jeffcott_rotor"), static_cast<std::size_t>(i))
            .values;
    draws.row(i) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), 5);
  }
  draws.rowwise() -= draws.colwise().mean().eval();
  const Eigen::RowVectorXd widths = (draws.colwise().squaredNorm() / kDraws).cwiseSqrt();
  EXPECT_NEAR(widths[0], 500.0, 5.0 * 500.0 / 200.0);
  EXPECT_NEAR(widths[2], 0.5, 5.0 * 0.5 / 200.0);
  draws.array().rowwise() /= widths.array();
  const Eigen::MatrixXd r = draws.transpose() * draws / kDraws;
  EXPECT_NEAR(r(0, 1), 0.95, 5.0 * 0.0975 / 141.0);
  EXPECT_NEAR(r(0, 2), -0.3, 5.0 * 0.91 / 141.0);
  EXPECT_NEAR(r(2, 4), 1.0, 1.0e-12);
  EXPECT_NEAR(r(0, 4), -0.3, 5.0 * 0.91 / 141.0);
  EXPECT_NEAR(r(0, 3), 0.0, 5.0 / 141.0);
  EXPECT_NEAR(r(1, 3), 0.0, 5.0 / 141.0);
}

TEST(EnsembleScene, RefusesCorrelationsThatCannotBe) {
  const auto inputError = [](const std::string& correlations) {
    return errorOf(rotorScene(
        "    count: 4\n    spread:\n      stiffness: {standard_deviation: 1}\n      mass: "
        "{standard_deviation: 0.1}\n      damping: {standard_deviation: 0.1}\n      eccentricity: "
        "{half_width: 1.0e-5}\n      correlations: " +
        correlations + "\n"));
  };
  const std::string key = "test.yaml: systems.rotor.spread.correlations";
  EXPECT_EQ(inputError("0.5"),
            key + ": must be a list of [parameter, other parameter, correlation], found 0.5");
  EXPECT_EQ(inputError("[[mass, stiffness]]"),
            key + "[0]: must be [parameter, other parameter, correlation from -1 to 1]");
  EXPECT_EQ(inputError("[[mass, stiffness, 1.01]]"),
            key + "[0]: must be [parameter, other parameter, correlation from -1 to 1]");
  EXPECT_EQ(inputError("[[mass, stifness, 0.5]]"),
            key +
                "[0]: must be parameters with a spread, found 'stifness'; did you mean "
                "'stiffness'?");
  EXPECT_EQ(inputError("[[mass, eccentricity, 0.5]]"),
            key +
                "[0]: correlations need normal distributions (standard_deviation); 'eccentricity' "
                "is uniform");
  EXPECT_EQ(inputError("[[mass, mass, 0.5]]"),
            key + "[0]: the correlation of 'mass' and 'mass' is 1");
  EXPECT_EQ(inputError("[[mass, stiffness, 0.5], [stiffness, mass, 0.5]]"),
            key + "[1]: the correlation of 'stiffness' and 'mass' is given twice");
  EXPECT_EQ(
      inputError("[[mass, stiffness, 0.9], [mass, damping, 0.9], [damping, stiffness, -0.9]]"),
      key + ": the correlation matrix must be positive semidefinite, found an eigenvalue of -0.8");
}

TEST(EnsembleDraw, StaysInRange) {
  const Scene scene = sceneOf(rotorScene(R"(
    count: 500
    spread: {eccentricity: {standard_deviation: 5.0e-4}, damping_y: {half_width: 5}})"));
  for (std::size_t i = 0; i < 500; ++i) {
    const DrawnMember member = drawnMember(scene.systems[0], *findModel("jeffcott_rotor"), i);
    ASSERT_GE(member.spec.parameters.at("eccentricity"), 0.0);
    ASSERT_EQ(member.spec.parameters.at("damping"), 10.0) << "damping_y has a spread of its own";
  }
}

// The rotors, and the pendulums with an explicit method, are batched in SIMD vectors, the pendulums
// with an implicit one are stepped individually; a sample of either equals the same system alone.
TEST(Ensemble, MembersAreTheSystemsTheyWouldBeAlone) {
  const Scene rotors = sceneOf(rotorScene(R"(
    count: 13
    spread: {stiffness: {relative_half_width: 0.2}, initial.x: {half_width: 1.0e-4}})"));
  const Scene pendulums = sceneOf(pendulumScene(R"(
    count: 3
    spread: {mass1: {relative_standard_deviation: 0.2}, initial.theta2_rate: {half_width: 1}})"));
  const Scene many_pendulums = sceneOf(pendulumScene(R"(
    count: 13
    spread: {mass1: {relative_standard_deviation: 0.2}, initial.theta2_rate: {half_width: 1}})",
                                                     "runge_kutta_4"));
  for (const Scene& scene : {rotors, pendulums, many_pendulums}) {
    Twin twin(scene);
    twin.buildEnsembles();
    const std::size_t count = twin.ensemble(0)->count();
    EXPECT_STREQ(twin.ensemble(0)->steps().description(),
                 count == 13 ? "side by side in vectors" : "one by one");
    const std::size_t quantities = twin.ensemble(0)->quantities().size();
    for (int i = 0; i < 700; ++i) {
      twin.step();
    }
    const std::vector<double> record = recordOf(twin);
    for (std::size_t k = 0; k < count; ++k) {
      Scene single = scene;
      single.systems[0] = drawnMember(scene.systems[0], *twin.systems()[0]->model, k).spec;
      Twin alone(single);
      Observer observer(alone);
      std::vector<double> state(alone.layout().size);
      std::vector<double> peak(quantities, 0.0);
      const auto value = [&](std::size_t quantity) {
        return quantities == 1 ? observer.whirlRadius(0) : observer.coordinates(0)[quantity];
      };
      for (int i = 0; i <= 700; ++i) {
        if (i > 0) {
          alone.step();
        }
        alone.write(state.data());
        observer.observe(state.data());
        for (std::size_t j = 0; j < quantities; ++j) {
          peak[j] = std::max(peak[j], std::fabs(value(j)));
        }
      }
      for (std::size_t j = 0; j < quantities; ++j) {
        const double* const at = record.data() + 1 + k * quantities + j;
        EXPECT_NEAR(at[0], value(j), 1.0e-11 * peak[j]) << k;
        EXPECT_NEAR(at[count * quantities], peak[j], 1.0e-11 * peak[j]) << k;
      }
    }
  }
}

// From rest a linear rotor's whirl is proportional to its eccentricity, so statistics of the one
// are those of the other.
TEST(Ensemble, StatisticsOfTheWhirlAreThoseOfItsCause) {
  Twin twin(sceneOf(rotorScene(R"(
    count: 401
    spread: {eccentricity: {standard_deviation: 2.0e-5}})")));
  twin.buildEnsembles();
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  double peak = 0.0;
  for (int i = 0; i < 500; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
    peak = std::max(peak, observer.whirlRadius(0));
  }
  std::vector<double> eccentricities;
  for (std::size_t i = 0; i < 401; ++i) {
    eccentricities.push_back(twin.ensemble(0)->drawn(i)[0]);
  }
  std::sort(eccentricities.begin(), eccentricities.end());
  const state::EnsembleState s = ensembleStatistics(*twin.ensemble(0), recordOf(twin).data());
  EXPECT_EQ(s.at.step, 500);
  EXPECT_EQ(s.count, 401);
  EXPECT_EQ(s.running, 401);
  EXPECT_EQ(s.quantity, std::vector<std::string>{"radius"});
  EXPECT_EQ(s.unit, std::vector<std::string>{"m"});
  const double per_eccentricity = observer.whirlRadius(0) / 1.0e-4;
  const auto expect = [&](double found, double eccentricity) {
    EXPECT_NEAR(found, per_eccentricity * eccentricity, 1.0e-10 * per_eccentricity * 1.0e-4);
  };
  expect(s.smallest[0], eccentricities.front());
  expect(s.percentile_5[0], eccentricities[20]);
  expect(s.percentile_25[0], eccentricities[100]);
  expect(s.median[0], eccentricities[200]);
  expect(s.percentile_75[0], eccentricities[300]);
  expect(s.percentile_95[0], eccentricities[380]);
  expect(s.largest[0], eccentricities.back());
  EXPECT_NEAR(s.peak_median[0], peak * eccentricities[200] / 1.0e-4, 1.0e-10 * peak);
  EXPECT_NEAR(s.peak_largest[0], peak * eccentricities[400] / 1.0e-4, 1.0e-10 * peak);
  EXPECT_NEAR(s.standard_deviation[0] / s.mean[0], s.peak_standard_deviation[0] / s.peak_mean[0],
              1.0e-10);
}

TEST(Ensemble, PercentilesLieBetweenTheValues) {
  EXPECT_EQ(percentile({1.0, 2.0, 4.0, 8.0}, 0.0), 1.0);
  EXPECT_EQ(percentile({1.0, 2.0, 4.0, 8.0}, 50.0), 3.0);
  EXPECT_EQ(percentile({1.0, 2.0, 4.0, 8.0}, 75.0), 5.0);
  EXPECT_EQ(percentile({1.0, 2.0, 4.0, 8.0}, 100.0), 8.0);
  EXPECT_EQ(percentile({3.0}, 95.0), 3.0);
  EXPECT_TRUE(std::isnan(percentile({}, 50.0)));
}

// A linear rotor under gravity whirls about its equilibrium like one without gravity: batched (13
// of one disc), and individually (a mesh on unlike springs).
TEST(Ensemble, WhirlIsAboutWhereEachMemberRests) {
  const auto disc = [](const std::string& gravity) {
    return gravity + rotorScene(R"(
    count: 13
    spread: {stiffness: {relative_half_width: 0.2}, eccentricity: {half_width: 2.0e-5}})");
  };
  const auto mesh = [](const std::string& gravity) {
    return gravity + R"(
step: 0.001
systems:
  rotor:
    model: flexible_rotor
    parameters:
      youngs_modulus: 2.1e+11
      density: 7800
      elements: [{length: 0.25, outer_diameter: 0.04, count: 4}]
      speed: 80
      discs: [{node: 2, mass: 10, polar_inertia: 0.1, transverse_inertia: 0.06}]
      unbalances: [{node: 2, magnitude: 1.0e-4}]
      bearings:
        - {node: 0, kxx: 2.0e+6, kyy: 5.0e+6, cxx: 300}
        - {node: 4, kxx: 2.0e+6, kyy: 5.0e+6, cxx: 300}
    count: 5
    spread: {"bearings[0].kyy": {relative_half_width: 0.3}}
)";
  };
  for (const bool meshed : {false, true}) {
    const auto scene = [&](const std::string& gravity, const std::string& falls) {
      std::string text = meshed ? mesh(gravity) : disc(gravity);
      const std::string key = meshed ? "speed: 80" : "eccentricity: 1.0e-4";
      return text.replace(text.find(key), key.size(),
                          key + (meshed ? "\n      " : ", ") + "gravity_on_shaft: " + falls);
    };
    Twin hanging(sceneOf(scene("gravity: 9.81\n", "true")));
    Twin weightless(sceneOf(scene("", "false")));
    hanging.buildEnsembles();
    weightless.buildEnsembles();
    EXPECT_STREQ(hanging.ensemble(0)->steps().description(),
                 meshed ? "one by one" : "side by side in vectors");
    for (int i = 0; i < 400; ++i) {
      hanging.step();
      weightless.step();
    }
    const std::vector<double> one = recordOf(hanging), other = recordOf(weightless);
    ASSERT_EQ(one.size(), other.size());
    const double largest = *std::max_element(other.begin() + 1, other.end());
    // Weightless ones start at rest on the axis, as the hanging ones do where they hang.
    for (std::size_t k = 1; k < one.size(); ++k) {
      EXPECT_NEAR(one[k], other[k], 1.0e-9 * largest) << meshed << ' ' << k;
    }
    EXPECT_GT(hanging.ensemble(0)->rest().norm(), largest) << "the sag is the larger one";
  }
}

// semi_implicit_euler is unstable where p h > 2: above 4e6 N/m here. Those samples diverge, one
// after the other, and no others.
TEST(Ensemble, AMemberThatRunsAwayStopsAlone) {
  Twin twin(sceneOf(R"(
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    integrator: semi_implicit_euler
    parameters: {mass: 1, stiffness: 3.9e6, damping: 0, eccentricity: 1.0e-4, speed: 50}
    count: 40
    spread: {stiffness: {half_width: 3.0e5}}
)"));
  twin.buildEnsembles();
  std::int64_t sound = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    sound += twin.ensemble(0)->drawn(i)[0] < 4.0e6 ? 1 : 0;
  }
  ASSERT_GT(sound, 10);
  ASSERT_LT(sound, 35);
  for (int i = 0; i < 60000; ++i) {
    twin.step();
  }
  const state::EnsembleState s = ensembleStatistics(*twin.ensemble(0), recordOf(twin).data());
  EXPECT_EQ(s.running, sound);
  EXPECT_TRUE(std::isfinite(s.largest[0]));
  EXPECT_TRUE(std::isfinite(s.peak_largest[0]));
}

TEST(Ensemble, IsPublishedFiftyTimesASecond) {
  Running running(
      sceneOf(rotorScene("    count: 20\n    spread: {mass: {relative_half_width: 0.1}}\n")));
  EnsembleObserver ensembles = running.live.ensembles();
  EXPECT_EQ(ensembles.systems(), std::vector<std::size_t>{0});
  std::vector<std::int64_t> steps;
  state::EnsembleState s;
  running.cycle(5);
  for (int i = 0; i < 100; ++i) {
    running.cycle();
    if (ensembles.take(0, {10, 0.01, 500}, s)) {
      steps.push_back(s.at.step);
      EXPECT_EQ(s.system, "rotor");
      EXPECT_DOUBLE_EQ(s.at.time, 0.001 * static_cast<double>(s.at.step));
      EXPECT_EQ(s.at.stamp, 500 + (s.at.step - 10) * 1000000);
    }
  }
  EXPECT_EQ(steps, (std::vector<std::int64_t>{0, 20, 40, 60, 80, 100}));
  running.live.send({TwinCommand::Kind::kReset});
  running.cycle();
  ASSERT_TRUE(ensembles.take(0, {0, 0.0, 0}, s));
  EXPECT_EQ(s.at.step, 0);
  EXPECT_EQ(s.largest[0], 0.0);
}

TEST(Ensemble, StepsAndTellsWithoutAllocating) {
  for (const std::string& scene :
       {rotorScene("    count: 20\n    spread: {mass: {relative_half_width: 0.1}}\n"),
        pendulumScene("    count: 5\n    spread: {mass1: {relative_half_width: 0.1}}\n")}) {
    Twin twin(sceneOf(scene));
    twin.buildEnsembles();
    const AllocationGuard guard;
    for (int i = 0; i < 50; ++i) {  // publishes at 20 and 40
      twin.step();
    }
    twin.reset();
    EXPECT_EQ(guard.allocations(), 0u);
  }
}

// A radius whose square exceeds the range of a double counts as diverged.
TEST(Ensemble, ARotorThatRunsAwayBesideOthersStopsAlone) {
  Twin twin(sceneOf(rotorScene(R"(
    count: 30
    initial: {x: 1.0e154}
    spread: {initial.x: {half_width: 1.0e154}})")));
  twin.buildEnsembles();
  std::int64_t sound = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    const double x = twin.ensemble(0)->drawn(i)[0];
    sound += std::isfinite(x * x) ? 1 : 0;
  }
  ASSERT_GT(sound, 5);
  ASSERT_LT(sound, 30);
  const state::EnsembleState s = ensembleStatistics(*twin.ensemble(0), recordOf(twin).data());
  EXPECT_EQ(s.running, sound);
  EXPECT_LT(s.largest[0], 1.35e154);
}

TEST(Ensemble, SpeedsItIsNotPreparedForAreRefused) {
  const std::string spread = "    count: 4\n    spread: {mass: {relative_half_width: 0.1}}\n";
  Running isotropic(sceneOf(rotorScene(spread)));
  EXPECT_EQ(isotropic.parameters.speedDiagnostic(0, 400.0), "");
  EXPECT_NE(isotropic.parameters.speedDiagnostic(0, 2.0e4), "");
  std::string damped = rotorScene(spread);
  damped.replace(damped.find("damping: 10"), 11, "damping: 10, internal_damping: 1");
  Running dependent(sceneOf(damped));
  EXPECT_EQ(dependent.parameters.speedDiagnostic(0, 150.0), "");
  EXPECT_EQ(dependent.parameters.speedDiagnostic(0, 151.0),
            "speed: must be from 0 to 150 rad/s, the range prepared for the ensemble of rotor, "
            "found 151");
}

TEST(Ensemble, AMemberOfAnotherKindIsNamed) {
  Twin twin(sceneOf(rotorScene(R"(
    integrator: gauss_legendre_6
    count: 40
    spread:
      bearing_length: {half_width: 0.01}
      bearing_diameter: {half_width: 0.01}
      bearing_clearance: {half_width: 1.0e-4}
      bearing_viscosity: {half_width: 0.01}
      journal_mass: {half_width: 0.1})")));
  try {
    twin.buildEnsembles();
    FAIL() << "rotors in journal bearings among those on rigid ones";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("other coordinates than the nominal system"),
              std::string::npos)
        << error.what();
  }
}

TEST(Ensemble, ItsParametersAreNotChangedWhileItRuns) {
  Running running(
      sceneOf(rotorScene("    count: 20\n    spread: {mass: {relative_half_width: 0.1}}\n")));
  const ParameterAnswer answer = running.parameters.set({"rotor", {"damping"}, {20.0}, 0.0});
  EXPECT_FALSE(answer.done);
  EXPECT_NE(answer.message.find("drawn at the start"), std::string::npos) << answer.message;
}

TEST(Ensemble, MembersThatDoNotFitTogetherAreNamed) {
  Twin twin(sceneOf(rotorScene(R"(
    count: 50
    spread: {rub_clearance: {half_width: 1.0e-3}})")));
  try {
    twin.buildEnsembles();
    FAIL() << "a clearance without a stator";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("systems.rotor.spread: sample 0: "), std::string::npos)
        << error.what();
  }
}

}  // namespace ensemble_test
}  // namespace whirl_twin
