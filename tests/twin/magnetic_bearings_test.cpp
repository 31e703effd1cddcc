// Rotors on magnetic bearings in operation: by their force law far from the centre too, with any
// method, and the report at the limit of its validity.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "../scene/scenes.h"
#include "algebra/dense.h"
#include "allocation_guard.h"
#include "analysis/sampled_stability.h"
#include "analysis/validity.h"
#include "mechanics/magnetic_bearing.h"
#include "scene/closed_loop.h"
#include "scene/scene_error.h"
#include "twin/observer.h"
#include "twin/stop_text.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace magnetic_bearings_test {

/// A disc on a shaft and a magnet of ki 100 N/A, bias 2 A, gap 0.4 mm: ks = 5e5 N/m.
std::string disc(double step, double stiffness, const std::string& more) {
  return fmt::format(
      "{{step: {:.9f}, systems: {{r: {{model: jeffcott_rotor, parameters: {{mass: 2.0, stiffness: "
      "{}, damping: 30.0, magnets: [{{ki: 100.0, bias: 2.0, gap: 4.0e-4}}], speed: 300.0, "
      "eccentricity: 2.0e-6}}, {}",
      step, stiffness, more);
}

std::vector<double> motionOf(const Twin& twin) {
  std::vector<double> q(2 * twin.running(0).dof());
  twin.running(0).motion(q.data());
  return q;
}

std::vector<double> motionAfter(const Scene& scene, double seconds) {
  Twin twin(scene);
  const auto steps = std::llround(seconds / scene.stepSeconds());
  for (std::int64_t i = 0; i < steps; ++i) {
    twin.step();
    EXPECT_EQ(twin.status(0), StepStatus::kOk);
  }
  return motionOf(twin);
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size() / 2; ++i) {
    largest = std::max(largest, std::fabs(a[i] - b[i]));
  }
  return largest;
}

/// x and y of the disc with i = 0.3 cos(700 t) along x and 0 along y, by an independent method.
std::array<double, 4> byItself(double stiffness, double seconds) {
  const MagneticBearing magnet(100.0, 2.0, 4.0e-4, std::numeric_limits<double>::infinity());
  using State = std::array<double, 4>;  // x, y, and their rates
  const auto rate = [&](double t, const State& s) {
    const double unbalance = 2.0 * 2.0e-6 * 300.0 * 300.0;
    const double fx = magnet.axis(0.3 * std::cos(700.0 * t), s[0]).force +
                      unbalance * std::cos(300.0 * t) - stiffness * s[0] - 30.0 * s[2];
    const double fy = magnet.axis(0.0, s[1]).force + unbalance * std::sin(300.0 * t) -
                      stiffness * s[1] - 30.0 * s[3];
    return State{s[2], s[3], fx / 2.0, fy / 2.0};
  };
  State s{1.0e-4, -1.5e-4, 0.0, 0.0};
  const double h = 2.0e-6;
  const auto on = [&](const State& from, const State& by, double share) {
    State to = from;
    for (std::size_t i = 0; i < 4; ++i) {
      to[i] += share * h * by[i];
    }
    return to;
  };
  const auto steps = std::llround(seconds / h);
  for (std::int64_t i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) * h;
    const State a = rate(t, s);
    const State b = rate(t + 0.5 * h, on(s, a, 0.5));
    const State c = rate(t + 0.5 * h, on(s, b, 0.5));
    const State d = rate(t + h, on(s, c, 1.0));
    for (std::size_t k = 0; k < 4; ++k) {
      s[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
    }
  }
  return s;
}

constexpr const char* kShaken =
    "initial: {x: 1.0e-4, y: -1.5e-4}, inputs: {current_x: {amplitude: 0.3, frequency: 700.0}}}}}";

TEST(MagneticBearings, TakeADiscAlongAsTheirPolesPull) {
  const std::array<double, 4> exact = byItself(2.0e6, 0.05);
  const std::vector<double> motion = motionAfter(sceneOf(disc(2.0e-5, 2.0e6, kShaken)), 0.05);
  EXPECT_GT(std::fabs(exact[0]) + std::fabs(exact[1]), 1.0e-5);
  EXPECT_NEAR(motion[0], exact[0], 1e-10);
  EXPECT_NEAR(motion[1], exact[1], 1e-10);
}

