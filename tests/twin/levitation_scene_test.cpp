// Scene `levitation` in operation: the claims of its comment, and that the published sensitivity of
// its loop agrees with a chirp measurement.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "analysis/sampled_margins.h"
#include "analysis/sampled_stability.h"
#include "scene/closed_loop.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace levitation_scene_test {

using Complex = std::complex<double>;
constexpr double kPi = 3.14159265358979323846;
constexpr const char* kScene = WHIRL_TWIN_SOURCE "/config/scenes/levitation.yaml";

/// The shaft at a speed [rad/s].
ClosedLoop::Parts partsOf(const Scene& scene, double speed, double acceleration = 0.0) {
  return *closedLoops(scene).front().parts(
      [&](std::size_t system) {
        SystemMotion motion = motionAtStart(scene, system, speed);
        motion.acceleration = acceleration;
        return motion;
      },
      speed);
}

/// The margins at the first sensor along y, where the weight is.
SampledMargins toldMargins(const Scene& scene, double speed) {
  const ClosedLoop::Parts parts = partsOf(scene, speed);
  const Verdict verdict = sampledStability(sampledLoop(parts.plant, parts.controllers)).verdict;
  EXPECT_EQ(verdict, Verdict::kAsymptoticallyStable) << speed;
  return sampledMargins(parts.plant, parts.controllers, 0, verdict)[1];
}

// In its run-up the notch is frozen: the loop is that without it, and the shaft is stable at every
// speed of the run-up, as in the simulation. With a notch that adapts at 0.6 rad/s, where it
// follows in tenths of a second a rotation of one turn in ten, it would not be.
TEST(LevitationScene, ANotchThatHoldsIsNoPartOfTheLoop) {
  const Scene scene = readSceneFile(kScene);
  YAML::Node without = YAML::LoadFile(kScene);
  for (const char* of_notch : {"notch_rate", "notch_hold", "notch_phases"}) {
    without["controllers"]["magnets"]["parameters"].remove(of_notch);
  }
  const auto radiusOf = [](const ClosedLoop::Parts& parts) {
    return sampledStability(sampledLoop(parts.plant, parts.controllers)).spectral_radius;
  };
  for (const double speed : {0.6, 5.0, 111.8, 730.3}) {
    const double held = radiusOf(partsOf(scene, speed, 100.0));
    EXPECT_LT(held, 1.0) << speed;
    EXPECT_NEAR(held, radiusOf(partsOf(readScene(without, "levitation"), speed)), 1.0e-9) << speed;
  }
  EXPECT_GT(radiusOf(partsOf(scene, 0.6)), 1.0);
}

/// A force [N] with a frequency sweep from one frequency to another [rad/s] in `duration` [s] after
/// the weight is carried, smooth at both ends; its amplitude moves a mass of 1 kg by about 0.5 um.
struct Chirp {
  static constexpr double kStart = 2.0;  // s
  double from, to, duration;
  double at(double time) const {
    const double t = time - kStart;
    if (!(t > 0.0 && t < duration)) {
      return 0.0;
    }
    const double envelope = std::pow(std::sin(kPi * t / duration), 2);
    return 5.0e-7 * from * to * envelope *
           std::sin(from * t + 0.5 * (to - from) * t * t / duration);
  }
};

