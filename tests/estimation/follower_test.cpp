// A state estimator of a simulated plant that it knows by its sensors alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "estimation/state_estimator.h"
#include "followed_machine.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace follower_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kRotor = R"(
name: rig
step: 0.001
drives:
  shaft: {speed: 45.0}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
sensors:
  probes:
    rate: 200.0
    channels:
      x: {measures: rotor.x, noise: 3.0e-6}
      y: {measures: rotor.y, noise: 3.0e-6}
  tacho: {keyphasor: shaft, jitter: 2.0e-5}
)";

FollowSettings followStiffness() {
  FollowSettings settings;
  settings.systems["rotor"].disturbance = 1.0e-3;
  settings.systems["rotor"].parameters = {{"stiffness", {0.05, 2.0e-4}}};
  return settings;
}

TEST(StateEstimator, TellsTheWhirlThatTheMachineHas) {
  Machine machine(kRotor);
  Twinned twin(kRotor, {});
  for (int k = 0; k < 10'000; ++k) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
  }
  // The plant's whirl at the time of the newest record.
  Machine again(kRotor);
  while (again.time() < twin.recorded - 1.0e-9) {
    again.step();
  }
  EXPECT_LT(std::hypot(twin.x() - again.x(), twin.y() - again.y()), 3.0e-6);
  EXPECT_GT(twin.recorded, 9.5);
  EXPECT_TRUE(twin.last().shaft_known);
  EXPECT_EQ(twin.last().refused, 0);
  EXPECT_GT(twin.last().used, 3700);
}

/// An outlier before the motion is known: the initial estimate contains a vibration that does not
/// exist, and would identify a stiffness from it.
TEST(StateEstimator, LearnsNothingOfAMotionThatBeginsWithAnOutlier) {
  std::string scene = kRotor;
  scene.erase(scene.find("  tacho"));
  scene.replace(scene.find("rate: 200.0"), 11, "rate: 1000.0");
  Machine machine(scene);
  Twinned twin(scene, followStiffness());
  bool first = true;
  while (machine.time() < 4.0) {
    for (state::Measurement m : machine.step()) {
      m.value[0] += std::exchange(first, false) ? 137.0e-6 : 0.0;
      twin.follower.take(m);
    }
  }
  EXPECT_EQ(twin.follower.restarts(), 1);
  EXPECT_NEAR(twin.last().value[0], 7200.0, 4.0 * twin.last().deviation[0]);
  EXPECT_LT(twin.last().deviation[0], 20.0);
}

/// A stiffness loss of two per cent is significant: it is reported within ten seconds, not before
/// any change, and with the right new value.
TEST(StateEstimator, TellsOfAShaftThatSoftens) {
  Machine machine(kRotor);
  Twinned twin(kRotor, followStiffness());
  const auto stiffness = [](double t) {
    return 7200.0 * (1.0 - 0.05 * std::clamp((t - 180.0) / 60.0, 0.0, 1.0));
  };
  double published = kNaN;
  while (machine.time() < 260.0) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
    if (std::llround(machine.time() * 1000.0) % 200 == 0 && machine.time() > 180.0) {
      machine.setStiffness(stiffness(machine.time()));
    }
    if (std::isnan(published) && !twin.published.empty() && !twin.last().drift_parameter.empty()) {
      published = machine.time();
    }
  }
  const double passed = 180.0 + 0.02 / 0.05 * 60.0;
  EXPECT_GT(published, 180.0);
  EXPECT_LT(published, passed + 10.0);
  EXPECT_EQ(twin.last().drift_parameter, "stiffness");
  EXPECT_NEAR(twin.last().drift_from, 7200.0, 0.005 * 7200.0);
  EXPECT_NEAR(twin.last().value[0], stiffness(260.0), 0.005 * 7200.0);
}