TEST(MagneticBearings, AreSteppedToTheFourthOrder) {
  const auto after = [](double step, const std::string& more) {
    return motionAfter(sceneOf(disc(step, 2.0e6, more)), 0.05);
  };
  const std::string held =
      "initial: {x: 1.0e-4}}}, controllers: {pd: {type: pid, rate: 400.0, measures: [r.x, r.y], "
      "acts_on: [r.current_x, r.current_y], delay: 0.0008, actuator: {bandwidth: 300.0}, "
      "parameters: {kp: 400.0, ki: 0.0, kd: 0.0}}}}";
  for (const std::string& more : {std::string(kShaken), held}) {
    const std::vector<double> exact = after(1.0e-5, more);
    const double coarse = farthest(after(1.0e-4, more), exact);
    const double fine = farthest(after(5.0e-5, more), exact);
    EXPECT_GT(std::log2(coarse / fine), 3.7) << more;
    EXPECT_LT(fine, 1e-7) << more;
  }
}

/// A shaft on two magnetic bearings, reduced to eight or four modes.
std::string shaft(double step, int modes, const std::string& magnet, const std::string& more) {
  return fmt::format(
      "{{step: {:.9f}, drives: {{shaft: {{speed: 100.0, profile: [{{speed: 300.0, "
      "max_acceleration: 1000.0}}]}}}}, systems: {{r: {{model: flexible_rotor, drive: shaft, "
      "parameters: {{youngs_modulus: 2.1e+11, density: 7800.0, elements: [{{length: 0.1, "
      "outer_diameter: 0.025, count: 8}}], discs: [{{node: 4, mass: 4.0, polar_inertia: 0.02, "
      "transverse_inertia: 0.011}}], magnets: [{{node: 1, ki: 100.0, {}}}, {{node: 7, ki: 100.0, "
      "{}}}], unbalances: [{{node: 4, magnitude: 2.0e-4}}], stations: [{{node: 1}}], modes: "
      "{}}}}}}}, controllers: {{pd: {{type: pid, rate: 10000.0, measures: [r.node_1.x, r.node_1.y, "
      "r.node_7.x, r.node_7.y], acts_on: [r.current_x_1, r.current_y_1, r.current_x_7, "
      "r.current_y_7], delay: 5.0e-5, actuator: {{bandwidth: 3000.0}}, parameters: {{kp: 6000.0, "
      "ki: 20000.0, kd: 6.0, derivative_time: 1.0e-4}}}}}}{}}}",
      step, magnet, magnet, modes, more);
}
constexpr const char* kWithGap = "bias: 0.8, gap: 4.0e-4";
constexpr const char* kLinear = "ks: 2.0e+5";

// The work of a controller through a lag, and of the pole forces beyond the linear law, is included
// in the audit, in a run-up and at constant speed.
TEST(MagneticBearings, CloseTheEnergyBalance) {
  Twin twin(sceneOf(shaft(0.001, 8, kWithGap, "")));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    twin.step();
    ASSERT_EQ(twin.status(0), StepStatus::kOk);
    twin.write(record.data());
    observer.observe(record.data());
    largest = std::max(largest, std::fabs(observer.energyResidual(0)));
  }
  EXPECT_LT(largest, 1e-9);
}

