// Controllers of a running twin: sampled at their own instants, delayed, with zero-order hold.
#include "twin/control_loop.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "analysis/sampled_loop.h"
#include "scene/closed_loop.h"
#include "twin/observer.h"
#include "twin/trial_steps.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace control_loop_test {

/// x'' = x + u, levitated by u = -(kp x + kd x'), the derivative a backward difference.
struct Levitation {
  std::int64_t step;   // ns
  double rate;         // Hz
  std::int64_t delay;  // ns
  double kp = 2.0, kd = std::sqrt(2.0);
};

Scene levitated(const Levitation& l, const std::string& further = "") {
  return sceneOf(fmt::format(
      "{{step: {:.9f}, systems: {{s: {{model: linear_system, integrator: exponential, parameters: "
      "{{names: [x], mass: [[1.0]], stiffness: [[-1.0]]}}, initial: {{x: 1.0e-3, "
      "x_rate: 2.0e-4}}}}}}, controllers: {{pd: {{type: pid, rate: {:.17g}, measures: [s.x], "
      "acts_on: [s.force_x], delay: {:.9f}, parameters: {{kp: {:.17g}, ki: 0.0, kd: "
      "{:.17g}}}{}}}}}}}",
      static_cast<double>(l.step) / 1e9, l.rate, static_cast<double>(l.delay) / 1e9, l.kp, l.kd,
      further));
}

/// The same in long doubles, from instant to instant by the closed solution of x'' = x + u.
class Exactly {
 public:
  explicit Exactly(const Levitation& l) : l_(l) {}

  /// Continues to a time [ns], before the events there.
  void goTo(std::int64_t time) {
    while (true) {
      const std::int64_t sample = instant(k_);
      const std::int64_t output =
          pending_.empty() ? INT64_MAX : instant(pending_.begin()->first) + l_.delay;
      const std::int64_t next = std::min(sample, output);
      if (next >= time) {
        pass(time);
        return;
      }
      pass(next);
      if (output == next) {
        u_ = pending_.begin()->second;
        pending_.erase(pending_.begin());
      }
      if (sample == next) {
        takeSample();
      }
    }
  }
  long double x() const { return x_; }
  long double v() const { return v_; }

 private:
  std::int64_t instant(std::int64_t k) const {
    return std::llroundl(static_cast<long double>(k) * 1.0e9L / l_.rate);
  }
  void pass(std::int64_t time) {
    const long double t = static_cast<long double>(time - time_) * 1.0e-9L;
    const long double c = std::cosh(t);
    const long double s = std::sinh(t);
    const long double x = c * x_ + s * v_ + (c - 1.0L) * u_;
    v_ = s * x_ + c * v_ + s * u_;
    x_ = x;
    time_ = time;
  }
  void takeSample() {
    const long double last = k_ == 0 ? x_ : last_;
    const long double u = -(l_.kp * x_ + l_.kd * (x_ - last) * l_.rate);
    last_ = x_;
    if (l_.delay == 0) {
      u_ = u;
    } else {
      pending_[k_] = u;
    }
    ++k_;
  }

  Levitation l_;
  std::int64_t time_ = 0;  // ns
  std::int64_t k_ = 0;
  long double x_ = 1.0e-3L, v_ = 2.0e-4L, u_ = 0.0L, last_ = 0.0L;
  std::map<std::int64_t, long double> pending_;
};

struct Motion {
  double x, v;
};

Motion motionOf(const Twin& twin, std::size_t system = 0) {
  std::vector<double> q(2 * twin.running(system).dof());
  twin.running(system).motion(q.data());
  return {q[0], q[q.size() / 2]};
}

class SampledLoop : public testing::TestWithParam<Levitation> {};

