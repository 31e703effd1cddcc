// The shipped measured swings: a double pendulum on a laboratory rig, fitted to some of them,
// predicts the others.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "estimation/follow_settings.h"
#include "estimation/iterated_initializer.h"
#include "estimation/shooting_fit.h"
#include "scene/built_scene.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace measured_swings_test {

constexpr double kBetweenSwings = 1.0;  // s, minimum
constexpr double kBar = 1.8e-3;         // rad

MeasuredChannel channel(const std::string& name, std::size_t state) {
  MeasuredChannel c;
  c.name = c.column = name;
  c.state = state;
  c.unit = "rad";
  c.offset.fitted = true;
  return c;
}

/// The record has one swing after another, with nothing measured between.
std::vector<StudyRun> swings() {
  const MeasuredRun all = readMeasuredRun(WHIRL_TWIN_SOURCE "/config/records/multi_arm_swings.csv",
                                          {}, {{"theta1"}, {"theta2"}});
  std::vector<StudyRun> runs;
  for (std::size_t k = 0; k < all.time.size(); ++k) {
    if (k == 0 || all.time[k] - all.time[k - 1] > kBetweenSwings) {
      StudyRun run;
      run.file = "swing " + std::to_string(runs.size() + 1);
      run.train = true;
      run.measured = {channel("theta1", 0), channel("theta2", 1)};
      run.data.columns = {{"theta1", {}}, {"theta2", {}}};
      runs.push_back(run);
    }
    MeasuredRun& data = runs.back().data;
    data.time.push_back(all.time[k]);
    data.columns[0].values.push_back(all.column("theta1")[k]);
    data.columns[1].values.push_back(all.column("theta2")[k]);
  }
  return runs;
}

/// Of the swings as one window each; absent parameters are 0.
FitStudy study(const std::vector<std::string>& parameters,
               const std::vector<std::string>& absent = {}) {
  FitStudy study;
  study.source = "study.yaml";
  study.scene = readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/measured_swing.yaml");
  study.scene.sensors.clear();
  study.scene.step = 2'000'000;  // ns
  for (const std::string& path : absent) {
    study.scene.systems.front().parameters[path] = 0.0;
  }
  study.system = "pendulum";
  study.runs = swings();
  study.window = std::numeric_limits<double>::infinity();
  const SharedSystem system = build(study.scene).systems.front();
  for (const std::string& path : parameters) {
    study.fit.push_back({path, system->parameter(path).value()});
  }
  return study;
}

/// Over both angles and the whole swing [rad].
double rms(const FittedRun& run) {
  return std::sqrt(0.5 * (run.rms[0] * run.rms[0] + run.rms[1] * run.rms[1]));
}

/// Three swings predict the other five, the widest of which is outside the range of the three.
TEST(MeasuredSwings, ThatAreLeftOutArePredicted) {
  FitStudy three = study({"length1", "center1", "center2", "inertia1", "damping1", "coulomb1",
                          "coulomb2", "drag2", "drag_reach2"},
                         {"damping2"});
  ASSERT_EQ(three.runs.size(), 8u);
  for (const std::size_t left_out : {0u, 2u, 4u, 6u, 7u}) {
    three.runs[left_out].train = false;
  }
  const ShootingFit fit = fitByShooting(three, [](int, int) {});
  EXPECT_TRUE(fit.converged);
  for (std::size_t r = 0; r < three.runs.size(); ++r) {
    EXPECT_LT(rms(fit.runs[r]), kBar) << three.runs[r].file;
  }
  for (Eigen::Index i = 0; i < fit.theta.size(); ++i) {
    const Unknown& u = fit.unknowns[static_cast<std::size_t>(i)];
    EXPECT_TRUE(u.kind != Unknown::Kind::kParameter || fit.theta[i] >= 0.0) << u.name;
  }
}

/// The widest and the smallest: neither friction that grows with the rate nor that of the joints
/// alone explains both.
TEST(MeasuredSwings, NeedDryFrictionAndAir) {
  const auto ofTwo = [](const std::vector<std::string>& parameters,
                        const std::vector<std::string>& absent) {
    FitStudy two = study(parameters, absent);
    two.runs = {two.runs.front(), two.runs.back()};
    const ShootingFit fit = fitByShooting(two, [](int, int) {});
    return std::max(rms(fit.runs[0]), rms(fit.runs[1]));
  };
  EXPECT_GT(ofTwo({"length1", "center1", "center2", "inertia1", "damping1", "coulomb1", "coulomb2"},
                  {"damping2", "drag2"}),
            2.0 * kBar);
  EXPECT_GT(ofTwo({"length1", "center1", "center2", "inertia1", "damping1", "drag2", "drag_reach2"},
                  {"damping2", "coulomb1", "coulomb2"}),
            kBar);
}

/// One after another, each sample once, from a guess of friction and drag that is off by times.
TEST(MeasuredSwings, FollowedOnLineTellWhatPredictsThem) {
  FitStudy all = study({});
  all.validate_only = true;
  const BuiltScene scene =
      build(readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/measured_swing.yaml"));
  const std::string settings = WHIRL_TWIN_SOURCE "/config/follow/measured_swing.yaml";
  SystemFollowing following =
      readFollowSettings(YAML::LoadFile(settings), settings, scene).of("pendulum");
  following.disturbance = 0.01;  // rad/s^2/sqrt(Hz), half of the demo's: docs/following.md
  std::vector<EstimatorChannel> channels;
  for (const SensorChannelSpec& sensed : scene.scene.sensors.front().channels) {
    EstimatorChannel encoder;
    encoder.name = scene.scene.sensors.front().name + "/" + sensed.name;
    encoder.signal = sensed.signal;
    encoder.deviation = sensed.name == "theta2" ? 6.0e-5 : sensed.sensor.noise;  // [rad]
    encoder.offset = following.offset.at(encoder.name);
    channels.push_back(encoder);
  }
  IteratedInitializer filter(scene, 0, following, channels);
  for (StudyRun& run : all.runs) {
    run.train = false;
    for (std::size_t k = 0; k < run.data.time.size(); ++k) {
      const ShaftInstant now{std::llround(1.0e9 * run.data.time[k]), {}, 0.0};
      if (k == 0) {
        filter.begin(now);
      }
      filter.goTo(now);
      filter.take(0, run.data.columns[0].values[k]);
      filter.take(1, run.data.columns[1].values[k]);
    }
  }
  for (std::size_t i = 0; i < following.parameters.size(); ++i) {
    all.scene.systems.front().parameters[following.parameters[i].path] = filter.parameter(i);
  }
  for (StudyRun& run : all.runs) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
      run.measured[c].offset = {filter.offset(c), false};
    }
  }
  const ShootingFit predicted = fitByShooting(all, [](int, int) {});
  for (std::size_t r = 0; r < all.runs.size(); ++r) {
    EXPECT_LT(rms(predicted.runs[r]), kBar) << all.runs[r].file;
  }
}

}  // namespace measured_swings_test
}  // namespace whirl_twin