/// Sources with different delays, within the reordering delay, and blocks in a different order give
/// bit-identical results.
TEST(StateEstimator, GivesTheSameBitsInWhateverOrderSourcesCome) {
  const auto run = [](int delay) {
    Machine machine(kRotor);
    FollowSettings settings = followStiffness();
    settings.patience = 0.5;
    Twinned twin(kRotor, settings);
    std::vector<state::Measurement> late;
    for (int k = 0; k < 5'000; ++k) {
      for (const state::Measurement& m : machine.step()) {
        if (m.source == "tacho" && delay > 0) {
          late.push_back(m);
        } else {
          twin.follower.take(m);
        }
      }
      if (delay > 0 && k % delay == 0) {
        for (const state::Measurement& m : late) {
          twin.follower.take(m);
        }
        late.clear();
      }
    }
    twin.follower.finish();
    return twin.whirl();
  };
  const std::vector<double> prompt = run(0), slow = run(170);
  ASSERT_GT(prompt.size(), 900U);
  const std::size_t common = std::min(prompt.size(), slow.size());
  EXPECT_GT(common + 20, prompt.size());
  EXPECT_TRUE(std::equal(prompt.begin(), prompt.begin() + static_cast<std::ptrdiff_t>(common),
                         slow.begin()));
}

/// A dead probe, invalid samples, a keyphasor gap of two seconds, blocks that are lost or
/// duplicated: each is reported, and the motion is known again afterwards.
TEST(StateEstimator, SurvivesWhatSensorsDo) {
  Machine machine(kRotor);
  Twinned twin(kRotor, {});
  bool dead_said = false, refused_said = false;
  for (int k = 0; k < 30'000; ++k) {
    const double t = machine.time();
    for (state::Measurement m : machine.step()) {
      const bool probes = m.source == "probes";
      if (probes && t > 5.0 && t < 7.0) {  // not valid
        for (std::size_t i = 0; i < m.value.size(); i += 2) {
          m.value[i] = kNaN;
        }
      }
      if (probes && t > 10.0 && t < 12.0) {  // one is constant, far off
        for (std::size_t i = 1; i < m.value.size(); i += 2) {
          m.value[i] = 1.0e-2;
        }
      }
      if (!probes && t > 15.0 && t < 17.0) {
        continue;
      }
      if (probes && t > 20.0 && t < 20.4) {
        continue;
      }
      twin.follower.take(m);
      if (probes && t > 22.0 && t < 22.4) {
        twin.follower.take(m);
      }
    }
    if (!twin.published.empty()) {
      const auto status = [&](std::size_t c) {
        return static_cast<state::ChannelStatus>(twin.last().channel_status[c]);
      };
      dead_said = dead_said || (t > 5.2 && t < 7.0 && status(0) == state::ChannelStatus::kInvalid);
      refused_said =
          refused_said || (t > 10.2 && t < 12.0 && status(1) == state::ChannelStatus::kRefused);
    }
  }
  EXPECT_TRUE(dead_said);
  EXPECT_TRUE(refused_said);
  EXPECT_GT(twin.last().invalid, 300);
  EXPECT_GT(twin.last().refused, 300);
  EXPECT_GT(twin.last().lost, 0);
  EXPECT_GT(twin.last().repeated, 0);
  EXPECT_EQ(twin.last().channel_status[0], 0);
  EXPECT_EQ(twin.last().channel_status[1], 0);
  EXPECT_TRUE(twin.last().shaft_known);
  Machine again(kRotor);
  while (again.time() < twin.recorded - 1.0e-9) {
    again.step();
  }
  EXPECT_LT(std::hypot(twin.x() - again.x(), twin.y() - again.y()), 5.0e-6);
}

std::string with(std::string scene, const std::string& what, const std::string& instead) {
  return scene.replace(scene.find(what), what.size(), instead);
}

/// Difference between the twin's records and the plant: root mean square [m] from one time to
/// another.
double apart(const Twinned& twin, const std::string& machine, double from, double to) {
  Machine again(machine);
  const std::vector<double> whirl = twin.whirl();
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < twin.time.size() && twin.time[i] < to; ++i) {
    while (again.time() < twin.time[i] - 1.0e-9) {
      again.step();
    }
    if (twin.time[i] >= from) {
      squares += std::pow(whirl[2 * i] - again.x(), 2) + std::pow(whirl[2 * i + 1] - again.y(), 2);
      count += 1.0;
    }
  }
  return std::sqrt(squares / count);
}

