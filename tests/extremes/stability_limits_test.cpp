// Stability limit of the step size of each method, where steps begin to amplify a motion that
// decays or is neutral: predicted from the system's spectrum and the method's stability function,
// and found in runs below, at and above it. On the imaginary axis (undamped whirl), beside it
// (damped, rotating damping), on the real axis (overdamped), with gyroscopic terms, and for many
// degrees of freedom. For multistep methods (started with steps of dormand_prince_8, so that single
// steps give no information on them) the prediction is the largest root of their recurrence.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "../integration/running_system.h"
#include "amplification.h"
#include "analysis/equilibria.h"
#include "measured.h"

namespace whirl_twin {
namespace stability_limits_test {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kLargest = 100.0;     // maximum h |lambda| tested
constexpr std::int64_t kFirst = 4000;  // steps until the transient is over
constexpr double kGrown = 1.2;         // in as many again: it grows

RunningSystem::Setup jeffcott(double zeta, double zeta_internal = 0.0, double speed_ratio = 0.0) {
  constexpr double kP = 1000.0;  // [rad/s]
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0},
                  {"stiffness", kP * kP},
                  {"damping", 2.0 * zeta * kP},
                  {"internal_damping", 2.0 * zeta_internal * kP}};
  s.speed = speed_ratio * kP;
  s.q = {1e-3, 2e-3};
  s.v = {-1.0, 0.5};
  return s;
}

RunningSystem::Setup undamped() {
  return jeffcott(0.0);
}
RunningSystem::Setup damped() {
  return jeffcott(0.05, 0.0, 0.8);
}
RunningSystem::Setup rotatingDamping() {
  return jeffcott(0.05, 0.03, 0.8);
}
RunningSystem::Setup overdamped() {
  return jeffcott(20.0);
}

/// An overhung disc, its gyroscopic moment twice its transverse inertia's.
RunningSystem::Setup gyroscopic() {
  RunningSystem::Setup s;
  s.model = "rigid_disc_rotor";
  s.parameters = {{"mass", 10.0},
                  {"polar_inertia", 0.2},
                  {"transverse_inertia", 0.1},
                  {"stiffness_displacement", 1e6},
                  {"stiffness_coupling", -2e5},
                  {"stiffness_rotation", 6e4},
                  {"damping_displacement", 300.0},
                  {"damping_rotation", 10.0}};
  s.speed = 500.0;
  s.q = {1e-3, 0.0, 0.0, 1e-3};
  s.v = {0.0, 1.0, -1.0, 0.0};
  return s;
}

/// Five masses in a row between springs and dampers.
RunningSystem::Setup chain() {
  constexpr Eigen::Index kMasses = 5;
  Eigen::MatrixXd row = 2.0 * Eigen::MatrixXd::Identity(kMasses, kMasses);
  row.diagonal(1).setConstant(-1.0);
  row.diagonal(-1).setConstant(-1.0);
  RunningSystem::Setup s;
  s.model = "linear_system";
  s.settings.matrices["mass"] = Eigen::MatrixXd::Identity(kMasses, kMasses);
  s.settings.matrices["stiffness"] = 1e6 * row;
  s.settings.matrices["damping"] = 50.0 * row;
  s.q = {1e-3, 0.0, -1e-3, 2e-3};
  return s;
}

struct Case {
  const char* system;
  RunningSystem::Setup (*setup)();
  std::string method;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.system << " by " << c.method;
}

std::vector<Case> everyCase() {
  std::vector<Case> all;
  for (const auto& [name, setup] :
       {std::make_pair("Undamped", undamped), std::make_pair("Damped", damped),
        std::make_pair("RotatingDamping", rotatingDamping),
        std::make_pair("Overdamped", overdamped), std::make_pair("Gyroscopic", gyroscopic),
        std::make_pair("Chain", chain)}) {
    for (const std::string& method : integratorsOf(setup().model)) {
      all.push_back({name, setup, method});
    }
  }
  return all;
}

class StabilityLimit : public testing::TestWithParam<Case> {
 protected:
  StabilityLimit()
      : setup_(GetParam().setup()),
        start_(setup_, GetParam().method, kMillisecond),
        motion_(linearizationAtRest(start_.dynamics(),
                                    Eigen::VectorXd::Zero(start_.dynamics().dof()), setup_.speed)),
        fastest_(motion_.spectrum().cwiseAbs().maxCoeff()) {}

