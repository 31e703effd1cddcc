// The extended Kalman filter of a system against known results: a stationary Kalman filter computed
// independently, motions with known parameters, its own statistics.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "estimation/extended_kalman_filter.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace system_filter_test {

BuiltScene sceneOf(const std::string& text) {
  return build(readScene(YAML::Load(text), "a test"));
}

EstimatorChannel displacement(const char* name, double direction, double deviation) {
  EstimatorChannel channel;
  channel.name = name;
  channel.signal.kind = SignalSpec::Kind::kDisplacement;
  channel.signal.direction = direction;
  channel.signal.unit = "m";
  channel.deviation = deviation;
  return channel;
}

EstimatorChannel angle(const char* name, std::size_t coordinate, double deviation) {
  EstimatorChannel channel;
  channel.name = name;
  channel.signal.coordinate = coordinate;
  channel.signal.unit = "rad";
  channel.deviation = deviation;
  return channel;
}

ShaftInstant steadyShaft(std::int64_t time, double speed) {
  return {time, advance({0, 0.0}, speed, time), speed};
}

/// A Jeffcott rotor z = x + i y of p = 100 rad/s, D = 0.05 at 120 rad/s, measured at 1 kHz with
/// E|v|^2 = 1e-12 m^2, under a white acceleration of 1e-4 (m/s^2)^2/Hz and a 1X acceleration that
/// wanders by 1e-2 (m/s^2)^2/s: the stationary filter of a separate computation (complex Riccati
/// iteration).
TEST(ExtendedKalmanFilter, ReachesTheStationaryKalmanFilter) {
  const double mass = 1.0, speed = 120.0;
  const BuiltScene scene = sceneOf(R"(
name: rig
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 0.0}
    drive: shaft
drives:
  shaft: {speed: 120.0}
)");
  SystemFollowing settings;
  const double per_axis = std::sqrt(0.5);
  settings.disturbance = per_axis * 1.0e-2;
  settings.unbalance = {1.0e-3, per_axis * 0.1 / (mass * speed * speed)};
  ExtendedKalmanFilter filter(scene, 0, settings,
                              {displacement("probes/x", 0.0, per_axis * 1.0e-6),
                               displacement("probes/y", M_PI / 2.0, per_axis * 1.0e-6)});
  filter.begin(steadyShaft(0, speed));
  const auto deviations = [&] {
    return std::array<double, 3>{
        std::sqrt(2.0) * filter.filter().deviation(0),
        std::sqrt(2.0) * filter.filter().deviation(2),
        std::sqrt(2.0) * filter.filter().deviation(4) * mass * speed * speed};
  };
  std::array<double, 3> predicted{};
  for (std::int64_t k = 1; k <= 4000; ++k) {
    filter.goTo(steadyShaft(k * 1'000'000, speed));
    predicted = deviations();
    filter.take(0, 0.0);
    filter.take(1, 0.0);
  }
  const std::array<double, 3> updated = deviations();
  const std::array<double, 3> expected_before = {1.089727e-6, 5.479285e-4, 3.211880e-2};
  const std::array<double, 3> expected_after = {7.367892e-7, 4.546152e-4, 3.196275e-2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(predicted[i] / expected_before[i], 1.0, 1.0e-4) << i;
    EXPECT_NEAR(updated[i] / expected_after[i], 1.0, 1.0e-4) << i;
  }
}

constexpr const char* kArm = R"(
name: rig
step: 0.001
systems:
  arm:
    model: pendulum
    parameters: {mass: 0.5, length: 0.3, damping: 0.004}
    initial: {theta: 1.2}
)";

/// The arm's motion, sampled every second step with noise, processed by a filter with different
/// initial parameters.
class ArmRun {
 public:
  ArmRun(const BuiltScene& model, const SystemFollowing& settings, unsigned seed)
      : filter(model, 0, settings, {angle("encoder/theta", 0, kNoise)}),
        machine_(sceneOf(kArm)),
        random_(seed) {
    filter.begin({0, {}, 0.0});
  }
  void resume(double seconds) {
    std::normal_distribution<double> noise(0.0, kNoise);
    std::vector<double> record(machine_.layout().size);
    const std::int64_t end = machine_.stepCount() + std::llround(seconds * 1000.0);
    while (machine_.stepCount() < end) {
      machine_.step();
      if (machine_.stepCount() % 2 != 0) {
        continue;
      }
      machine_.write(record.data());
      q = machine_.layout().system(record.data(), 0).q()[0];
      v = machine_.layout().system(record.data(), 0).v()[0];
      filter.goTo({machine_.stepCount() * 1'000'000, {}, 0.0});
      innovations.push_back(filter.take(0, q + noise(random_)).normalized());
    }
  }