/// Pulses cease for ten seconds, in which the shaft changes speed. The whirl is known with the
/// accuracy of two probes, which is lower than before, and reported as such. The unbalance estimate
/// is kept, and is right at the angle at which the shaft is found again.
TEST(StateEstimator, GoesOnByTheProbesWithoutAKeyphasor) {
  const std::string rig =
      with(kRotor, "{speed: 45.0}",
           "{speed: 45.0, profile: ["
           "{speed: 45.0, max_acceleration: 2.0, max_jerk: 20.0, dwell: 8.0}, "
           "{speed: 50.0, max_acceleration: 2.0, max_jerk: 20.0, dwell: 30.0}]}");
  const std::string model = with(kRotor, "eccentricity: 1.0e-4", "eccentricity: 5.0e-5");
  FollowSettings settings;
  settings.systems["rotor"].disturbance = 1.0e-3;
  settings.systems["rotor"].unbalance = {2.0e-4, 0.0};
  Machine machine(rig);
  Twinned twin(model, settings);
  const auto unbalance = [&] { return twin.follower.filter(0)->unbalance(0); };
  double known_deviation = 0.0, least_deviation = 1.0;
  bool said = false;
  while (machine.time() < 30.0) {
    const double t = machine.time();
    for (const state::Measurement& m : machine.step()) {
      if (m.source == "probes" || t < 5.0 || t > 15.0) {
        twin.follower.take(m);
      }
    }
    if (t > 4.0 && t < 5.0) {
      known_deviation = std::max(known_deviation, twin.last().residual_deviation[0]);
    }
    if (t > 7.0 && t < 15.0) {
      said = said || !twin.last().shaft_known;
      least_deviation = std::min(least_deviation, twin.last().residual_deviation[0]);
    }
    if (std::fabs(t - 14.9) < 1.0e-6) {
      EXPECT_NEAR(unbalance().x(), 1.0e-4, 2.0e-6);
      EXPECT_NEAR(unbalance().y(), 0.0, 2.0e-6);
    }
  }
  EXPECT_TRUE(said);
  EXPECT_GT(least_deviation, 1.3 * known_deviation);
  EXPECT_LT(apart(twin, rig, 3.0, 5.0), 2.0e-6);
  EXPECT_LT(apart(twin, rig, 5.0, 15.0), 6.0e-6);  // two probes of 3 um
  EXPECT_LT(apart(twin, rig, 17.0, 30.0), 2.0e-6);
  EXPECT_EQ(twin.last().refused, 0);
  EXPECT_EQ(twin.follower.restarts(), 0);
  EXPECT_TRUE(twin.last().shaft_known);
  EXPECT_NEAR(unbalance().x(), 1.0e-4, 1.0e-6);
  EXPECT_NEAR(unbalance().y(), 0.0, 1.0e-6);
  for (std::size_t i = 1; i < twin.angle.size(); ++i) {
    EXPECT_GT(twin.angle[i], twin.angle[i - 1] - M_PI) << twin.time[i];
  }
}

/// A keyphasor that never gave a pulse: the shaft has the drive's speed, with unknown angle.
TEST(StateEstimator, BeginsByTheProbesWhereTheKeyphasorIsDead) {
  Machine machine(kRotor);
  Twinned twin(with(kRotor, "speed: 45.0", "speed: 46.0"), {});
  while (machine.time() < 10.0) {
    for (const state::Measurement& m : machine.step()) {
      if (m.source == "probes") {
        twin.follower.take(m);
      }
    }
  }
  EXPECT_FALSE(twin.last().shaft_known);
  EXPECT_LT(apart(twin, kRotor, 3.0, 10.0), 6.0e-6);
}

/// The plant's clock is set forward, and back, by an hour: the twin's time continues, and the
/// motion is found again.
TEST(StateEstimator, GoesOnWhenTheMachinesClockIsSet) {
  Machine machine(kRotor);
  Twinned twin(kRotor, {});
  constexpr std::int64_t kHour = 3'600'000'000'000;
  for (int k = 0; k < 15'000; ++k) {
    const double t = machine.time();
    for (state::Measurement m : machine.step()) {
      const std::int64_t by = t > 5.0 && t < 10.0 ? kHour : 0;
      m.first_instant += by;
      for (std::int64_t& instant : m.instant) {
        instant += by;
      }
      twin.follower.take(m);
    }
  }
  EXPECT_GE(twin.follower.restarts(), 2);
  EXPECT_GT(twin.recorded, 13.0);
  EXPECT_LT(twin.recorded, 15.1);
  EXPECT_TRUE(twin.last().shaft_known);
  EXPECT_EQ(twin.last().channel_status[0], 0);
  EXPECT_LT(std::fabs(twin.last().residual[0]), 5.0 * twin.last().residual_deviation[0]);
}

