// A multistep method must discard its history where the equations change: at every breakpoint,
// command and parameter change its error stays that of a smooth motion.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "integration/stoermer_weights.h"
#include "running_system.h"

namespace whirl_twin {
namespace stoermer_test {

constexpr std::int64_t kMillisecond = 1000000;

/// A pendulum on a shaft, swinging widely.
RunningSystem::Setup onShaft() {
  RunningSystem::Setup s;
  s.model = "spinning_pendulum";
  s.parameters = {{"mass", 1.0}, {"length", 1.0}, {"damping", 0.02}};
  s.speed = 2.0;
  s.q = {1.0};
  return s;
}

RunningSystem::Setup arms() {
  RunningSystem::Setup s;
  s.model = "double_pendulum";
  s.parameters = {{"mass1", 2.0}, {"mass2", 1.5}, {"length1", 1.0}, {"length2", 0.8}};
  s.q = {0.3, -0.2};
  return s;
}

/// A step at which the method's own error is far below that of a past across a jump.
struct Named {
  const char* method;
  std::int64_t step;
};

void PrintTo(const Named& named, std::ostream* out) {
  *out << named.method;
}

class Stoermer : public testing::TestWithParam<Named> {
 protected:
  /// Largest difference of a run from one by far finer steps of a method without a past.
  static double error(const RunningSystem::Setup& setup, std::int64_t duration) {
    RunningSystem own(setup, GetParam().method, GetParam().step);
    RunningSystem fine(setup, "gauss_legendre_6", GetParam().step / 4);
    double largest = 0.0;
    for (std::int64_t time = 0; time < duration; time += 10 * GetParam().step) {
      EXPECT_EQ(own.run(10), StepStatus::kOk);
      EXPECT_EQ(fine.run(40), StepStatus::kOk);
      for (std::size_t i = 0; i < own.state().size(); ++i) {
        largest = std::fmax(largest, std::fabs(own.state()[i] - fine.state()[i]));
      }
    }
    return largest;
  }
};

// Hairer, Norsett & Wanner, III.10, (10.8) and (10.16); III.1, (1.9).
TEST(StoermerWeights, AreThoseOfTheBooks) {
  using namespace stoermer;
  const auto expect = [](const Weights& found, const std::vector<double>& times, double over) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], i < times.size() ? times[i] / over : 0.0, 1e-15) << i;
    }
  };
  expect(weights({5, 0}, positionMoments()), {299.0, -176.0, 194.0, -96.0, 19.0}, 240.0);
  expect(weights({5, 1}, positionMoments()), {19.0, 204.0, 14.0, 4.0, -1.0}, 240.0);
  expect(weights({4, 0}, stepMoments(0)), {55.0, -59.0, 37.0, -9.0}, 24.0);
  expect(weights({6, 1}, stepMoments(0)), {475.0, 1427.0, -798.0, 482.0, -173.0, 27.0}, 1440.0);
}

// q'' = t^k: a step of exact history and of these weights makes no error up to k = terms - 1.
TEST(StoermerWeights, AreExactForPolynomials) {
  for (const StoermerScheme& scheme : kStoermerSchemes) {
    for (std::size_t k = 0; k < scheme.terms; ++k) {
      const auto power = [](double x, std::size_t n) {
        return std::pow(x, static_cast<double>(n));
      };
      double position = 0.0;
      double rate = 0.0;
      double scale = 0.0;
      for (std::size_t i = 0; i < scheme.terms; ++i) {
        const double a = power(-static_cast<double>(i), k);
        position += scheme.position[i] * a;
        rate += scheme.rate[i] * a;
        scale += std::fabs((scheme.position[i] + scheme.rate[i]) * a);
      }
      const double n = static_cast<double>(k);
      // q(1) - 2 q(0) + q(-1), and v(1) - (q(1) - q(0)).
      const double second = (1.0 + power(-1.0, k)) / ((n + 1.0) * (n + 2.0));
      EXPECT_NEAR(position, second, 1e-15 * scale) << scheme.name << " " << k;
      EXPECT_NEAR(rate, 1.0 / (n + 2.0), 1e-15 * scale) << scheme.name << " " << k;
    }
  }
}