TEST_P(SampledLoop, GoesAsTheClosedSolutionFromInstantToInstant) {
  const Levitation& l = GetParam();
  Twin twin(levitated(l));
  Exactly exact(l);
  long double largest = 0.0L;
  for (std::int64_t i = 1; i <= 20'000'000'000 / l.step; ++i) {
    twin.step();
    exact.goTo(i * l.step);
    const Motion motion = motionOf(twin);
    // Rounding of earlier values included: the motion decays.
    largest = std::max({0.99L * largest, std::fabs(exact.x()), std::fabs(exact.v())});
    ASSERT_NEAR(motion.x, static_cast<double>(exact.x()), 1e-12 * static_cast<double>(largest))
        << "step " << i;
    ASSERT_NEAR(motion.v, static_cast<double>(exact.v()), 1e-12 * static_cast<double>(largest))
        << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ratios, SampledLoop,
    testing::Values(Levitation{100'000'000, 10.0, 0},                // a step a sample
                    Levitation{100'000'000, 10.0, 100'000'000},      // one sample late
                    Levitation{100'000'000, 10.0, 30'000'000},       // inside a step
                    Levitation{1'000'000, 20.0, 30'000'000},         // many steps a sample
                    Levitation{70'000'000, 1.0 / 0.03, 17'000'000},  // 7:3
                    Levitation{30'000'000, 1.0 / 0.07, 81'000'000},  // 3:7, more than a sample late
                    Levitation{100'000'000, 30.0, 12'345'678},  // a period that is no whole number
                    Levitation{10'000'000, 17.3, 1}),
    [](const testing::TestParamInfo<Levitation>& at) { return fmt::format("case_{}", at.index); });

// With a whole sample of delay more than the loop can bear (design tables: 0.3105 s) it is lost.
TEST(SampledLoop, IsUnstableWhereTheTableSaysSo) {
  for (const bool beyond : {false, true}) {
    const std::int64_t period = beyond ? 312'000'000 : 309'000'000;
    Twin twin(levitated(Levitation{period, 1e9 / static_cast<double>(period), period}));
    for (int i = 0; i < 10000; ++i) {
      twin.step();
    }
    EXPECT_EQ(std::fabs(motionOf(twin).x) > 1.0, beyond);
  }
}

TEST(SampledLoop, GivesNothingBeforeItsFirstOutput) {
  Twin twin(levitated(Levitation{10'000'000, 10.0, 250'000'000}));
  for (int i = 0; i < 25; ++i) {
    twin.step();
    EXPECT_EQ(twin.control().controllers()[0].acting(0), 0.0);
  }
  const double x = 1.0e-3 * std::cosh(0.25) + 2.0e-4 * std::sinh(0.25);
  EXPECT_NEAR(motionOf(twin).x, x, 1e-15);
  twin.step();
  EXPECT_NEAR(twin.control().controllers()[0].acting(0), -2.0e-3, 1e-17);
}

TEST(SampledLoop, GivesTheSameNumbersAgainAfterAReset) {
  const std::string noisy =
      ", sensor: {noise: 1.0e-5, resolution: 1.0e-6, range: 1.0, bandwidth: 40.0, seed: 7}, "
      "actuator: {limit: 1.0e-3, slew: 0.1, resolution: 1.0e-6, bandwidth: 30.0}";
  Twin twin(levitated(Levitation{3'000'000, 200.0, 7'000'000}, noisy));
  std::vector<double> first;
  for (int run = 0; run < 2; ++run) {
    for (int i = 0; i < 500; ++i) {
      twin.step();
      const Motion motion = motionOf(twin);
      const double u = twin.control().controllers()[0].acting(0);
      const std::size_t at = 3 * static_cast<std::size_t>(i);
      if (run == 0) {
        first.insert(first.end(), {motion.x, motion.v, u});
      } else {
        ASSERT_EQ(motion.x, first[at]);
        ASSERT_EQ(motion.v, first[at + 1]);
        ASSERT_EQ(u, first[at + 2]);
      }
    }
    EXPECT_GT(twin.control().controllers()[0].count().saturated, 0);
    twin.reset();
    EXPECT_EQ(twin.control().controllers()[0].count().samples, 0);
  }
}

// An actuator: no more than its limit, no faster than its slew, whole multiples of its resolution.
TEST(SampledLoop, ActsAsItsActuatorCan) {
  Twin twin(levitated(Levitation{10'000'000, 100.0, 0},
                      ", actuator: {limit: 1.5e-3, slew: 0.05, resolution: 1.0e-4}"));
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    twin.step();
    const double u = twin.control().controllers()[0].acting(0);
    EXPECT_LE(std::fabs(u), 1.5e-3);
    EXPECT_LE(std::fabs(u - last), 5.0e-4 * (1.0 + 1e-12));
    EXPECT_NEAR(u / 1.0e-4, std::nearbyint(u / 1.0e-4), 1e-9);
    last = u;
  }
}