TEST(MagneticBearings, StepWithoutAllocations) {
  Twin twin(sceneOf(shaft(0.001, 8, kWithGap, "")));
  const AllocationGuard guard;
  for (int i = 0; i < 50; ++i) {
    twin.step();
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

SampledLoop loopOf(const Scene& scene) {
  const ClosedLoop::Parts parts = *closedLoops(scene).front().parts(
      [&](std::size_t system) { return motionAtStart(scene, system); }, 100.0);
  return sampledLoop(parts.plant, parts.controllers);
}

// The model is its own linearization: the loop of small motions is that of ki and ks.
TEST(MagneticBearings, AreJudgedByTheirOwnLinearLaw) {
  const SampledLoop with_gap = loopOf(sceneOf(shaft(0.001, 8, kWithGap, "")));
  const SampledLoop linear = loopOf(sceneOf(shaft(0.001, 8, kLinear, "")));
  ASSERT_EQ(with_gap.transition.rows(), linear.transition.rows());
  EXPECT_LT((with_gap.transition - linear.transition).norm(), 1e-12 * linear.transition.norm());
  EXPECT_EQ(sampledStability(with_gap).verdict, Verdict::kAsymptoticallyStable);
}

// So small motions are those of the linear law, and larger ones are not.
TEST(MagneticBearings, OfSmallMotionsAreLinear) {
  const auto apart = [](double initial) {
    std::array<std::vector<double>, 2> motions;
    for (std::size_t i = 0; i < 2; ++i) {
      std::string text = disc(1.0e-4, 1.2e6, fmt::format("initial: {{x: {}}}}}}}}}", initial));
      if (i == 1) {
        text.replace(text.find("bias: 2.0, gap: 4.0e-4"), 22, "ks: 5.0e+5");
      }
      text.replace(text.find("2.0e-6"), 6, "0.0");
      motions[i] = motionAfter(sceneOf(text), 0.02);
    }
    return farthest(motions[0], motions[1]) / initial;
  };
  EXPECT_LT(apart(4.0e-8), 1e-6);
  EXPECT_GT(apart(1.2e-4), 1e-2);
}

// A rotor that reaches the poles stops with an error: none of its numbers becomes NaN.
TEST(MagneticBearings, StopWhatTouchesTheirPoles) {
  Twin twin(sceneOf(disc(1.0e-3, 1.0e5, "initial: {x: 1.0e-4}}}}")));
  int steps = 0;
  while (twin.status(0) == StepStatus::kOk && steps < 1000) {
    twin.step();
    ++steps;
  }
  EXPECT_EQ(twin.status(0), StepStatus::kNoGap);
  std::vector<double> record(twin.layout().size);
  twin.write(record.data());
  for (const double value : motionOf(twin)) {
    EXPECT_TRUE(std::isfinite(value));
  }
  const BuiltSystem& system = *twin.systems()[0];
  const std::string text = stopText(system, twin.layout().system(record.data(), 0),
                                    describe(twin.status(0)), steps, 0.1);
  EXPECT_NE(text.find("its shaft touches a bearing: the air gap or oil film is 0; last valid "
                      "state: x = 0.0002"),
            std::string::npos)
      << text;
  // Before that the remaining gap is a condition of the model.
  const Eigen::Vector2d near(3.5e-4, 1.0e-4);
  const std::vector<Condition> conditions =
      validity(*system.dynamics, near, Eigen::Vector2d::Zero(), {});
  ASSERT_EQ(conditions.size(), 1u);
  EXPECT_EQ(conditions[0].name, "gap_magnet");
  EXPECT_NEAR(conditions[0].margin, 5.0e-5, 1e-15);
}

// A rigid rotor that nothing but two magnets holds: each sees its own place along the shaft.
TEST(MagneticBearings, HoldARigidRotorAtTheirPlaces) {
  const Scene scene = sceneOf(
      "{step: 0.001, systems: {r: {model: rigid_disc_rotor, parameters: {mass: 3.0, polar_inertia: "
      "0.02, transverse_inertia: 0.03, speed: 500.0, magnets: [{position: -0.1, ki: 50.0, bias: "
      "2.0, gap: 5.0e-4}, {position: 0.15, ki: 50.0, ks: 1.0e+5}]}, initial: {x: 1.0e-4, beta: "
      "2.0e-4}}}, controllers: {pd: {type: pid, rate: 10000.0, measures: [r.magnet_1.x, "
      "r.magnet_1.y, r.magnet_2.x, r.magnet_2.y], acts_on: [r.current_x_1, r.current_y_1, "
      "r.current_x_2, r.current_y_2], parameters: {kp: 12000.0, ki: 0.0, kd: 12.0}}}}");
  const Dynamics& dynamics = *scene.systems[0].setup->made.dynamics;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(4);
  const Linearization l = dynamics.linearization(zero, zero, zero, {0.0, 0.0, 500.0, 0.0});
  const double ks1 = 50.0 * 2.0 / 5.0e-4;
  EXPECT_NEAR(l.stiffness(0, 0), -ks1 - 1.0e5, 1e-6);
  EXPECT_NEAR(l.stiffness(0, 3), 0.1 * ks1 - 0.15 * 1.0e5, 1e-6);
  EXPECT_NEAR(l.stiffness(1, 2), -0.1 * ks1 + 0.15 * 1.0e5, 1e-6);
  EXPECT_NEAR(l.stiffness(3, 3), -0.01 * ks1 - 0.0225 * 1.0e5, 1e-6);
  EXPECT_EQ(sampledStability(loopOf(scene)).verdict, Verdict::kAsymptoticallyStable);
  const std::vector<double> settled = motionAfter(scene, 1.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(std::fabs(settled[i]), 1.0e-7) << i;
  }
}

/// A rigid rotor of unit mass and transverse inertia, polar inertia 1.2, on magnetic bearings 1 m
/// to both sides whose negative stiffness is 1 in displacement and in tilt. Both are controlled by
/// 2 z + sqrt(2) z' of samples with a total delay `late` [s]; a torque of `cross` times the tilt
/// rates, rotated by a quarter turn, is added.
std::string tilting(double speed, double late, double cross) {
  constexpr double kPeriod = 0.01;
  Eigen::Matrix4d rates = std::sqrt(0.5) * Eigen::Matrix4d::Identity();
  const double c = 0.25 * cross;  // of x1, y1, x2, y2
  rates(0, 1) -= c, rates(0, 3) += c, rates(1, 0) += c, rates(1, 2) -= c;
  rates(2, 1) += c, rates(2, 3) -= c, rates(3, 0) -= c, rates(3, 2) += c;
  const auto rows = [](const Eigen::Matrix4d& m) {
    std::string text;
    for (int i = 0; i < 4; ++i) {
      text += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}, {:.17g}]", i == 0 ? "[" : ", ", m(i, 0),
                          m(i, 1), m(i, 2), m(i, 3));
    }
    return text + "]";
  };
  const Eigen::Matrix4d none = Eigen::Matrix4d::Zero();
  const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
  // Outputs are held for a period, and differences are of a period: half of each is late.
  return fmt::format(
      "{{step: 0.01, systems: {{r: {{model: rigid_disc_rotor, parameters: {{mass: 1.0, "
      "polar_inertia: 1.2, transverse_inertia: 1.0, speed: {:.17g}, magnets: [{{position: -1.0, "
      "ki: 1.0, ks: 0.5}}, {{position: 1.0, ki: 1.0, ks: 0.5}}]}}, initial: {{beta: 1.0e-3}}}}}}, "
      "controllers: {{tilt: {{type: linear, rate: 100.0, measures: [r.magnet_1.x, r.magnet_1.y, "
      "r.magnet_2.x, r.magnet_2.y], acts_on: [r.current_x_1, r.current_y_1, r.current_x_2, "
      "r.current_y_2], delay: {:.9f}, parameters: {{a: {}, b: {}, c: {}, d: {}}}}}}}}}",
      speed, late - kPeriod, rows(none), rows(one), rows(rates / kPeriod),
      rows(-one - rates / kPeriod));
}

