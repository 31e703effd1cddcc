// Parameters from simulated measurements: the true values are recovered, with valid standard
// deviations, and parameters that the runs do not identify are reported.
#include "estimation/shooting_fit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "estimation/window_motion.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace shooting_fit_test {

constexpr double kInterval = 0.004;  // s

Scene sceneOf(const std::string& system) {
  return readScene(YAML::Load("{name: rig, step: 0.001, systems: {arm: " + system + "}}"), "test");
}

struct Truth {
  std::string scene;
  std::vector<double> start;  ///< coordinates, then rates
  double seconds = 4.0;
  double noise = 0.0;                         ///< [rad]
  std::function<double(double)> torque = {};  ///< on the first input
};

/// A run of the scene as a rig would record it, stepped by another method than the fit's.
StudyRun recorded(const Truth& truth, const std::string& file, std::uint32_t seed) {
  Scene scene = sceneOf(truth.scene);
  scene.systems.front().integrator = "dormand_prince_8";
  FitStudy study;
  study.scene = scene;
  const SharedSystem system = build(scene).systems.front();
  StudyRun run;
  run.file = file;
  run.train = true;
  const auto rows = static_cast<std::size_t>(truth.seconds / kInterval);
  for (std::size_t k = 0; k <= rows; ++k) {
    run.data.time.push_back(kInterval * static_cast<double>(k));
  }
  const auto coordinates = system->dynamics->coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    run.data.columns.push_back({coordinates[i].name, std::vector<double>(rows + 1)});
    MeasuredChannel channel;
    channel.name = channel.column = coordinates[i].name;
    channel.state = i;
    channel.unit = coordinates[i].unit;
    run.measured.push_back(channel);
  }
  if (truth.torque) {
    std::vector<double> acted;
    for (const double t : run.data.time) {
      acted.push_back(truth.torque(t));
    }
    MeasuredInput input;
    input.name = input.column = system->dynamics->inputs().front().name;
    run.inputs.push_back(input);
    run.data.columns.push_back({input.column, acted});
  }
  study.runs = {run};
  const CandidateMaker maker(study);
  Eigen::MatrixXd states;
  const Eigen::Map<const Eigen::VectorXd> start(truth.start.data(),
                                                static_cast<Eigen::Index>(truth.start.size()));
  EXPECT_TRUE(predict(study, maker.scene(), maker.at({}), {0, 0, rows + 1}, start, states));
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    for (std::size_t k = 0; k <= rows; ++k) {
      run.data.columns[i].values[k] =
          states(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) +
          truth.noise * noise(random);
    }
  }
  return run;
}

FitStudy studyOf(const std::string& scene, std::vector<StudyRun> runs,
                 const std::vector<std::string>& paths) {
  FitStudy study;
  study.source = "study.yaml";
  study.scene = sceneOf(scene);
  study.system = "arm";
  study.runs = std::move(runs);
  const SharedSystem system = build(study.scene).systems.front();
  for (const std::string& path : paths) {
    study.fit.push_back({path, system->parameter(path).value()});
  }
  return study;
}

ShootingFit fitted(const FitStudy& study) {
  return fitByShooting(study, [](int, int) {});
}

double found(const ShootingFit& fit, const std::string& name) {
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    if (fit.unknowns[i].name == name) {
      return fit.theta[static_cast<Eigen::Index>(i)];
    }
  }
  ADD_FAILURE() << name;
  return 0.0;
}

const char* const kDouble =
    "{model: double_pendulum, integrator: runge_kutta_4, parameters: {mass1: 0.1, mass2: 0.14, "
    "length1: 0.17, length2: 0.24, center1: 0.11, center2: 0.12, inertia1: 4.4e-4, inertia2: "
    "1.3e-3, damping1: 4.0e-5, coulomb1: 3.0e-4, coulomb2: 1.0e-4}, initial: {theta1: 0.1}}";