// A command within its limit is realized bit-identically: rounding is no saturation.
TEST(SampledLoop, CountsOnlyWhatItsActuatorCannotGive) {
  Twin twin(levitated(Levitation{10'000'000, 100.0, 0},
                      ", sensor: {noise: 1.0e-5}, actuator: {limit: 100.0}"));
  for (int i = 0; i < 1000; ++i) {
    twin.step();
  }
  EXPECT_EQ(twin.control().controllers()[0].count().samples, 1000);
  EXPECT_EQ(twin.control().controllers()[0].count().saturated, 0);
}

/// x'' = -k x + u behind a lag, with a PD controller, off the steps and delayed by a fraction of a
/// sample.
struct Lagged {
  double stiffness, kp, kd, bandwidth;
  int periods;  // of 7 samples and 3 steps
};

// The loop that the twin runs and the one evaluated for stability are the same: from sample to
// sample the former follows the powers of the latter's matrix, including the state of the
// actuator's lag.
TEST(SampledLoop, BehindALagGoesAsThePowersOfItsMatrix) {
  for (const Lagged& l : {Lagged{-1.0, 2.0, std::sqrt(2.0), 1.6, 500},
                          Lagged{1.0, 1.0e-3, 3.0e-3, 0.5, 14300}}) {  // 1e5 samples
    const double period = 0.03;
    const Scene scene = sceneOf(fmt::format(
        "{{step: 0.07, systems: {{s: {{model: linear_system, integrator: exponential, parameters: "
        "{{names: [x], mass: [[1.0]], stiffness: [[{}]]}}, initial: {{x: 1.0e-3}}}}}}, "
        "controllers: {{pd: {{type: linear, rate: {:.17g}, measures: [s.x], acts_on: [s.force_x], "
        "delay: 0.017, actuator: {{bandwidth: {}}}, parameters: {{a: [[0.0]], b: [[1.0]], c: "
        "[[{:.17g}]], d: [[{:.17g}]]}}}}}}}}",
        l.stiffness, 1.0 / period, l.bandwidth, l.kd / period, -l.kp - l.kd / period));
    const ClosedLoop::Parts parts = *closedLoops(scene).front().parts(
        [&](std::size_t system) { return motionAtStart(scene, system); }, 0.0);
    const Eigen::MatrixXd sample = sampledLoop(parts.plant, parts.controllers).transition;
    ASSERT_EQ(sample.rows(), 5);  // x and its rate, the lag, the law's state, an output on its way
    Eigen::VectorXd state = 1.0e-3 * Eigen::VectorXd::Unit(5, 0);
    Twin twin(scene);
    double largest = 1.0e-3;
    for (int i = 0; i < l.periods; ++i) {
      for (int k = 0; k < 7; ++k) {
        state = sample * state;
      }
      for (int k = 0; k < 3; ++k) {
        twin.step();
      }
      largest = std::max(largest, state.norm());
      const Motion motion = motionOf(twin);
      ASSERT_NEAR(motion.x, state[0], 1e-12 * largest) << "period " << i;
      ASSERT_NEAR(motion.v, state[1], 1e-12 * largest) << "period " << i;
      ASSERT_NEAR(twin.control().controllers()[0].acting(0), state[2], 1e-12 * largest);
    }
  }
}

TEST(SampledLoop, AllocatesNothing) {
  Twin twin(levitated(
      Levitation{7'000'000, 100.0, 23'000'000},
      ", sensor: {noise: 1.0e-6, bandwidth: 40.0}, actuator: {limit: 1.0, bandwidth: 9.0}"));
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    twin.step();
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

/// The largest energy residual of a run.
double residualOf(const Scene& scene, int steps) {
  Twin twin(scene);
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  double largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
    largest = std::max(largest, std::fabs(observer.energyResidual(0)));
  }
  return largest;
}