/// The unit and noise in a message are used: probes in um, ten times as noisy as in the scene. In a
/// unit of a different dimension they give no information.
TEST(StateEstimator, TakesUnitsAndDeviationsAsMessagesSayThem) {
  const std::string noisy =
      with(with(kRotor, "noise: 3.0e-6", "noise: 3.0e-5"), "noise: 3.0e-6", "noise: 3.0e-5");
  Machine machine(noisy);
  Twinned twin(kRotor, {});
  while (machine.time() < 10.0) {
    for (state::Measurement m : machine.step()) {
      if (m.source == "probes") {
        m.unit = {"um", machine.time() < 9.0 ? "um" : "V"};
        for (double& value : m.value) {
          value *= 1.0e6;
        }
        m.deviation = {30.0, 30.0};
      }
      twin.follower.take(m);
    }
  }
  EXPECT_EQ(twin.last().refused, 0);
  EXPECT_GT(twin.last().residual_deviation[0], 3.0e-5);
  EXPECT_LT(twin.last().residual_deviation[0], 4.0e-5);
  EXPECT_LT(apart(twin, noisy, 4.0, 8.0), 1.0e-5);
  EXPECT_EQ(twin.last().channel_status[0], static_cast<int>(state::ChannelStatus::kUsed));
  EXPECT_EQ(twin.last().channel_status[1], static_cast<int>(state::ChannelStatus::kInvalid));
}

constexpr const char* kDrivenArm = R"(
name: rig
step: 0.001
systems:
  arm:
    model: pendulum
    parameters: {mass: 0.5, length: 0.3, damping: 0.01}
    inputs: {torque: {amplitude: 0.4, frequency: 7.3, phase: 0.3}}
sensors:
  encoder: {rate: 200.0, channels: {theta: {measures: arm.theta, noise: 1.0e-3}}}
)";
constexpr const char* kTorque =
    "    inputs: {torque: {amplitude: 0.4, frequency: 7.3, phase: 0.3}}\n";

FollowSettings followTorque() {
  FollowSettings settings;
  settings.systems["arm"].disturbance = 0.02;
  InputFollowing torque;
  torque.source = "motor";
  torque.channel = "torque";
  torque.unit = "N m";
  torque.scale = 2.0;
  settings.systems["arm"].inputs = {torque};
  return settings;
}

/// The motor's torque as its sensor shows it, a block of ten samples at 100 Hz: half of it, in mN
/// m.
state::Measurement torqueBlock(std::int64_t number) {
  state::Measurement block;
  block.source = "motor";
  block.at.step = number;
  block.channel = {"torque"};
  block.unit = {"mN m"};
  block.deviation = {kNaN};
  block.samples = 10;
  block.period = 10'000'000;
  block.first_instant = number * 100'000'000;
  for (int i = 0; i < 10; ++i) {
    block.value.push_back(200.0 *
                          std::cos(7.3 * (0.1 * static_cast<double>(number) + 0.01 * i) + 0.3));
  }
  block.valid.assign(10, 1);
  return block;
}

/// Drives the arm for 20 s, without data of its torque from 12 s to 14 s; the torque's blocks
/// arrive `late` steps after they are complete.
void followDrivenArm(
    Twinned& twin, bool torque_told, int late,
    const std::function<void(double)>& look = [](double) {}) {
  Machine machine(kDrivenArm);
  for (std::int64_t k = 1; k <= 20'000; ++k) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
    const std::int64_t complete = k - late;
    if (torque_told && complete >= 100 && complete % 100 == 0 &&
        (complete <= 12'000 || complete > 14'000)) {
      twin.follower.take(torqueBlock(complete / 100 - 1));
    }
    look(machine.time());
  }
  twin.follower.finish();
}