const char* const kDoubleGuessed =
    "{model: double_pendulum, integrator: runge_kutta_4, parameters: {mass1: 0.1, mass2: 0.14, "
    "length1: 0.17, length2: 0.24, center1: 0.09, center2: 0.12, inertia1: 6.0e-4, inertia2: "
    "1.0e-3, damping1: 1.0e-4, coulomb1: 1.0e-4, coulomb2: 3.0e-4}, initial: {theta1: 0.1}}";

TEST(ShootingFit, FindsADoublePendulum) {
  std::vector<StudyRun> runs = {recorded({kDouble, {0.9, -0.4, 0.0, 3.0}, 3.0}, "a", 1),
                                recorded({kDouble, {-0.5, 0.7, 2.0, 0.0}, 3.0}, "b", 1)};
  runs.push_back(recorded({kDouble, {0.3, 0.3, -1.0, 4.0}, 3.0}, "left out", 1));
  runs.back().train = false;
  FitStudy study = studyOf(kDoubleGuessed, runs,
                           {"center1", "inertia1", "inertia2", "damping1", "coulomb1", "coulomb2"});
  for (const double window : {0.5, std::numeric_limits<double>::infinity()}) {
    study.window = window;
    const ShootingFit fit = fitted(study);
    EXPECT_TRUE(fit.converged);
    // The remaining difference is the error of the fit's method where friction changes its sign.
    EXPECT_NEAR(found(fit, "center1"), 0.11, 1e-6);
    EXPECT_NEAR(found(fit, "inertia1"), 4.4e-4, 2e-8);
    EXPECT_NEAR(found(fit, "inertia2"), 1.3e-3, 2e-8);
    EXPECT_NEAR(found(fit, "damping1"), 4.0e-5, 2e-8);
    EXPECT_NEAR(found(fit, "coulomb1"), 3.0e-4, 1e-7);
    EXPECT_NEAR(found(fit, "coulomb2"), 1.0e-4, 1e-7);
    EXPECT_TRUE(fit.information.unidentifiable.empty());
    for (const FittedRun& run : fit.runs) {
      EXPECT_LT(run.rms[0], 1e-6);
      EXPECT_LT(run.rms[1], 1e-6);
    }
  }
}

std::string pendulum(double mass, double inertia, double damping, double coulomb) {
  return fmt::format(
      "{{model: pendulum, integrator: runge_kutta_4, parameters: {{mass: {}, length: 0.5, inertia: "
      "{}, damping: {}, coulomb: {}}}, initial: {{theta: 0.1}}}}",
      mass, inertia, damping, coulomb);
}

double torque(double t) {
  return 0.8 * std::sin(2.1 * t) + 0.5 * std::cos(5.3 * t);
}

TEST(ShootingFit, FindsZeroScaleAndDelayOfSensors) {
  StudyRun run = recorded({pendulum(0.7, 0.02, 0.03, 0.05), {0.4, 0.0}, 8.0, 0.0, torque}, "a", 1);
  // The record has half of the torque plus 0.1 N m, 12 ms late; the angle is off by 0.02 rad.
  for (std::size_t k = 0; k < run.data.time.size(); ++k) {
    run.data.columns[1].values[k] = 0.5 * torque(run.data.time[k] - 0.012) + 0.1;
    run.data.columns[0].values[k] += 0.02;
  }
  run.measured[0].offset.fitted = true;
  run.inputs[0].scale.fitted = run.inputs[0].offset.fitted = run.inputs[0].delay.fitted = true;
  // With the weight known the torque has a scale.
  const FitStudy study =
      studyOf(pendulum(0.7, 0.05, 0.01, 0.01), {run}, {"inertia", "damping", "coulomb"});
  const ShootingFit fit = fitted(study);
  EXPECT_NEAR(found(fit, "inertia"), 0.02, 2e-4);
  EXPECT_NEAR(found(fit, "damping"), 0.03, 1e-3);
  EXPECT_NEAR(found(fit, "coulomb"), 0.05, 1e-3);
  EXPECT_NEAR(found(fit, "theta.offset"), 0.02, 1e-4);
  EXPECT_NEAR(found(fit, "torque.scale"), 2.0, 2e-3);
  EXPECT_NEAR(found(fit, "torque.offset"), -0.2, 1e-3);
  EXPECT_NEAR(found(fit, "torque.delay"), -0.012, 2e-4);
}