// The faster a rotor turns the faster it nutates, until its controller comes too late. Without a
// delay it is stable at any speed; the thresholds of so late a continuous law are exact. A torque a
// quarter turn on, against the gyroscopic effect, holds it beyond.
TEST(MagneticBearings, HoldATiltingRotorUpToASpeedAndWithCrossCouplingBeyond) {
  const auto radius = [](double speed, double late, double cross) {
    const Scene scene = sceneOf(tilting(speed, late, cross));
    const ClosedLoop::Parts parts = *closedLoops(scene).front().parts(
        [&](std::size_t system) { return motionAtStart(scene, system); }, speed);
    return eigenvalues(sampledLoop(parts.plant, parts.controllers).transition)
        .values.cwiseAbs()
        .maxCoeff();
  };
  for (const auto& [late, threshold] :
       {std::pair{0.05, 24.254970788536}, {0.1, 11.166108253016}, {0.2, 4.613163688883}}) {
    EXPECT_LT(radius(0.98 * threshold, late, 0.0), 1.0) << late;
    EXPECT_GT(radius(1.02 * threshold, late, 0.0), 1.0) << late;
  }
  const double beyond = 1.5 * 11.166108253016;
  EXPECT_LT(radius(beyond, 0.1, 1.5), 1.0);
  EXPECT_LT(std::fabs(motionAfter(sceneOf(tilting(beyond, 0.1, 1.5)), 200.0)[3]), 2.0e-4);
  EXPECT_GT(std::fabs(motionAfter(sceneOf(tilting(beyond, 0.1, 0.0)), 200.0)[3]), 1.0);
}