/// The shipped scene at a constant speed, without unbalance, noise, converter and notch, its first
/// sensor disturbed by a chirp: a disturbance of a sensor passes through the controller and the
/// amplifier to the magnet force, added to the normal operation.
Scene shaken(double speed, const Chirp& chirp) {
  YAML::Node scene = YAML::LoadFile(kScene);
  scene["step"] = 1.0e-4;
  scene["drives"]["shaft"] = YAML::Load("{speed: " + std::to_string(speed) + "}");
  YAML::Node rotor = scene["systems"]["rotor"];
  rotor.remove("initial");
  rotor.remove("inputs");
  rotor["parameters"].remove("unbalances");
  YAML::Node controller = scene["controllers"]["magnets"];
  controller.remove("sensor");
  controller["actuator"].remove("limit");
  for (const char* of_notch : {"notch_rate", "notch_hold", "notch_phases"}) {
    controller["parameters"].remove(of_notch);
  }
  YAML::Node generator = YAML::Load(
      "{model: linear_system, parameters: {names: [d], mass: [[1.0]], stiffness: [[1.0e+4]], "
      "damping: [[140.0]]}}");
  for (double t = 0.0; t < Chirp::kStart + chirp.duration; t += 1.0e-4) {
    generator["inputs"]["force_d"]["times"].push_back(t);
    generator["inputs"]["force_d"]["values"].push_back(chirp.at(t));
  }
  scene["systems"]["generator"] = generator;
  YAML::Node shaker = YAML::Clone(controller);
  shaker["measures"] = YAML::Load("[generator.d]");
  shaker["acts_on"] = YAML::Load("[rotor.force_y_1]");
  const double newton = rotor["parameters"]["magnets"][0]["ki"].as<double>();
  for (const char* gain : {"kp", "ki", "kd"}) {
    shaker["parameters"][gain] = newton * controller["parameters"][gain].as<double>();
  }
  scene["controllers"]["shaker"] = shaker;
  return readScene(scene, kScene);
}

/// Extreme values in a section of the run, relative to the operating point.
struct Seen {
  double disc = 0.0, magnet = 0.0;  ///< [m], farthest from where they are held
  double current = 0.0;             ///< [A], the largest
};

class Machine {
 public:
  Machine() : twin_(readSceneFile(kScene)), held_(partsOf(twin_.scene(), 0.0)) {
    const std::vector<Station> all = twin_.systems()[0]->dynamics->stations();
    for (const Station& station : all) {
      if (station.published || &station == &all.front()) {
        stations_.push_back(station);
      }
    }
  }
  Seen now() const {
    Seen seen;
    const Eigen::Index n = stations_.front().along_x.size();
    Eigen::VectorXd motion(2 * n);
    twin_.running(0).motion(motion.data());
    const Eigen::VectorXd aside = motion.head(n) - held_.about.at(0).q;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const double x = stations_[i].along_x.dot(aside);
      const double y = stations_[i].along_y.dot(aside);
      double& place = i == 0 ? seen.disc : seen.magnet;
      place = std::max(place, std::hypot(x, y));
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const double carrying = held_.outputs[0][static_cast<Eigen::Index>(k)];
      const double current = twin_.control().controllers()[0].acting(k);
      seen.current = std::max(seen.current, std::fabs(current - carrying));
    }
    return seen;
  }
  /// The most there is until a time [s].
  Seen until(double time) {
    Seen most = now();
    while (twin_.time() < time - 1.0e-9) {
      twin_.step();
      const Seen here = now();
      most.disc = std::max(most.disc, here.disc);
      most.magnet = std::max(most.magnet, here.magnet);
      most.current = std::max(most.current, here.current);
    }
    EXPECT_EQ(twin_.status(0), StepStatus::kOk) << time;
    return most;
  }
  double speed() const { return twin_.drive(0).at(0.0).speed; }
  std::int64_t saturated() const { return twin_.control().controllers()[0].count().saturated; }

 private:
  Twin twin_;
  ClosedLoop::Parts held_;
  std::vector<Station> stations_;  // of the disc and of the magnets
};

constexpr double kSag = 5.75e-5;          // m, of the disc below the magnets
constexpr double kWeight = 7.063 * 9.81;  // N, of shaft and disc

TEST(LevitationScene, CarriesItsWeight) {
  const ClosedLoop::Parts parts = partsOf(readSceneFile(kScene), 0.0);
  // A magnet pulls with ki i where its rotor is in the middle, whatever i. Eight modes.
  for (const int y : {1, 3}) {
    EXPECT_NEAR(parts.outputs[0][y], 0.5 * kWeight / 100.0, 1e-3) << "A";
    EXPECT_NEAR(parts.outputs[0][y - 1], 0.0, 1e-12);
  }
}