/// An encoder zeroed where a dry joint happens to stick has a different zero offset in each run: a
/// common one is wrong, and so are then the parameters; a run left out of the fit has its own, too.
TEST(ShootingFit, FindsAZeroOfEachRun) {
  const double zeros[] = {0.03, -0.05, 0.04};
  std::vector<StudyRun> runs;
  for (const double zero : zeros) {
    runs.push_back(recorded({pendulum(0.7, 0.02, 0.03, 0.05), {0.4 - zero, 0.0}, 5.0, 0.0, torque},
                            "run " + std::to_string(runs.size() + 1), 1));
    for (double& angle : runs.back().data.columns[0].values) {
      angle += zero;
    }
    runs.back().measured[0].offset.fitted = runs.back().measured[0].offset.each_run = true;
  }
  runs[2].train = false;
  FitStudy study =
      studyOf(pendulum(0.7, 0.05, 0.01, 0.01), runs, {"inertia", "damping", "coulomb"});
  const ShootingFit fit = fitted(study);
  EXPECT_NEAR(found(fit, "inertia"), 0.02, 1e-6);
  EXPECT_NEAR(found(fit, "coulomb"), 0.05, 1e-6);
  EXPECT_NEAR(found(fit, "theta.offset of run 1"), zeros[0], 1e-6);
  EXPECT_NEAR(found(fit, "theta.offset of run 2"), zeros[1], 1e-6);
  ASSERT_EQ(fit.runs[2].own.size(), 1u);
  EXPECT_EQ(fit.runs[2].own[0].first.name, "theta.offset of run 3");
  EXPECT_NEAR(fit.runs[2].own[0].second, zeros[2], 1e-6);
  EXPECT_LT(fit.runs[2].rms[0], 1e-6);
  EXPECT_EQ(fit.unknowns.size(), 5u);
  // One zero for all is far off.
  for (StudyRun& run : study.runs) {
    run.measured[0].offset.each_run = false;
  }
  const ShootingFit shared = fitted(study);
  EXPECT_GT(shared.runs[0].rms[0], 0.01);
  EXPECT_TRUE(shared.runs[2].own.empty());
}

/// A free swing does not identify a mass: all parameters may be scaled by a common factor.
TEST(ShootingFit, SaysWhatASwingDoesNotTell) {
  const StudyRun run = recorded({pendulum(0.7, 0.02, 0.03, 0.0), {1.0, 0.0}, 6.0, 1.0e-4}, "a", 1);
  const FitStudy study =
      studyOf(pendulum(1.0, 0.03, 0.02, 0.0), {run}, {"mass", "inertia", "damping"});
  const ShootingFit fit = fitted(study);
  ASSERT_EQ(fit.information.unidentifiable.size(), 1u);
  // All change by the same factor.
  const Eigen::Vector3d start(1.0, 0.03, 0.02);
  const Eigen::Vector3d sizes = fit.theta.cwiseMax(start);
  const Eigen::Vector3d changes =
      fit.information.unidentifiable.front().parts.cwiseProduct(sizes).cwiseQuotient(fit.theta);
  EXPECT_NEAR(changes[1] / changes[0], 1.0, 0.02);
  EXPECT_NEAR(changes[2] / changes[0], 1.0, 0.02);
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isnan(fit.information.deviation[i]));
  }
  // The identifiable ratios are right.
  EXPECT_NEAR(found(fit, "inertia") / found(fit, "mass"), 0.02 / 0.7, 1e-4);
  EXPECT_NEAR(found(fit, "damping") / found(fit, "mass"), 0.03 / 0.7, 1e-4);
  // Along the rest the times that some have grown are about those that others have shrunk.
  EXPECT_NEAR(fit.theta.cwiseQuotient(start).prod(), 1.0, 0.2);
}