  static constexpr double kNoise = 0.002;  // rad
  ExtendedKalmanFilter filter;
  double q = 0.0, v = 0.0;  // of the machine
  std::vector<double> innovations;

 private:
  Twin machine_;
  std::mt19937 random_;
};

BuiltScene armWith(double length, double damping) {
  BuiltScene scene = sceneOf(kArm);
  scene.systems[0] = scene.systems[0]->with({"length", "damping"}, {length, damping}, "a test");
  return scene;
}

TEST(ExtendedKalmanFilter, FindsLengthAndDampingOfASwing) {
  SystemFollowing settings;
  settings.parameters = {{"length", {0.1, 0.0}}, {"damping", {0.5, 0.0}}};
  const BuiltScene model = armWith(0.31, 0.006);
  ArmRun run(model, settings, 1);
  run.resume(20.0);
  EXPECT_NEAR(run.filter.parameter(0), 0.3, 6.0 * run.filter.parameterDeviation(0));
  EXPECT_NEAR(run.filter.parameter(1), 0.004, 6.0 * run.filter.parameterDeviation(1));
  EXPECT_LT(run.filter.parameterDeviation(0), 1.0e-4);
  EXPECT_LT(run.filter.parameterDeviation(1), 1.0e-4);
}

/// Over many runs, each with a start drawn from the filter's prior, the errors match its covariance
/// (the mean of the normalized squares, chi-squared of two degrees of freedom, is 2), and so do the
/// innovations.
TEST(ExtendedKalmanFilter, KnowsHowCertainItIs) {
  SystemFollowing settings;
  settings.parameters = {{"length", {0.01, 0.0}}, {"damping", {0.1, 0.0}}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  double states = 0.0, parameters = 0.0, innovations = 0.0;
  std::size_t taken = 0;
  constexpr int kRuns = 40;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const double length = std::log(0.3) + 0.01 * normal(random);
    const double damping = std::log(0.004) + 0.1 * normal(random);
    ArmRun run(armWith(std::exp(length), std::exp(damping)), settings, seed);
    run.resume(6.0);
    const KalmanFilter& filter = run.filter.filter();
    Eigen::Vector4d error = filter.state();
    error[0] -= run.q;
    error[1] -= run.v;
    error[2] -= std::log(0.3) - length;
    error[3] -= std::log(0.004) - damping;
    const Eigen::Matrix4d p = filter.covariance();
    states += error.head<2>().dot(p.topLeftCorner<2, 2>().inverse() * error.head<2>());
    parameters += error.tail<2>().dot(p.bottomRightCorner<2, 2>().inverse() * error.tail<2>());
    for (std::size_t k = 200; k < run.innovations.size(); ++k, ++taken) {
      innovations += run.innovations[k] * run.innovations[k];
    }
  }
  // Five standard deviations of the means.
  EXPECT_NEAR(states / kRuns, 2.0, 5.0 * 2.0 / std::sqrt(kRuns));
  EXPECT_NEAR(parameters / kRuns, 2.0, 5.0 * 2.0 / std::sqrt(kRuns));
  EXPECT_NEAR(innovations / static_cast<double>(taken), 1.0, 0.03);
}

