// Information on a rotor's parameters in a run-up, and the efficiency of the filter: its standard
// deviations, and the actual scatter of its estimates, reach Cramér and Rao's bound, which no
// unbiased estimate from the same samples can undercut; and with the sensors of a scene, a
// keyphasor of 4096 steps and run-out under the probes, it finds the true values.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <vector>

#include "../extremes/measured.h"
#include "followed_machine.h"

namespace whirl_twin {
namespace cramer_rao_test {

constexpr double kMass = 2.0, kStiffness = 20000.0, kDamping = 20.0, kEccentricity = 2.0e-5;
constexpr double kNoise = 3.0e-6;        // m
constexpr std::int64_t kRatio = 4;       // steps from sample to sample
constexpr std::int64_t kSteps = 20'000;  // 10 s
const std::string kSensors = R"(
sensors:
  probes:
    rate: 1000.0
    block: 0.1
    seed: SEED
    channels:
      x: {measures: rotor.x, noise: 3.0e-6, run_out: 8.0e-6}
      y: {measures: rotor.y, noise: 3.0e-6, run_out: 8.0e-6}
  tacho: {keyphasor: shaft, jitter: 4.4e-6, block: 0.1}
)";

/// Through the critical speed, 100 rad/s, in eight seconds.
std::string rotor(double stiffness, double damping, double eccentricity) {
  return fmt::format(R"(
name: rig
step: 0.0005
drives:
  shaft: {{speed: 60.0, profile: [{{speed: 140.0, max_acceleration: 10.0, max_jerk: 50.0, dwell: 5.0}}]}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {{mass: {}, stiffness: {:.17g}, damping: {:.17g}, eccentricity: {:.17g}}}
)",
                     kMass, stiffness, damping, eccentricity);
}

struct RunUp {
  std::vector<std::complex<double>> z;  ///< [m], at each sample
  std::vector<ShaftInstant> shaft;