/// A free swing does not depend on the mass at all: what rounding makes of one is no effect.
TEST(ShootingFit, WhatHasNoEffectStaysWhereItStarts) {
  const StudyRun run = recorded({pendulum(0.7, 0.0, 0.0, 0.0), {1.0, 0.0}, 4.0, 1.0e-3}, "a", 1);
  for (const bool with_length : {false, true}) {
    std::vector<std::string> names{"mass"};
    if (with_length) {
      names.push_back("length");
    }
    const ShootingFit fit = fitted(studyOf(pendulum(0.6, 0.0, 0.0, 0.0), {run}, names));
    EXPECT_NEAR(found(fit, "mass"), 0.6, 1.0e-6);
    EXPECT_TRUE(std::isnan(fit.information.deviation[0]));
    if (with_length) {
      EXPECT_NEAR(found(fit, "length"), 0.5, 3.0e-4);
      EXPECT_GT(fit.information.deviation[1], 2.0e-5);
      EXPECT_LT(fit.information.deviation[1], 1.0e-4);
    }
  }
}

/// Its weight is balanced by a torque while it moves slowly, at a constant rate: that identifies
/// the ratio of weight to torque scale, and the encoder's zero offset, but neither inertia nor
/// friction. Unidentifiable parameters stay at any start value, and so do those that are
/// identifiable only in combination with them, up to the identified combination.
TEST(ShootingFit, ABalancedPendulumKeepsWhatItDoesNotTell) {
  constexpr double kWeight = 0.7 * 0.5 * 9.81;  // N m
  constexpr double kZero = 0.05;                // rad
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  StudyRun run;
  run.file = "held";
  run.train = true;
  run.data.columns = {{"theta", {}}, {"torque", {}}};
  for (int k = 0; k < 1000; ++k) {
    const double theta = -0.8 + 0.4 * kInterval * k;
    run.data.time.push_back(kInterval * k);
    run.data.columns[0].values.push_back(theta + kZero + 1.0e-3 * noise(random));
    run.data.columns[1].values.push_back(kWeight * std::sin(theta));
  }
  MeasuredChannel channel;
  channel.name = channel.column = "theta";
  channel.unit = "rad";
  channel.offset.fitted = true;
  run.measured = {channel};
  MeasuredInput input;
  input.name = input.column = "torque";
  input.scale.fitted = true;
  input.hold = true;
  run.inputs = {input};
  std::uniform_real_distribution<double> part(0.5, 2.0);
  for (int k = 0; k < 4; ++k) {
    const double mass = 0.7 * part(random), inertia = 0.02 * part(random),
                 damping = 0.01 * part(random), coulomb = 0.01 * part(random);
    const FitStudy study = studyOf(pendulum(mass, inertia, damping, coulomb), {run},
                                   {"mass", "inertia", "damping", "coulomb"});
    const ShootingFit fit = fitted(study);
    const std::string where =
        fmt::format("from {} kg, {} kg m^2, {} N m s, {} N m", mass, inertia, damping, coulomb);
    EXPECT_TRUE(fit.converged) << where;
    EXPECT_NEAR(found(fit, "inertia"), inertia, 0.1 * inertia) << where;
    EXPECT_NEAR(found(fit, "theta.offset"), kZero, 0.02) << where;
    EXPECT_NEAR(found(fit, "mass") / found(fit, "torque.scale") / 0.7, 1.0, 0.05) << where;
    // No further than for a change of the mass alone.
    EXPECT_LT(std::fabs(std::log(found(fit, "mass") / mass)),
              std::fabs(std::log(0.7 / mass)) + 0.05)
        << where;
    for (Eigen::Index i = 0; i < fit.theta.size(); ++i) {
      const std::string& name = fit.unknowns[static_cast<std::size_t>(i)].name;
      if (name != "theta.offset") {
        EXPECT_TRUE(std::isnan(fit.information.deviation[i])) << name << " " << where;
      }
    }
  }
}