/// A measured torque is used as the input; without it the arm moves in a way that the model cannot.
/// A gap in its data is reported.
TEST(StateEstimator, TakesWhatActsOnAnInputFromItsSensor) {
  const std::string model = with(kDrivenArm, kTorque, "");
  Twinned driven(model, followTorque());
  bool silent = false;
  double largest = 0.0;
  followDrivenArm(driven, true, 60, [&](double t) {
    if (driven.published.empty()) {
      return;
    }
    const state::FollowState& published = driven.last();
    ASSERT_EQ(published.channel, (std::vector<std::string>{"encoder/theta", "motor/torque"}));
    if (t > 4.0 && t < 12.0) {
      EXPECT_EQ(driven.follower.restarts(), 0) << t;
      largest = std::max(largest, published.mismatch);
      EXPECT_EQ(published.channel_status[1], static_cast<int>(state::ChannelStatus::kUsed)) << t;
    }
    silent =
        silent || (t > 13.0 && t < 14.0 &&
                   published.channel_status[1] == static_cast<int>(state::ChannelStatus::kSilent));
  });
  EXPECT_LT(largest, driven.last().mismatch_limit);
  EXPECT_LT(apart(driven, kDrivenArm, 4.0, 12.0), 5.0e-3);
  EXPECT_TRUE(silent);
  EXPECT_LT(driven.last().mismatch, driven.last().mismatch_limit);
  EXPECT_EQ(driven.last().channel_status[1], static_cast<int>(state::ChannelStatus::kUsed));

  FollowSettings without = followTorque();
  without.systems["arm"].inputs.clear();
  Twinned free(model, without);
  followDrivenArm(free, false, 0);
  EXPECT_GT(free.follower.restarts(), 10);  // it never agrees with the model
}

/// Any delay of the torque within the reordering delay gives bit-identical results.
TEST(StateEstimator, TakesALateInputWhereItBelongs) {
  const std::string model = with(kDrivenArm, kTorque, "");
  Twinned prompt(model, followTorque()), late(model, followTorque());
  followDrivenArm(prompt, true, 0);
  followDrivenArm(late, true, 90);
  const std::vector<double> one = prompt.whirl(), other = late.whirl();
  constexpr std::ptrdiff_t kBoth = 3800;  // 19 s: data after the end are not waited for
  ASSERT_GT(std::min(one.size(), other.size()), static_cast<std::size_t>(kBoth));
  EXPECT_TRUE(std::equal(one.begin(), one.begin() + kBoth, other.begin()));
}

/// A shaft with a disc between two bearings, measured by probes at the disc and at one bearing: the
/// bearing loads add up to its weight, and the one nearer to the disc has more.
TEST(StateEstimator, TellsWhatTheBearingsBear) {
  const char* text = R"(
name: rig
step: 0.0005
systems:
  rotor:
    model: flexible_rotor
    parameters:
      youngs_modulus: 2.0e11
      density: 7800.0
      gravity_on_shaft: true
      modes: 12
      elements: [{length: 0.1, outer_diameter: 0.02, count: 6}]
      discs: [{node: 2, mass: 3.0, polar_inertia: 0.01, transverse_inertia: 0.006}]
      bearings:
        - {node: 0, kxx: 1.0e6, kyy: 1.0e6, cxx: 200.0, cyy: 200.0}
        - {node: 6, kxx: 1.0e6, kyy: 1.0e6, cxx: 200.0, cyy: 200.0}
      unbalances: [{node: 2, magnitude: 1.0e-5}]
      stations: [{node: 6}]
    drive: shaft
drives:
  shaft: {speed: 100.0}
sensors:
  probes:
    rate: 1000.0
    channels:
      x: {measures: rotor.node_2.x, noise: 1.0e-6}
      y: {measures: rotor.node_2.y, noise: 1.0e-6}
      u: {measures: rotor.node_6.x, noise: 1.0e-6}
      v: {measures: rotor.node_6.y, noise: 1.0e-6}
)";
  Machine machine(text);
  FollowSettings settings;
  settings.systems["rotor"].disturbance = 1.0e-3;
  Twinned twin(text, settings);
  double x = 0.0, y0 = 0.0, y1 = 0.0;
  std::size_t counted = 0, seen = 0;
  while (machine.time() < 8.0) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
    for (; seen < twin.published.size(); ++seen) {
      const state::FollowState& published = twin.published[seen];
      ASSERT_EQ(published.bearing, (std::vector<std::string>{"bearings[0]", "bearings[1]"}));
      if (published.at.time > 4.0) {
        x += published.force_x[0] + published.force_x[1];
        y0 += published.force_y[0];
        y1 += published.force_y[1];
        ++counted;
        EXPECT_LT(published.force_deviation[0], 2.0);
      }
    }
  }
  const double n = static_cast<double>(counted);
  const double weight = 9.80665 * (3.0 + 7800.0 * M_PI * 1.0e-4 * 0.6);
  EXPECT_NEAR((y0 + y1) / n, weight, 0.02 * weight);
  EXPECT_NEAR(x / n, 0.0, 0.02 * weight);
  // Moments about the second bearing: the disc at two thirds of the length from it.
  EXPECT_NEAR(y0 / n, 9.80665 * (3.0 * 2.0 / 3.0 + 0.5 * 7800.0 * M_PI * 1.0e-4 * 0.6),
              0.03 * weight);
}

