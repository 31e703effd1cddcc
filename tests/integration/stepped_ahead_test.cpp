// Macro-steps with dense output: as accurate inside as at their ends, and terminated where an
// external event changes the motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "allocation_guard.h"
#include "integration/macro_step.h"
#include "running_system.h"

namespace whirl_twin {
namespace stepped_ahead_test {

constexpr std::int64_t kMillisecond = 1000000;

/// A system without inputs, read after every step of the twin: q, v and the work.
class Read {
 public:
  using Command = void (*)(Drive&, std::int64_t step);

  Read(const RunningSystem::Setup& setup, const char* method, std::int64_t step, int substeps)
      : drive_(setup.speed, 0.0, setup.profile), step_(step) {
    const ModelInfo& model = *findModel(setup.model);
    setup_ = model.setUp(completed(model, setup.parameters), {}, ModelContext(setup.gravity));
    system_ = setup_.system(method, {drive_, nullptr}, static_cast<double>(step) / 1e9, substeps);
    std::vector<double> v = setup.v;
    v.resize(setup.q.size());
    system_->set(setup.q.data(), v.data());
    drive_.begin(0);
  }

  /// The states after every `every` of so many steps.
  std::vector<std::vector<double>> run(std::int64_t steps, std::int64_t every,
                                       Command command = nullptr) {
    std::vector<std::vector<double>> all;
    for (std::int64_t i = 0; i < steps; ++i, ++count_) {
      if (command != nullptr) {
        command(drive_, count_);
      }
      EXPECT_EQ(system_->step(static_cast<double>(count_ * step_) / 1e9), StepStatus::kOk);
      drive_.begin((count_ + 1) * step_);
      if ((i + 1) % every == 0) {
        std::vector<double> now(2 * system_->dof() + 1);
        system_->write(now.data());
        all.push_back(now);
      }
    }
    return all;
  }
  Stepper& system() { return *system_; }
  Drive& drive() { return drive_; }
  double jacobi(const std::vector<double>& at) const {
    const auto n = static_cast<Eigen::Index>(system_->dof());
    const ShaftMotion shaft = drive_.at(0.0);
    return setup_.dynamics
        ->energies(Eigen::Map<const Eigen::VectorXd>(at.data(), n),
                   Eigen::Map<const Eigen::VectorXd>(at.data() + n, n),
                   {0.0, shaft.angle, shaft.speed, shaft.acceleration})
        .jacobi;
  }

 private:
  Drive drive_;
  std::int64_t step_;  // [ns]
  std::int64_t count_ = 0;
  ModelSetup setup_;
  std::unique_ptr<Stepper> system_;
};

/// Largest difference of the coordinates, and of the rates.
std::pair<double, double> difference(const std::vector<std::vector<double>>& a,
                                     const std::vector<std::vector<double>>& b) {
  EXPECT_EQ(a.size(), b.size());
  const std::size_t n = a.front().size() / 2;
  std::pair<double, double> largest{};
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      largest.first = std::max(largest.first, std::fabs(a[i][k] - b[i][k]));
      largest.second = std::max(largest.second, std::fabs(a[i][n + k] - b[i][n + k]));
    }
  }
  return largest;
}

RunningSystem::Setup arms() {
  RunningSystem::Setup s;
  s.model = "double_pendulum";
  s.parameters = {{"mass1", 2.0}, {"mass2", 1.5}, {"length1", 1.0}, {"length2", 0.8}};
  s.q = {0.3, -0.2};
  return s;
}

/// Damped, on a shaft.
RunningSystem::Setup onShaft() {
  RunningSystem::Setup s;
  s.model = "spinning_pendulum";
  s.parameters = {{"mass", 1.0}, {"length", 1.0}, {"damping", 0.02}};
  s.speed = 2.0;
  s.q = {1.0};
  return s;
}

TEST(MacroStep, IsAsExactBetweenAsAtTheEndsOfItsSteps) {
  constexpr std::int64_t kSteps = 4000;
  const auto truth = Read(arms(), "gauss_legendre_6", kMillisecond, 4).run(kSteps, 1);
  const auto errors = [&](int count) {
    return difference(Read(arms(), "stoermer_ahead", kMillisecond, count).run(kSteps, 1), truth);
  };
  const auto ends = [&](int count) {
    return difference(Read(arms(), "stoermer", count * kMillisecond, 1).run(kSteps / count, 1),
                      [&] {
                        std::vector<std::vector<double>> at_ends;
                        for (std::size_t i = static_cast<std::size_t>(count) - 1; i < truth.size();
                             i += static_cast<std::size_t>(count)) {
                          at_ends.push_back(truth[i]);
                        }
                        return at_ends;
                      }());
  };
  const auto coarse = errors(20);
  const auto fine = errors(10);
  ASSERT_GT(fine.first, 1e-13) << "rounding: longer steps are wanted";
  // The order is that of the steps themselves.
  EXPECT_GT(coarse.first / fine.first, std::pow(2.0, 8.5));
  EXPECT_GT(coarse.second / fine.second, std::pow(2.0, 8.5));
  EXPECT_LT(coarse.first, 5.0 * ends(20).first);
  EXPECT_LT(coarse.second, 5.0 * ends(20).second);
}

TEST(MacroStep, ClosesTheAuditWithinItsSteps) {
  Read pendulum(onShaft(), "stoermer_ahead", kMillisecond, 12);
  const double start = pendulum.jacobi({1.0, 0.0, 0.0});
  const auto states = pendulum.run(5000, 1);
  double least = 0.0;
  for (const std::vector<double>& at : states) {
    ASSERT_NEAR(pendulum.jacobi(at) - start, at[2], 1e-10);
    least = std::min(least, at[2]);
  }
  EXPECT_LT(least, -0.1) << "there is something to close";
}