TEST(ShootingFit, TellsCoulombFrictionFromViscous) {
  const StudyRun run = recorded({pendulum(0.7, 0.0, 0.0, 0.05), {1.0, 0.0}, 8.0, 2.0e-4}, "a", 1);
  FitStudy study = studyOf(pendulum(0.7, 0.01, 0.01, 0.0), {run}, {"inertia", "damping"});
  study.window = std::numeric_limits<double>::infinity();
  const double viscous = fitted(study).runs[0].rms[0];
  study.fit.push_back({"coulomb", 0.0, 0.0});
  const ShootingFit both = fitted(study);
  EXPECT_GT(viscous, 10.0 * both.runs[0].rms[0]);
  EXPECT_NEAR(both.runs[0].rms[0], 2.0e-4, 1e-5);
  EXPECT_NEAR(found(both, "coulomb"), 0.05, 3e-4);
}

TEST(ShootingFit, WhatMustNotBeNegativeIsNot) {
  int at_bound = 0;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const StudyRun run =
        recorded({pendulum(0.7, 0.02, 0.0, 0.0), {0.5, 0.0}, 3.0, 2.0e-3}, "a", seed);
    const FitStudy study = studyOf(pendulum(0.7, 0.03, 0.01, 0.0), {run}, {"inertia", "damping"});
    const ShootingFit fit = fitted(study);
    EXPECT_GE(found(fit, "damping"), 0.0);
    at_bound += fit.at_bound[1] ? 1 : 0;
  }
  EXPECT_GE(at_bound, 1);  // half of them, but for the noise
}

/// 95 % intervals hold 95 % of the truths: of 1,000 fits with WHIRL_TWIN_EXTREMES=full.
TEST(ShootingFit, DeviationsHoldWhatTheySay) {
  const char* length = std::getenv("WHIRL_TWIN_EXTREMES");
  const int fits = length != nullptr && std::strcmp(length, "full") == 0 ? 1000 : 40;
  const std::vector<std::pair<std::string, double>> truth = {
      {"mass", 0.7}, {"inertia", 0.02}, {"damping", 0.03}, {"coulomb", 0.05}};
  std::vector<int> held(truth.size());
  for (int k = 0; k < fits; ++k) {
    const StudyRun run =
        recorded({pendulum(0.7, 0.02, 0.03, 0.05), {0.4, 0.0}, 4.0, 1.0e-3, torque}, "a",
                 static_cast<std::uint32_t>(k + 1));
    FitStudy study = studyOf(pendulum(0.75, 0.025, 0.02, 0.04), {run},
                             {"mass", "inertia", "damping", "coulomb"});
    const ShootingFit fit = fitted(study);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double off = found(fit, truth[i].first) - truth[i].second;
      held[i] +=
          std::fabs(off) <= 1.96 * fit.information.deviation[static_cast<Eigen::Index>(i)] ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // The binomial's own three deviations; at 1,000 they are 2 %.
    const double share = static_cast<double>(held[i]) / fits;
    EXPECT_NEAR(share, 0.95, fits == 1000 ? 0.02 : 3.0 * std::sqrt(0.95 * 0.05 / fits))
        << truth[i].first;
  }
}

TEST(ShootingFit, AGrosslyWrongRowMovesNothingWhereResidualsAreRobust) {
  StudyRun run =
      recorded({pendulum(0.7, 0.02, 0.03, 0.0), {0.8, 0.0}, 4.0, 1.0e-4, torque}, "a", 1);
  for (std::size_t k = 50; k < run.data.time.size(); k += 97) {
    run.data.columns[0].values[k] += 0.5;
  }
  FitStudy study = studyOf(pendulum(0.7, 0.03, 0.02, 0.0), {run}, {"inertia", "damping"});
  const double off = std::fabs(found(fitted(study), "inertia") - 0.02);
  study.huber = 3.0e-4;
  EXPECT_NEAR(found(fitted(study), "inertia"), 0.02, 2e-5);
  EXPECT_GT(off, 1e-4);
}

}  // namespace shooting_fit_test
}  // namespace whirl_twin