  RunUp(double stiffness, double damping, double eccentricity) {
    Twin machine(builtSceneOf(rotor(stiffness, damping, eccentricity)));
    std::vector<double> record(machine.layout().size);
    for (std::int64_t k = 0; k <= kSteps; ++k) {
      if (k % kRatio == 0) {
        machine.write(record.data());
        const double* const q = machine.layout().system<const double>(record.data(), 0).q();
        const auto at = RecordLayout::shaft<const double>(record.data(), 0);
        z.emplace_back(q[0], q[1]);
        shaft.push_back({machine.stepCount() * 500'000, at.angle(), at.speed()});
      }
      machine.step();
    }
  }
};

/// Standard deviations that cannot be gone below of: log stiffness, log damping, unbalance along
/// and across [kg m], the motion at the start being unknown, too.
Eigen::Vector4d bound(const RunUp& truth) {
  constexpr double kPart = 1.0e-4;
  const auto difference = [&](const RunUp& more, const RunUp& less, double by) {
    std::vector<std::complex<double>> d;
    for (std::size_t i = 0; i < more.z.size(); ++i) {
      d.push_back((more.z[i] - less.z[i]) / by);
    }
    return d;
  };
  const auto of = [](double k, double c, double e) {
    return RunUp(kStiffness * k, kDamping * c, kEccentricity * e);
  };
  const auto by_stiffness = difference(of(1.0 + kPart, 1, 1), of(1.0 - kPart, 1, 1), 2.0 * kPart);
  const auto by_damping = difference(of(1, 1.0 + kPart, 1), of(1, 1.0 - kPart, 1), 2.0 * kPart);
  const auto by_unbalance = difference(of(1, 1, 2), of(1, 1, 1), kMass * kEccentricity);
  const double decay = kDamping / (2.0 * kMass);
  const std::complex<double> root(-decay, std::sqrt(kStiffness / kMass - decay * decay));
  const std::complex<double> i(0.0, 1.0);
  Eigen::Matrix<double, 8, 8> information = Eigen::Matrix<double, 8, 8>::Zero();
  for (std::size_t n = 1; n < truth.z.size(); ++n) {
    const double t = 1.0e-9 * static_cast<double>(truth.shaft[n].time);
    const std::complex<double> forward = std::exp(root * t), backward = std::conj(forward);
    const std::complex<double> columns[8] = {
        by_stiffness[n], by_damping[n], by_unbalance[n], i * by_unbalance[n],
        forward,         i * forward,   backward,        i * backward};
    Eigen::Matrix<double, 8, 2> of_probes;
    for (int k = 0; k < 8; ++k) {
      of_probes(k, 0) = columns[k].real();
      of_probes(k, 1) = columns[k].imag();
    }
    information += of_probes * of_probes.transpose() / (kNoise * kNoise);
  }
  // Numbers of very different sizes: scaled to a unit diagonal, else the inverse has no digits.
  const Eigen::Matrix<double, 8, 1> scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 8, 8> scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::Matrix<double, 8, 8> inverse = scaled.inverse();
  return (scale.cwiseAbs2().cwiseProduct(inverse.diagonal())).cwiseSqrt().head<4>();
}

EstimatorChannel probe(const char* name, double direction) {
  EstimatorChannel channel;
  channel.name = name;
  channel.signal.kind = SignalSpec::Kind::kDisplacement;
  channel.signal.direction = direction;
  channel.signal.unit = "m";
  channel.deviation = kNoise;
  return channel;
}

/// 60 run-ups, each started from parameters drawn from the filter's prior (1,000 with
/// WHIRL_TWIN_EXTREMES=full).
TEST(CramerRao, IsReachedByTheFilterWithinATenth) {
  const RunUp truth(kStiffness, kDamping, kEccentricity);
  const Eigen::Vector4d least = bound(truth);
  SystemFollowing settings;
  settings.parameters = {{"stiffness", {0.01, 0.0}}, {"damping", {0.1, 0.0}}};
  settings.unbalance = {1.0e-4, 0.0};
  const auto runs = static_cast<int>(runOf(60, 1000));
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Eigen::Vector4d squares = Eigen::Vector4d::Zero(), reported = Eigen::Vector4d::Zero();
  int held = 0;
  for (int run = 0; run < runs; ++run) {
    const double stiffness = kStiffness * std::exp(0.01 * normal(random));
    const double damping = kDamping * std::exp(0.1 * normal(random));
    ExtendedKalmanFilter filter(builtSceneOf(rotor(stiffness, damping, 0.0)), 0, settings,
                                {probe("probes/x", 0.0), probe("probes/y", M_PI / 2.0)});
    filter.begin(truth.shaft[0]);
    for (std::size_t k = 1; k < truth.z.size(); ++k) {
      filter.goTo(truth.shaft[k]);
      filter.take(0, truth.z[k].real() + kNoise * normal(random));
      filter.take(1, truth.z[k].imag() + kNoise * normal(random));
    }
    const Eigen::Vector2d u = filter.unbalance(0);
    const Eigen::Vector4d error(std::log(filter.parameter(0) / kStiffness),
                                std::log(filter.parameter(1) / kDamping),
                                u.x() - kMass * kEccentricity, u.y());
    const Eigen::Matrix2d of_unbalance = filter.unbalanceCovariance(0);
    const Eigen::Vector4d deviation(filter.parameterDeviation(0) / filter.parameter(0),
                                    filter.parameterDeviation(1) / filter.parameter(1),
                                    std::sqrt(of_unbalance(0, 0)), std::sqrt(of_unbalance(1, 1)));
    squares += error.cwiseQuotient(least).cwiseAbs2() / runs;
    reported += deviation.cwiseQuotient(least) / runs;
    held += static_cast<int>((error.array().abs() < 1.96 * deviation.array()).count());
  }
  for (int i = 0; i < 4; ++i) {
    const char* const names[] = {"stiffness", "damping", "unbalance along", "unbalance across"};
    fmt::print("[ MEASURED ] {}: bound {:.3g}, told {:.3f}, scatter {:.3f} of it\n", names[i],
               least[i], reported[i], std::sqrt(squares[i]));
    EXPECT_NEAR(reported[i], 1.0, 0.1) << names[i];
    // The scatter of so many runs is known to 1/sqrt(2 runs).
    EXPECT_NEAR(std::sqrt(squares[i]), 1.0, std::max(0.1, 3.0 / std::sqrt(2.0 * runs))) << names[i];
  }
  EXPECT_NEAR(std::sqrt(squares.mean()), 1.0, 0.1);
  const double share = held / (4.0 * runs);
  EXPECT_NEAR(share, 0.95, runs == 1000 ? 0.02 : 3.0 * std::sqrt(0.95 * 0.05 / (4.0 * runs)));
}

/// Seen through the sensors, nothing known but the order of size: a stiffness 3 % and a damping 30
/// % off, no unbalance, run-out not known. Four run-ups, the worst of each number.
TEST(FollowedRunUp, TellsUnbalanceStiffnessAndDampingThroughTheSensors) {
  FollowSettings settings;
  SystemFollowing& rotor_settings = settings.systems["rotor"];
  rotor_settings.disturbance = 1.0e-3;
  rotor_settings.parameters = {{"stiffness", {0.03, 0.0}}, {"damping", {0.3, 0.0}}};
  rotor_settings.unbalance = {1.0e-4, 0.0};
  rotor_settings.run_out = 1.0e-5;
  constexpr int kRunUps = 4;
  double widest[4] = {};
  for (int seed = 1; seed <= kRunUps; ++seed) {
    std::string sensors = kSensors;
    sensors.replace(sensors.find("SEED"), 4, std::to_string(seed));
    Machine machine(rotor(kStiffness, kDamping, kEccentricity) + sensors);
    Twinned twin(rotor(1.03 * kStiffness, 1.3 * kDamping, 0.0) + sensors, settings);
    while (machine.time() < 10.0) {
      for (const state::Measurement& m : machine.step()) {
        twin.follower.take(m);
      }
    }
    twin.follower.finish();
    const ExtendedKalmanFilter* const filter = twin.follower.filter(0);
    ASSERT_NE(filter, nullptr);
    const Eigen::Vector2d u = filter->unbalance(0);
    const double off[4] = {std::fabs(filter->parameter(0) / kStiffness - 1.0),
                           std::fabs(filter->parameter(1) / kDamping - 1.0),
                           std::fabs(u.norm() / (kMass * kEccentricity) - 1.0),
                           std::fabs(std::atan2(u.y(), u.x())) * 180.0 / M_PI};
    for (int i = 0; i < 4; ++i) {
      widest[i] = std::max(widest[i], off[i]);
    }
  }
  expectWithin(0.005, widest[0], "stiffness, off by parts of it");
  expectWithin(0.2, widest[1], "damping, off by parts of it");
  expectWithin(0.02, widest[2], "unbalance, off by parts of it");
  expectWithin(2.0, widest[3], "unbalance's angle, off by degrees");
}

}  // namespace cramer_rao_test
}  // namespace whirl_twin