TEST(SampledLoop, ClosesTheEnergyBalance) {
  for (const char* const lag : {"", ", actuator: {bandwidth: 5.0}"}) {
    EXPECT_LT(residualOf(levitated(Levitation{10'000'000, 43.0, 12'000'000}, lag), 1000), 1e-9);
  }
}

/// A pendulum held aside by a torque that is sampled off its steps.
std::string heldPendulum(const std::string& integrator, std::int64_t step, double bandwidth) {
  return fmt::format(
      "{{step: {:.9f}, systems: {{p: {{model: pendulum, integrator: {}, parameters: {{mass: 1.0, "
      "length: 0.5, inertia: 0.25, damping: 0.02}}, initial: {{theta: 1.2}}}}}}, controllers: "
      "{{hold: {{type: "
      "pid, rate: 37.0, measures: [p.theta], acts_on: [p.torque], delay: 0.011, actuator: "
      "{{bandwidth: "
      "{}}}, parameters: {{kp: 6.0, ki: 0.0, kd: 0.4}}}}}}}}",
      static_cast<double>(step) / 1e9, integrator, bandwidth);
}

/// The error of an angle after a second.
double errorOf(const std::string& integrator, std::int64_t step, double bandwidth) {
  const auto angle = [&](const std::string& method, std::int64_t of_step) {
    Twin twin(sceneOf(heldPendulum(method, of_step, bandwidth)));
    for (std::int64_t i = 0; i < 1'000'000'000 / of_step; ++i) {
      twin.step();
    }
    return motionOf(twin).x;
  };
  return std::fabs(angle(integrator, step) - angle("dormand_prince_8", 1'000'000));
}