// The same as dense output at a fraction x of the step: the deviation from the straight line, of
// the mean rate and of the work to the end.
TEST(StoermerWeights, ReadOffPolynomialsWithinAStep) {
  for (const StoermerScheme& scheme : kStoermerSchemes) {
    for (const double x : {0.0, 0.125, 0.5, 0.9, 1.0}) {
      const DenseOutputWeights reading(scheme, x);
      for (std::size_t k = 0; k < scheme.terms; ++k) {
        double position = 0.0;
        double rate = 0.0;
        double work = 0.0;
        double scale = 0.0;
        for (std::size_t i = 0; i < scheme.terms; ++i) {
          const double a = std::pow(1.0 - static_cast<double>(i), static_cast<double>(k));
          position += reading.position[i] * a;
          rate += reading.rate[i] * a;
          work += reading.work[i] * a;
          scale += std::fabs(a) * (std::fabs(reading.position[i]) + std::fabs(reading.rate[i]) +
                                   std::fabs(reading.work[i]));
        }
        const double n = static_cast<double>(k);
        const double both = (n + 1.0) * (n + 2.0);
        EXPECT_NEAR(position, (std::pow(x, n + 2.0) - x) / both, 1e-14 * scale) << k << " " << x;
        EXPECT_NEAR(rate, std::pow(x, n + 1.0) / (n + 1.0) - 1.0 / both, 1e-14 * scale)
            << k << " " << x;
        EXPECT_NEAR(work, (1.0 - std::pow(x, n + 1.0)) / (n + 1.0), 1e-14 * scale) << k << " " << x;
      }
    }
  }
}

TEST_P(Stoermer, ForgetsAtTheCornersOfAProfileBetweenStepsAndInside) {
  for (const double dwell : {0.2, 0.1234567}) {
    RunningSystem::Setup s = onShaft();
    // The acceleration jumps after whole steps, or inside of them.
    s.profile = {{6.0, 20.0, 0.0, dwell}, {1.0, 25.0, 0.0, dwell}, {4.0, 30.0, 0.0, dwell}};
    EXPECT_LT(error(s, 1200 * kMillisecond), 1e-10) << dwell;
  }
}

TEST_P(Stoermer, ForgetsAtTheCornersOfInputs) {
  RunningSystem::Setup s = arms();
  for (const std::int64_t late : {std::int64_t{0}, std::int64_t{314159}}) {
    s.inputs = {{"torque1", InputSignal::table({200 * kMillisecond + late, 480 * kMillisecond},
                                               {0.6, -0.8}, false)},
                {"torque2", InputSignal::table({320 * kMillisecond, 640 * kMillisecond + late},
                                               {-0.3, 0.4}, true)}};
    EXPECT_LT(error(s, 1200 * kMillisecond), 1e-10) << late;
  }
}

TEST_P(Stoermer, ForgetsWhenACommandChangesTheSpeed) {
  const RunningSystem::Setup s = onShaft();
  const ModelInfo& model = *findModel(s.model);
  const auto run = [&](const char* method, std::int64_t step) {
    const ModelSetup setup = model.setUp(completed(model, s.parameters), {}, ModelContext(9.81));
    Drive drive(s.speed, 0.0);
    const auto system = setup.system(method, {drive, nullptr}, static_cast<double>(step) / 1e9, 1);
    const double v = 0.0;
    system->set(s.q.data(), &v);
    drive.begin(0);
    std::vector<double> states;
    for (std::int64_t time = 0; time < 1200 * kMillisecond; time += step) {
      if (time % (240 * kMillisecond) == 0 && time > 0) {
        // Its acceleration jumps, the second time within a move.
        EXPECT_TRUE(drive.setSpeed(time < 300 * kMillisecond ? 20.0 : 3.0, 25.0, 0.0));
      }
      EXPECT_EQ(system->step(static_cast<double>(time) / 1e9), StepStatus::kOk);
      drive.begin(time + step);
      std::vector<double> now(3);
      system->write(now.data());
      if ((time + step) % (40 * kMillisecond) == 0) {
        states.insert(states.end(), now.begin(), now.end() - 1);
      }
    }
    return states;
  };
  const std::vector<double> own = run(GetParam().method, GetParam().step);
  const std::vector<double> fine = run("gauss_legendre_6", GetParam().step / 4);
  ASSERT_EQ(own.size(), fine.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR(own[i], fine[i], 1e-10) << i;
  }
}