/// An unscented filter of the arm (S. J. Julier, J. K. Uhlmann, Proc. IEEE 92, 2004; 2n points of
/// equal weight) with its own steps, angle, rate and length: no derivative in it.
class UnscentedArm {
 public:
  explicit UnscentedArm(double length) : x_(1.2, 0.0, std::log(length)) {
    p_ = Eigen::Vector3d(1.0, 100.0, 0.01 * 0.01).asDiagonal();
  }
  void resume(double h) {
    propagate([h](Eigen::Vector3d x) {
      const double length = std::exp(x[2]);
      const auto rate = [length](const Eigen::Vector3d& y) {
        const double damping = 0.004 / (0.5 * length * length);
        return Eigen::Vector3d(y[1], -9.80665 / length * std::sin(y[0]) - damping * y[1], 0.0);
      };
      const Eigen::Vector3d k1 = rate(x), k2 = rate(x + 0.5 * h * k1), k3 = rate(x + 0.5 * h * k2),
                            k4 = rate(x + h * k3);
      return Eigen::Vector3d(x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
    });
  }
  void take(double angle, double noise) {
    const Eigen::Vector3d gain = p_.col(0) / (p_(0, 0) + noise * noise);
    const double variance = p_(0, 0) + noise * noise;
    x_ += gain * (angle - x_[0]);
    p_ -= variance * gain * gain.transpose();
    p_ = (0.5 * (p_ + p_.transpose())).eval();
  }
  double length() const { return std::exp(x_[2]); }
  double deviation() const { return std::sqrt(p_(2, 2)); }

 private:
  template <class Motion>
  void propagate(const Motion& motion) {
    const Eigen::Matrix3d root = Eigen::LLT<Eigen::Matrix3d>(3.0 * p_).matrixL();
    std::array<Eigen::Vector3d, 6> points;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
      const auto column = root.col(static_cast<Eigen::Index>(i / 2));
      points[i] = motion(x_ + (i % 2 == 0 ? 1.0 : -1.0) * column);
      mean += points[i] / 6.0;
    }
    p_.setZero();
    for (const Eigen::Vector3d& point : points) {
      p_ += (point - mean) * (point - mean).transpose() / 6.0;
    }
    x_ = mean;
  }

  Eigen::Vector3d x_;
  Eigen::Matrix3d p_;
};

/// Two filters that share nothing but the problem give the same length, with the same uncertainty.
TEST(ExtendedKalmanFilter, AgreesWithAnUnscentedFilter) {
  SystemFollowing settings;
  settings.parameters = {{"length", {0.01, 0.0}}};
  ExtendedKalmanFilter filter(armWith(0.302, 0.004), 0, settings,
                              {angle("encoder/theta", 0, 0.002)});
  UnscentedArm unscented(0.302);
  Twin machine(sceneOf(kArm));
  std::vector<double> record(machine.layout().size);
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 0.002);
  filter.begin({0, {}, 0.0});
  for (int k = 1; k <= 10'000; ++k) {
    machine.step();
    machine.write(record.data());
    const double measured = machine.layout().system(record.data(), 0).q()[0] + noise(random);
    filter.goTo({machine.stepCount() * 1'000'000, {}, 0.0});
    filter.take(0, measured);
    unscented.resume(0.001);
    unscented.take(measured, 0.002);
  }
  const double deviation = filter.parameterDeviation(0) / filter.parameter(0);
  EXPECT_NEAR(deviation / unscented.deviation(), 1.0, 0.1);
  EXPECT_NEAR(std::log(filter.parameter(0) / unscented.length()), 0.0, deviation);
}

/// A rotor in a run-up through its critical speed in ten seconds, its probes with noise of 3 um; %
/// stands for parameters of the plant and of the model.
void runUp(const std::string& machine_parameters, const std::string& model_parameters,
           const SystemFollowing& settings,
           const std::function<void(const ExtendedKalmanFilter&)>& tell) {
  const auto with = [&](const std::string& parameters) {
    std::string scene = R"(
name: rig
step: 0.0005
drives:
  shaft: {speed: 60.0, profile: [{speed: 140.0, max_acceleration: 10.0, max_jerk: 50.0, dwell: 5.0}]}
systems:
  rotor: {model: jeffcott_rotor, drive: shaft, parameters: {%}}
)";
    scene.replace(scene.find('%'), 1, parameters);
    return scene;
  };
  Twin machine(sceneOf(with(machine_parameters)));
  const BuiltScene model = sceneOf(with(model_parameters));
  ExtendedKalmanFilter filter(
      model, 0, settings,
      {displacement("probes/x", 0.0, 3.0e-6), displacement("probes/y", M_PI / 2.0, 3.0e-6)});
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 3.0e-6);
  std::vector<double> record(machine.layout().size);
  const auto shaft = [&] {
    machine.write(record.data());
    const auto at = RecordLayout::shaft<const double>(record.data(), 0);
    return ShaftInstant{machine.stepCount() * 500'000, at.angle(), at.speed()};
  };
  filter.begin(shaft());
  for (int k = 0; k < 20'000; ++k) {
    machine.step();
    filter.goTo(shaft());
    const double* q = machine.layout().system<const double>(record.data(), 0).q();
    filter.take(0, q[0] + noise(random));
    filter.take(1, q[1] + noise(random));
  }
  tell(filter);
}