TEST(LevitationScene, LiftsOffRunsUpTurnsAboutItsOwnAxisAndIsStruck) {
  Machine run;
  EXPECT_NEAR(run.now().disc, 2.5e-4 - kSag, 2.0e-6) << "half of the gap";
  EXPECT_NEAR(run.now().magnet, 2.5e-4, 2.0e-6);
  const Seen lift_off = run.until(0.1);
  EXPECT_GT(lift_off.current, 0.9) << "1.2 A in all, more than the bias";
  EXPECT_LT(lift_off.magnet, 2.6e-4);
  EXPECT_LT(run.now().disc, 7.0e-5) << "low, until the integral carries the weight";
  run.until(1.0);
  EXPECT_LT(run.now().disc, 1.0e-6);

  const Seen swinging = run.until(4.0);
  EXPECT_NEAR(swinging.disc, 2.0e-5, 2.0e-6);
  const Seen bending = run.until(15.0);
  EXPECT_LT(bending.disc, swinging.disc) << "the first critical speed is the widest";
  EXPECT_GT(bending.magnet, 4.0e-6);
  EXPECT_LT(std::max(swinging.current, bending.current), 0.1) << "a tenth of the bias";
  run.until(16.5);
  EXPECT_EQ(run.speed(), 1500.0);
  const Seen balanced = run.until(20.0);
  EXPECT_LT(balanced.disc, 6.0e-6);
  EXPECT_LT(balanced.current, 0.5 * bending.current) << "noise is left";
  const Seen struck = run.until(20.25);
  EXPECT_NEAR(struck.disc, 4.3e-5, 4.0e-6);
  run.until(20.5);
  const Seen after = run.until(21.0);
  EXPECT_LT(after.disc, 1.1 * balanced.disc);
  EXPECT_EQ(run.saturated(), 0);
}

TEST(LevitationScene, IsInZoneAAtEverySpeed) {
  const Scene shipped = readSceneFile(kScene);
  for (double speed = 0.0; speed <= 1500.0; speed += 150.0) {
    const SampledMargins reported = toldMargins(shipped, speed);
    EXPECT_EQ(reported.zone, SensitivityZone::kA) << speed << ": " << reported.sensitivity_peak;
    EXPECT_LT(reported.bode_error, 1e-9) << speed;
  }
}

TEST(LevitationScene, HasTheSensitivityThatAChirpMeasures) {
  const Scene shipped = readSceneFile(kScene);
  for (const double speed : {0.0, 1500.0}) {
    const SampledMargins reported = toldMargins(shipped, speed);
    const Chirp chirp{0.4 * reported.peak_frequency, 1.6 * reported.peak_frequency, 2.0};
    Twin twin(shaken(speed, chirp));
    std::vector<double> disturbance, shown;
    for (int i = 0; i < 50000; ++i) {
      twin.step();
      if (twin.time() < Chirp::kStart) {
        continue;
      }
      const auto& controllers = twin.control().controllers();
      disturbance.push_back(controllers[1].shown()[0]);
      shown.push_back(controllers[0].shown()[1] + disturbance.back());
    }
    ASSERT_EQ(twin.status(0), StepStatus::kOk);
    double peak = 0.0;
    double where = 0.0;
    for (double w = 0.7 * reported.peak_frequency; w < 1.3 * reported.peak_frequency;
         w += 0.005 * reported.peak_frequency) {
      Complex of_disturbance = 0.0;
      Complex of_shown = 0.0;
      for (std::size_t k = 0; k < shown.size(); ++k) {
        const Complex turn = std::polar(1.0, -w * 1.0e-4 * static_cast<double>(k));
        of_disturbance += disturbance[k] * turn;
        of_shown += shown[k] * turn;
      }
      const double sensitivity = std::abs(of_shown / of_disturbance);
      if (sensitivity > peak) {
        peak = sensitivity;
        where = w;
      }
    }
    EXPECT_NEAR(peak, reported.sensitivity_peak, 0.02 * reported.sensitivity_peak) << speed;
    EXPECT_NEAR(where, reported.peak_frequency, 0.02 * reported.peak_frequency) << speed;
    EXPECT_GT(peak, 1.2) << speed;
  }
}

}  // namespace levitation_scene_test
}  // namespace whirl_twin