TEST_P(Stoermer, ForgetsWhenACommandChangesAHeldInput) {
  RunningSystem::Setup s = arms();
  s.inputs = {{"torque1", InputSignal::constant(0.5)}};
  RunningSystem own(s, GetParam().method, GetParam().step);
  RunningSystem fine(s, "gauss_legendre_6", GetParam().step / 4);
  const std::int64_t part = 240 * kMillisecond;
  for (const double torque : {0.5, 1.5, -1.0, 0.2}) {
    const auto until = static_cast<std::int64_t>(own.time() * 1e9 + 0.5) + part / 2;
    EXPECT_TRUE(own.command("torque1", torque, until));
    EXPECT_TRUE(fine.command("torque1", torque, until));
    ASSERT_EQ(own.run(part / GetParam().step), StepStatus::kOk);
    ASSERT_EQ(fine.run(4 * part / GetParam().step), StepStatus::kOk);
    for (std::size_t i = 0; i < own.state().size(); ++i) {
      EXPECT_NEAR(own.state()[i], fine.state()[i], 1e-10) << torque;
    }
  }
  // The work of the zero-order-held inputs and the energy gained.
  const RunningSystem start(s, GetParam().method, GetParam().step);
  EXPECT_NEAR(own.energies().jacobi - start.energies().jacobi, own.work(), 1e-10);
}

TEST_P(Stoermer, GoesOnFromAStateThatIsSetAsOneThatStartsThere) {
  const RunningSystem::Setup s = onShaft();
  const ModelInfo& model = *findModel(s.model);
  const ModelSetup setup = model.setUp(completed(model, s.parameters), {}, ModelContext(9.81));
  const Drive drive(s.speed, 0.0);
  const double seconds = static_cast<double>(GetParam().step) / 1e9;
  const auto fresh = setup.system(GetParam().method, {drive, nullptr}, seconds, 1);
  const auto used = setup.system(GetParam().method, {drive, nullptr}, seconds, 1);
  const double q = 0.7;
  const double v = -0.3;
  const double elsewhere = 2.0;
  used->set(&elsewhere, &v);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(used->step(0.0), StepStatus::kOk);
  }
  fresh->set(&q, &v);
  used->set(&q, &v);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(fresh->step(0.0), StepStatus::kOk);
    ASSERT_EQ(used->step(0.0), StepStatus::kOk);
    std::vector<double> a(3);
    std::vector<double> b(3);
    fresh->write(a.data());
    used->write(b.data());
    ASSERT_EQ(a, b) << "step " << i;
  }
  EXPECT_EQ(fresh->errorSum(), used->errorSum());
}

// A shaft whose angle is stored as whole turns and a remainder: removing turns is not a jump.
TEST_P(Stoermer, KeepsItsPastWhenASpinHasGoneRound) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 2.0},
                  {"stiffness", 200.0},
                  {"damping", 0.2},
                  {"eccentricity", 0.002},
                  {"polar_inertia", 0.02}};
  s.motor = Motor::falling(0.02, 40.0);
  s.v = {0.0, 0.0, 15.0};
  EXPECT_LT(error(s, 4000 * kMillisecond), 1e-9);
}

TEST_P(Stoermer, ClosesTheAuditOfADampedRunUp) {
  RunningSystem::Setup s = onShaft();
  s.profile = {{5.0, 3.0, 10.0, 0.3}};
  RunningSystem pendulum(s, GetParam().method, GetParam().step);
  const Energies start = pendulum.energies();
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(pendulum.run(400 * kMillisecond / GetParam().step), StepStatus::kOk);
    EXPECT_NEAR(pendulum.energies().jacobi - start.jacobi, pendulum.work(), 1e-10) << i;
  }
  EXPECT_GT(std::fabs(pendulum.work()), 0.1) << "there is something to close";
}

INSTANTIATE_TEST_SUITE_P(Steps, Stoermer,
                         testing::Values(Named{"stoermer_6", kMillisecond},
                                         Named{"stoermer", 2 * kMillisecond}),
                         [](const auto& test) { return test.param.method; });

}  // namespace stoermer_test
}  // namespace whirl_twin