TEST(StateEstimator, RefusesASceneThatMeasuresNothing) {
  const std::string text = std::string(kRotor).substr(0, std::string(kRotor).find("sensors:"));
  const Twin twin(builtSceneOf(text));
  EXPECT_THROW(StateEstimator(twin, std::make_shared<SystemGenerations>(twin), {}, 1, {}),
               InputError);
}

/// One block in which the clock is set: three hours are not stepped through.
TEST(StateEstimator, GoesOnWhenTheClockIsSetWithinABlock) {
  Machine machine(kRotor);
  Twinned twin(kRotor, {});
  constexpr std::int64_t kHours = 10'800'000'000'000;  // ns
  std::int64_t by = 0;
  for (int k = 0; k < 6'000; ++k) {
    for (state::Measurement m : machine.step()) {
      const bool probes = m.source == "probes";
      if (probes && m.period > 0) {  // so that each sample has an instant
        for (std::int64_t i = 0; i < m.samples; ++i) {
          m.instant.push_back(m.first_instant + i * m.period);
        }
        m.period = 0;
      }
      const std::int64_t before = by;
      by = probes && m.samples > 1 && machine.time() > 3.0 ? kHours : by;
      m.first_instant += before;
      for (std::size_t i = 0; i < m.instant.size(); ++i) {
        m.instant[i] += i == 0 ? before : by;
      }
      twin.follower.take(m);
    }
  }
  ASSERT_EQ(by, kHours);
  EXPECT_GE(twin.follower.restarts(), 1);
  EXPECT_GT(twin.recorded, 5.0);
  EXPECT_LT(twin.recorded, 7.0);
}

/// One probe fails while the clock is set: its timeout is reported.
TEST(StateEstimator, TellsOfAChannelThatIsSilentSinceTheClockWasSet) {
  Machine machine(kRotor);
  Twinned twin(kRotor, {});
  constexpr std::int64_t kHour = 3'600'000'000'000;
  for (int k = 0; k < 5'000; ++k) {
    const bool later = machine.time() > 2.0;
    for (state::Measurement m : machine.step()) {
      m.first_instant += later ? kHour : 0;
      for (std::int64_t& instant : m.instant) {
        instant += later ? kHour : 0;
      }
      if (later && m.source == "probes") {
        m.channel = {"x", "other"};
      }
      twin.follower.take(m);
    }
  }
  const auto status = [&](std::size_t c) {
    return static_cast<state::ChannelStatus>(twin.last().channel_status[c]);
  };
  EXPECT_EQ(status(0), state::ChannelStatus::kUsed);
  EXPECT_EQ(status(1), state::ChannelStatus::kSilent);
}

/// A state estimator with absurd settings, here a process noise beyond all numbers, restarts, and
/// publishes only finite numbers.
TEST(StateEstimator, BeginsAnewWhenItsEstimateRunsAway) {
  Machine machine(kRotor);
  FollowSettings settings = followStiffness();
  settings.systems["rotor"].disturbance = 1.0e160;
  Twinned twin(kRotor, settings);
  for (int k = 0; k < 2'000; ++k) {
    for (const state::Measurement& m : machine.step()) {
      twin.follower.take(m);
    }
  }
  EXPECT_GT(twin.follower.restarts(), 0);
  for (const state::FollowState& published : twin.published) {
    EXPECT_TRUE(std::isfinite(published.value[0]) && std::isfinite(published.deviation[0]));
  }
  for (const double whirl : twin.whirl()) {
    ASSERT_TRUE(std::isfinite(whirl));
  }
}

}  // namespace follower_test
}  // namespace whirl_twin