  /// After the transient, the growth factor over as many steps again: of the largest of (q, v /
  /// |lambda|max) within kWindow steps. 0 after decay to zero, infinity once not finite.
  double grown(double h_lambda) const {
    RunningSystem system(setup_, GetParam().method, step(h_lambda));
    for (std::int64_t i = 0; i < kFirst; i += 100) {
      if (system.run(100) != StepStatus::kOk) {
        return kNone;
      }
      if (size(system) < 1e-100) {
        return 0.0;
      }
    }
    const double before = largestInWindow(system);
    return system.run(kFirst) == StepStatus::kOk ? largestInWindow(system) / before : kNone;
  }
  double largestInWindow(RunningSystem& system) const {
    constexpr int kWindow = 50;  // the longest orbit met 1 % below a limit takes 44 steps
    double largest = 0.0;
    for (int i = 0; i < kWindow; ++i) {
      largest = std::fmax(largest, size(system));
      system.run(1);
    }
    return largest;
  }
  /// Whole nanoseconds: to 1e-3 of the smallest step tested.
  std::int64_t step(double h_lambda) const {
    return static_cast<std::int64_t>(std::round(h_lambda / fastest_ * 1e9));
  }
  double size(const RunningSystem& system) const {
    double largest = 0.0;
    const auto n = static_cast<std::size_t>(start_.dynamics().dof());
    for (std::size_t i = 0; i < n; ++i) {
      largest =
          std::fmax(largest, std::fmax(std::fabs(system.q(i)), std::fabs(system.v(i)) / fastest_));
    }
    return largest;
  }

  /// Growth a step, as foretold; of a method that is not known by its formula, of the matrix that
  /// single steps from unit states give.
  double foretold(double h_lambda) const {
    const auto known = growth(GetParam().method, motion_, h_lambda / fastest_);
    return known ? *known : spectralRadius(mapOfOneStep(h_lambda));
  }
  Eigen::MatrixXd mapOfOneStep(double h_lambda) const {
    const auto n = static_cast<std::size_t>(start_.dynamics().dof());
    Eigen::MatrixXd map(2 * n, 2 * n);
    for (std::size_t j = 0; j < 2 * n; ++j) {
      RunningSystem::Setup unit = setup_;
      unit.q.assign(n, 0.0);
      unit.v.assign(n, 0.0);
      (j < n ? unit.q[j] : unit.v[j - n]) = j < n ? 1.0 : fastest_;
      RunningSystem system(unit, GetParam().method, step(h_lambda));
      EXPECT_EQ(system.run(1), StepStatus::kOk);
      for (std::size_t i = 0; i < n; ++i) {
        map(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = system.q(i);
        map(static_cast<Eigen::Index>(n + i), static_cast<Eigen::Index>(j)) =
            system.v(i) / fastest_;
      }
    }
    return map;
  }
  /// The smallest h |lambda|max from which steps grow, as predicted; infinity: none up to kLargest.
  double limit() const {
    // Where two eigenvalues meet, on the very limit, they are known to 1e-8. A recurrence without
    // damping does not begin to grow at a limit, but as a high power of the step.
    const double grows = hasPast(GetParam().method) ? std::pow(kGrown, 1.0 / kFirst) : 1.0 + 1e-6;
    double stable = 0.0;
    for (double x = 0.01; x < kLargest; x *= 1.02) {
      if (foretold(x) > grows) {
        double unstable = x;
        for (int i = 0; i < 20; ++i) {
          const double middle = 0.5 * (stable + unstable);
          (foretold(middle) > grows ? unstable : stable) = middle;
        }
        return unstable;
      }
      stable = x;
    }
    return kNone;
  }

  RunningSystem::Setup setup_;
  RunningSystem start_;
  FreeDeviation motion_;
  double fastest_;  // [rad/s], |lambda|max
};

TEST_P(StabilityLimit, IsWhereTheStabilityFunctionPutsIt) {
  const double expected = limit();
  if (expected == kNone) {
    double largest = 0.0;
    for (const double x : {0.1, 1.0, 3.0, 10.0, 30.0, kLargest}) {
      largest = std::fmax(largest, grown(x));
    }
    // Decaying motions decay; neutral ones stay on their orbit, sampled once per step.
    expectWithin(1.05, largest,
                 fmt::format("no limit up to h |lambda| = 100, {} by {}: growth", GetParam().system,
                             GetParam().method));
    return;
  }
  EXPECT_LT(grown(0.98 * expected), kGrown) << "below " << expected;
  EXPECT_GT(grown(1.02 * expected), kGrown) << "above " << expected;
  double stable = 0.5 * expected;
  double unstable = 2.0 * expected;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (grown(middle) > kGrown ? unstable : stable) = middle;
  }
  expectWithin(0.02, std::fabs(stable / expected - 1.0),
               fmt::format("largest h |lambda| = {:.3f} ({:.3f} foretold), {} by {}: difference",
                           stable, expected, GetParam().system, GetParam().method));
}

INSTANTIATE_TEST_SUITE_P(Methods, StabilityLimit, testing::ValuesIn(everyCase()),
                         [](const auto& test) {
                           return test.param.system + ("_" + test.param.method);
                         });

}  // namespace stability_limits_test
}  // namespace whirl_twin