struct Refused {
  std::string model, parameters, message;
};

TEST(MagneticBearings, LeaveARotorRoomWhereItStarts) {
  try {
    sceneOf(disc(1.0e-3, 2.0e6, "initial: {x: 4.5e-4}}}}"));
    ADD_FAILURE() << "was accepted";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.errors().size(), 1u) << error.what();
    EXPECT_EQ(
        error.errors()[0],
        "test.yaml: systems.r.initial: the motion cannot start here: the rotor touches magnet "
        "(gap_magnet -5e-05 m)");
  }
}

TEST(MagneticBearings, AreRefusedWhereTheyDoNotFitTogether) {
  const std::string jeffcott = "speed: 5.0, mass: 1.0, stiffness: 100.0, ";
  for (const Refused& r : std::vector<Refused>{
           {"jeffcott_rotor", jeffcott + "magnets: [{ki: 10.0}]",
            "magnets[0].ks: must be > 0 N/m, unless bias and gap are given"},
           {"jeffcott_rotor", jeffcott + "magnets: [{ki: 10.0, bias: 1.0}]",
            "magnets[0].gap: must be > 0 m with bias"},
           {"jeffcott_rotor", jeffcott + "magnets: [{ki: 10.0, gap: 1.0e-3}]",
            "magnets[0].bias: must be > 0 A with gap"},
           {"jeffcott_rotor", jeffcott + "magnets: [{ki: 10.0, gap: 1.0e-3, bias: 2.0, ks: 3.0}]",
            "magnets[0].ks: must not be given with gap, which gives ki bias / gap = 20000 N/m, "
            "found 3"},
           {"jeffcott_rotor",
            jeffcott + "magnets: [{ki: 10.0, gap: 1.0e-3, bias: 2.0, saturation: 5.0}]",
            "magnets[0].saturation: must be > ki bias / 4 = 5 N, the force of a pole at its bias, "
            "found 5"},
           {"jeffcott_rotor", jeffcott + "magnets: [{ki: 10.0, ks: 3.0}, {ki: 10.0, ks: 3.0}]",
            "magnets: must be one map, at the disc, found 2"},
           {"jeffcott_rotor", jeffcott + "loss_factor: 0.1, magnets: [{ki: 10.0, ks: 3.0}]",
            "magnets: must not be given with a motor, a loss_factor, a rub or journal bearings"},
           {"rigid_disc_rotor",
            "speed: 5.0, mass: 1.0, transverse_inertia: 0.1, polar_inertia: 0.1, frame: rotating, "
            "stiffness_displacement: 10.0, stiffness_rotation: 1.0, magnets: [{ki: 1.0, ks: 3.0}]",
            "magnets: need frame: fixed"}}) {
    try {
      sceneOf("{step: 0.001, systems: {r: {model: " + r.model + ", parameters: {" + r.parameters +
              "}}}}");
      ADD_FAILURE() << "was accepted: " << r.parameters;
    } catch (const SceneError& error) {
      ASSERT_EQ(error.errors().size(), 1u) << error.what();
      EXPECT_EQ(error.errors()[0], "test.yaml: systems.r.parameters." + r.message);
    }
  }
}

}  // namespace magnetic_bearings_test
}  // namespace whirl_twin