// Instants inside a step are breakpoints: a method keeps its order across them. Sub-steps are as
// long as a step at most, so the order shows where steps are short relative to the 11 ms from
// sample to output.
TEST(SampledLoop, KeepsTheOrderOfAMethod) {
  for (const auto& [integrator, order] :
       std::map<std::string, double>{{"runge_kutta_4", 4.0},
                                     {"gauss_legendre_4", 4.0},
                                     {"velocity_verlet", 2.0},
                                     {"implicit_midpoint", 2.0}}) {
    for (const double bandwidth : {0.0, 12.0}) {
      const double coarse = errorOf(integrator, 3'125'000, bandwidth);
      const double fine = errorOf(integrator, 781'250, bandwidth);
      EXPECT_GT(std::log2(coarse / fine) / 2.0, order - 0.4) << integrator << ", " << bandwidth;
    }
  }
}

// A rotor in a run-up, whose table over speed has a map for every sub-step, and the same with a
// general method: a bearing's stiffness provided by a controller.
TEST(SampledLoop, OfARotorInARunUpGoesAsByAnotherMethod) {
  const auto rotor = [](const std::string& integrator, std::int64_t step) {
    return sceneOf(fmt::format(
        "{{step: {:.9f}, drives: {{shaft: {{speed: 20.0, profile: [{{speed: 140.0, "
        "max_acceleration: 100.0}}]}}}}, systems: {{r: {{model: jeffcott_rotor, drive: shaft, "
        "integrator: {}, parameters: {{mass: 1.0, stiffness: 4900.0, damping: 20.0, "
        "internal_damping: 5.0, eccentricity: 1.0e-4}}}}}}, controllers: {{more: {{type: pid, "
        "rate: 1300.0, measures: [r.x, r.y], acts_on: [r.force_x, r.force_y], delay: 3.0e-4, "
        "actuator: {{bandwidth: 400.0}}, parameters: {{kp: 2000.0, ki: 0.0, kd: 6.0}}}}}}}}",
        static_cast<double>(step) / 1e9, integrator));
  };
  Twin exact(rotor("exponential", 1'000'000));
  Twin other(rotor("gauss_legendre_6", 500'000));
  double largest = 0.0;
  double difference = 0.0;
  for (int i = 0; i < 1500; ++i) {
    exact.step();
    other.step();
    other.step();
    largest = std::max(largest, std::fabs(motionOf(exact).x));
    difference = std::max(difference, std::fabs(motionOf(exact).x - motionOf(other).x));
  }
  EXPECT_LT(difference, 1e-7 * largest);
}

// Without its controller it would overflow within the trial steps of a change: such a trial
// would be meaningless.
TEST(SampledLoop, IsNotTriedWithoutItsControllers) {
  BuiltScene built = build(sceneOf(
      "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x], mass: [[1.0]], "
      "stiffness: [[-1.0e9]]}, initial: {x: 1.0e-6}}}, controllers: {pd: {type: pid, rate: 1.0e6, "
      "measures: [s.x], acts_on: [s.force_x], parameters: {kp: 2.0e9, ki: 0.0, kd: 4.0e4}}}}"));
  EXPECT_EQ(whyItWouldStop(built, *built.systems[0], std::nullopt), "");
  built.scene.controllers.clear();
  EXPECT_NE(whyItWouldStop(built, *built.systems[0], std::nullopt), "");
}

// Two systems coupled by a controller: it measures one and acts on the other, in the same
// sub-steps.
TEST(SampledLoop, TiesSystemsTogether) {
  const std::string mass =
      "{model: linear_system, integrator: exponential, parameters: {names: [x], mass: "
      "[[1.0]], stiffness: [[0.0]]}, initial: {x: X}}";
  const auto at = [&](const std::string& x) {
    std::string text = mass;
    return text.replace(text.find('X'), 1, x);
  };
  const std::string law =
      "parameters: {b: [[0.0, 0.0]], a: [[0.0]], c: [[0.0], [0.0]], d: [[-4.0, 4.0], [4.0, -4.0]]}";
  Twin tied(
      sceneOf("{step: 0.05, systems: {p: " + at("0.001") + ", q: " + at("-0.001") +
              "}, controllers: {spring: {type: linear, rate: 200.0, measures: [p.x, q.x], acts_on: "
              "[p.force_x, q.force_x], " +
              law + "}}}"));
  for (int i = 0; i < 22; ++i) {  // half a swing of sqrt(8) rad/s
    tied.step();
    const Motion p = motionOf(tied, 0);
    const Motion q = motionOf(tied, 1);
    ASSERT_NEAR(p.x, -q.x, 1e-18 + 1e-12 * std::fabs(p.x));  // their centre stays
  }
  EXPECT_LT(motionOf(tied, 0).x, -0.0008);
}

/// 2 s of a levitated mass with jittering output instants; x and its rate.
std::vector<double> withJitter(std::int64_t step, int resets = 0) {
  Twin twin(sceneOf(fmt::format(
      "{{step: {:.9f}, systems: {{s: {{model: linear_system, integrator: exponential, parameters: "
      "{{names: [x], mass: [[1.0]], stiffness: [[-1.0]]}}, initial: {{x: 1.0e-3}}}}}}, "
      "controllers: {{pd: {{type: pid, rate: 300.0, measures: [s.x], acts_on: [s.force_x], delay: "
      "{{mean: 0.004, jitter: 0.003, seed: 7}}, parameters: {{kp: 2.0, kd: 1.0}}}}}}}}",
      static_cast<double>(step) / 1e9)));
  const std::int64_t steps = 2'000'000'000 / step;
  for (int run = 0; run <= resets; ++run) {
    twin.reset();
    for (std::int64_t i = 0; i < steps; ++i) {
      twin.step();
    }
  }
  std::vector<double> motion(2);
  twin.running(0).motion(motion.data());
  return motion;
}

// Each output is a breakpoint at its instant: the exact result does not depend on the step.
TEST(ControlLoop, OutputsWithJitterActAtTheirInstants) {
  const std::vector<double> coarse = withJitter(4'000'000);
  const std::vector<double> fine = withJitter(500'000);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(coarse[i], fine[i], 1e-15);
  }
  EXPECT_EQ(withJitter(4'000'000, 1), coarse) << "a reset gives the same bytes";
}

}  // namespace control_loop_test
}  // namespace whirl_twin