/// An unbalance of 40 g mm that the model has not: within 2 % and 2 degrees.
TEST(ExtendedKalmanFilter, FindsAnUnbalanceInARunUp) {
  SystemFollowing settings;
  settings.disturbance = 1.0e-3;
  settings.unbalance = {1.0e-3, 0.0};
  const std::string rotor = "mass: 2.0, stiffness: 20000.0, damping: 20.0, eccentricity: ";
  runUp(rotor + "2.0e-5", rotor + "0.0", settings, [](const ExtendedKalmanFilter& filter) {
    const Eigen::Vector2d u = filter.unbalance(0);
    EXPECT_NEAR(u.norm(), 4.0e-5, 0.02 * 4.0e-5);
    EXPECT_NEAR(std::atan2(u.y(), u.x()), 0.0, 2.0 * M_PI / 180.0);
    const double deviation = std::sqrt(filter.unbalanceCovariance(0)(0, 0));
    EXPECT_LT(deviation, 0.01 * 4.0e-5);
    EXPECT_NEAR(u.x(), 4.0e-5, 4.0 * deviation);
    EXPECT_NEAR(u.y(), 0.0, 4.0 * deviation);
  });
}

/// A negative parameter keeps its sign; its uncertainty is relative to its magnitude.
TEST(ExtendedKalmanFilter, FindsANegativeParameter) {
  SystemFollowing settings;
  settings.disturbance = 1.0e-3;
  settings.parameters = {{"cross_coupling", {0.4, 0.0}}};
  const std::string rotor =
      "mass: 2.0, stiffness: 20000.0, damping: 20.0, eccentricity: 2.0e-5, cross_coupling: ";
  ExtendedKalmanFilter begun(sceneOf(R"(
name: rig
step: 0.0005
drives: {shaft: {speed: 60.0}}
systems:
  rotor: {model: jeffcott_rotor, drive: shaft, parameters: {)" +
                                     rotor + "-400.0}}\n"),
                             0, settings, {displacement("probes/x", 0.0, 3.0e-6)});
  EXPECT_DOUBLE_EQ(begun.parameter(0), -400.0);
  EXPECT_DOUBLE_EQ(begun.parameterDeviation(0), 0.4 * 400.0);
  runUp(rotor + "-300.0", rotor + "-400.0", settings, [](const ExtendedKalmanFilter& filter) {
    EXPECT_NEAR(filter.parameter(0), -300.0, 4.0 * filter.parameterDeviation(0));
    EXPECT_LT(filter.parameterDeviation(0), 60.0);
  });
}

/// Stiffness 3 % and damping 30 % off at first: within 0.5 % and 20 % after one run-up.
TEST(ExtendedKalmanFilter, FindsStiffnessAndDampingInARunUp) {
  SystemFollowing settings;
  settings.disturbance = 1.0e-3;
  settings.parameters = {{"stiffness", {0.03, 0.0}}, {"damping", {0.3, 0.0}}};
  runUp("mass: 2.0, stiffness: 20000.0, damping: 20.0, eccentricity: 2.0e-5",
        "mass: 2.0, stiffness: 20600.0, damping: 26.0, eccentricity: 2.0e-5", settings,
        [](const ExtendedKalmanFilter& filter) {
          EXPECT_NEAR(filter.parameter(0), 20000.0, 0.005 * 20000.0);
          EXPECT_NEAR(filter.parameter(1), 20.0, 0.2 * 20.0);
          EXPECT_LT(filter.parameterDeviation(0), 0.005 * 20000.0);
          EXPECT_LT(filter.parameterDeviation(1), 0.2 * 20.0);
        });
}

}  // namespace system_filter_test
}  // namespace whirl_twin