// In the middle of a long step, again in the ramp that follows, and long after it.
TEST(MacroStep, EndsALongStepWhereACommandChangesTheSpeed) {
  const auto command = [](Drive& drive, std::int64_t step) {
    if (step == 403 || step == 437 || step == 1501) {
      EXPECT_TRUE(drive.setSpeed(step == 437 ? 3.0 : 6.0, 25.0, 0.0));
    }
  };
  const auto ahead = Read(onShaft(), "stoermer_ahead", kMillisecond, 16).run(3000, 1, command);
  const auto fine = Read(onShaft(), "gauss_legendre_6", kMillisecond, 4).run(3000, 1, command);
  EXPECT_LT(difference(ahead, fine).first, 1e-10);
  EXPECT_LT(difference(ahead, fine).second, 1e-9);
}

TEST(MacroStep, TakesTheTwinsStepsThroughAProfileAndItsCorners) {
  RunningSystem::Setup s = onShaft();
  s.profile = {{6.0, 20.0, 0.0, 0.1234567}, {1.0, 25.0, 200.0, 0.5}};
  const auto ahead = Read(s, "stoermer_ahead", kMillisecond, 16).run(3000, 1);
  const auto fine = Read(s, "gauss_legendre_6", kMillisecond, 4).run(3000, 1);
  EXPECT_LT(difference(ahead, fine).first, 1e-10);
}

// Long steps are not stable where so much is damped, or lose the motion at once.
TEST(MacroStep, TakesTheTwinsStepsWhereItsOwnDoNotFollow) {
  for (const double damping : {3.0, 10.0, 30.0}) {
    RunningSystem::Setup s = onShaft();
    s.parameters["damping"] = damping;
    const auto ahead = Read(s, "stoermer_ahead", kMillisecond, 64).run(4000, 1);
    const auto fine = Read(s, "gauss_legendre_6", kMillisecond, 4).run(4000, 1);
    EXPECT_LT(difference(ahead, fine).first, 1e-4) << damping;
  }
}

// Independent of what is sampled, and when.
TEST(MacroStep, MovesTheSameWhetherItIsReadOrNot) {
  const auto all = Read(arms(), "stoermer_ahead", kMillisecond, 16).run(999, 1);
  const auto last = Read(arms(), "stoermer_ahead", kMillisecond, 16).run(999, 999);
  EXPECT_EQ(all.back(), last.back());
}

TEST(MacroStep, GoesOnFromItsImageToTheBit) {
  Read first(onShaft(), "stoermer_ahead", kMillisecond, 16);
  first.run(405, 405);
  StateImage size = StateImage::taking(nullptr, 0);
  first.system().exchange(size);
  std::vector<char> bytes(size.size());
  StateImage taken = StateImage::taking(bytes.data(), bytes.size());
  first.system().exchange(taken);
  ASSERT_TRUE(taken.sound());
  const auto expected = first.run(500, 1);

  Read second(onShaft(), "stoermer_ahead", kMillisecond, 16);
  second.run(100, 100);
  StateImage put = StateImage::putting(bytes.data(), bytes.size());
  second.system().exchange(put);
  ASSERT_TRUE(put.sound());
  // The drive, of constant speed, is at another time, which does not affect the motion.
  EXPECT_EQ(second.run(500, 1), expected);
}

TEST(MacroStep, DoesNotAllocate) {
  Read pendulum(onShaft(), "stoermer_ahead", kMillisecond, 16);
  Stepper& system = pendulum.system();
  std::vector<double> out(2 * system.dof() + 1);
  const AllocationGuard guard;
  for (int i = 0; i < 300; ++i) {
    if (i == 133) {
      EXPECT_TRUE(pendulum.drive().setSpeed(5.0, 50.0, 0.0));
    }
    system.step(0.001 * i);
    pendulum.drive().begin((i + 1) * kMillisecond);
    system.write(out.data());
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

/// Counts the calls.
class Counting final : public ReadOffStepper {
 public:
  explicit Counting(int& steps) : steps_(steps) {}
  StepStatus step(double) noexcept override {
    ++steps_;
    return StepStatus::kOk;
  }
  StepStatus stepPart(double, std::int64_t, std::int64_t) noexcept override {
    return StepStatus::kOk;
  }
  std::size_t dof() const noexcept override { return 1; }
  void motion(double* out) const noexcept override { std::fill_n(out, 2, 0.0); }
  void write(double* out) const noexcept override { std::fill_n(out, 3, 0.0); }
  void readOff(const DenseOutputWeights&, bool, double* out) const noexcept override {
    std::fill_n(out, 3, 0.0);
  }
  bool follows() const noexcept override { return true; }
  void set(const double*, const double*) noexcept override {}
  void exchange(StateImage&) noexcept override {}

 private:
  int& steps_;
};

// No step of the twin costs more than one of the method, however long it is.
TEST(MacroStep, TakesAtMostOneStepOfTheMethodInOneOfTheTwin) {
  int far = 0;
  int near = 0;
  MacroStep system(std::make_unique<Counting>(far), std::make_unique<Counting>(near),
                   kStoermerSchemes[2], nullptr, 0.016, 16);
  const double zero = 0.0;
  system.set(&zero, &zero);
  for (int i = 0; i < 160; ++i) {
    const int before = far;
    system.step(0.001 * i);
    EXPECT_LE(far - before, 1);
  }
  EXPECT_EQ(far, 10);
  EXPECT_EQ(near, 0);
}

}  // namespace stepped_ahead_test
}  // namespace whirl_twin
