#include "accuracy/step_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "accuracy/trajectory.h"
#include "algebra/constants.h"
#include "algebra/dense.h"
#include "integration/step_methods.h"
#include "integration/stoermer_growth.h"
#include "models/model_info.h"
#include "models/model_registry.h"

namespace whirl_twin {

namespace {

// Stability reserve of multistep methods (stoermer.h): the distance from growth of non-growing
// deviations.

constexpr std::size_t kLooks = 8;
constexpr double kGrowth = 1.0e-3;  // a step: less is what steps so long are off by

/// Speeds [rad/s] that its shaft is to have.
std::vector<double> speedsOf(const Scene& one) {
  const SystemSpec& spec = one.systems.front();
  std::vector<double> speeds{spec.speed.value_or(1.0)};
  const std::size_t drive = one.driveOf(spec);
  if (drive < one.drives.size()) {
    speeds = {one.drives[drive].speed};
    for (const SpeedMove& move : one.drives[drive].profile) {
      speeds.push_back(move.speed);
    }
  }
  return speeds;
}

/// Whether small deviations q'' = by_q q + by_v q' grow in a step of h [s] of a method no more than
/// those of the exact solution.
bool growsNoFaster(const StoermerScheme& scheme, const Linearization& l, double h) {
  const Lu mass(l.mass);
  const Eigen::MatrixXd by_q = -mass.solve(l.stiffness + l.circulatory);
  const Eigen::MatrixXd by_v = -mass.solve(l.damping + l.gyroscopic);
  if (!by_q.allFinite() || !by_v.allFinite()) {
    return false;
  }
  const Eigen::Index n = by_q.rows();
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  own.topRightCorner(n, n).setIdentity();
  own.bottomLeftCorner(n, n) = by_q;
  own.bottomRightCorner(n, n) = by_v;
  const double growing = std::max(0.0, eigenvalues(own).values.real().maxCoeff());
  return growthInAStep(scheme, by_q, by_v, h) <= std::exp(growing * h) * (1.0 + kGrowth);
}

/// Whether small deviations from the motion of a scene of one system, sampled along it, grow no
/// faster than those of the differential equation, at steps `times` as long as the setting's. For
/// multistep methods.
bool growsNothing(const Scene& one, const ModelSetup& setup, const Trajectory& motion,
                  const StepSetting& setting, int times) {
  const auto scheme =
      std::find_if(kStoermerSchemes.begin(), kStoermerSchemes.end(),
                   [&](const StoermerScheme& s) { return setting.integrator == s.name; });
  const double h = 1.0e-9 * static_cast<double>(setting.step) /
                   stepMethod(setting.integrator).stepsFor(setting.substeps) * times;
  const Dynamics& dynamics = *setup.dynamics;
  const auto dof = static_cast<Eigen::Index>(motion.dof);
  const std::size_t stride = std::max<std::size_t>(1, motion.samples() / kLooks);
  for (std::size_t sample = 0; sample < motion.samples(); sample += stride) {
    const Eigen::Map<const Eigen::VectorXd> q(&motion.coordinates[sample * motion.dof], dof);
    const Eigen::Map<const Eigen::VectorXd> v(&motion.rates[sample * motion.dof], dof);
    for (const double speed : speedsOf(one)) {
      const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
      const Linearization l = dynamics.linearization(q, v, dynamics.acceleration(q, v, at), at);
      if (!growsNoFaster(*scheme, l, h)) {
        return false;
      }
    }
  }
  return true;
}

/// Of a step: substeps are no shorter than this, but for so many as there always may be.
constexpr std::int64_t kMinSubstep = 500;  // ns
constexpr int kFewSubsteps = 64;
constexpr int kMaxChosenSubsteps = 4096;
/// A method that is not symplectic has to be this much cheaper than gauss_legendre_6.
constexpr double kWorthwhile = 0.7;
constexpr double kBelieved = 1.0e12;  // an excess beyond means only that the motion diverged
constexpr double kRefinementGain = 0.7;
constexpr double kMaxDoublings = 16.0;
/// Allowed ratio of the error at twice the step.
constexpr double kRoundingExcess = 1.0e-3;
/// For multistep methods: multiple of the history, and multiple of the step.
constexpr double kOwnSteps = 50.0;
constexpr int kPastMargin = 4;
/// Maximum number of the twin's steps in a macro-step: beyond, little is gained.
constexpr int kMaxAhead = 32;

double cost(const StepChoice& choice) {
  const StepMethod& method = stepMethod(choice.integrator);
  return method.stepsFor(choice.substeps) * method.evaluations;
}

}  // namespace

int doublings(double times, int order) {
  const double missing = std::ceil(std::log2(std::min(times, kBelieved)) / (order > 0 ? order : 4));
  return static_cast<int>(std::clamp(missing, 1.0, kMaxDoublings));
}

StepSetting settingOf(const Scene& one, const StepChoice& choice) {
  return {choice.integrator, one.step, choice.substeps};
}

int mostSubsteps(const Scene& one) {
  return static_cast<int>(
      std::clamp<std::int64_t>(one.step / kMinSubstep, kFewSubsteps, kMaxChosenSubsteps));
}

void StepSearch::tryMethod(const StepMethod& method) {
  const SystemSpec& spec = one_.systems.front();
  StepChoice choice;
  choice.integrator = method.name;
  choice.substeps = spec.substeps;
  const int most = std::max(mostSubsteps(one_), spec.substeps);
  double before = kInfinity;
  while ((!found_ || cost(choice) < cost(*found_)) &&
         (method.symplectic || method.order == 0 || cost(choice) < kWorthwhile * implicit_cost_)) {
    const StepSetting setting = settingOf(one_, choice);
    const double excess = judge_.excess(setting);
    if (excess < best_excess_ && method.past == 0) {
      best_excess_ = excess;
      best_ = choice;
    }
    if (excess <= 1.0) {
      if (method.implicit || method.order == 0 ||
          (soundAtLongerSteps(setting, 2, method, excess) &&
           (method.past == 0 || isProvenWithAPast(setting, method, excess)))) {
        found_ = choice;
        if (method.name == kReferenceMethod) {
          implicit_cost_ = cost(choice);
        }
      }
      return;
    }
    if (std::isfinite(before) && excess > kRefinementGain * before) {
      return;  // shorter steps are no better
    }
    before = excess;
    const int more = doublings(excess, method.order);
    if (choice.substeps > most >> more) {
      return;
    }
    choice.substeps <<= more;
  }
}

void StepSearch::tryAhead(const StepMethod& method) {
  if (one_.systems.front().substeps > 1) {
    return;  // shorter steps are required
  }
  StepChoice choice;
  choice.integrator = method.name;
  for (choice.substeps = kMaxAhead; choice.substeps > 1; choice.substeps /= 2) {
    const StepSetting setting = settingOf(one_, choice);
    if ((found_ && cost(choice) >= cost(*found_)) || cost(choice) >= kWorthwhile * implicit_cost_) {
      return;
    }
    const double excess = hasOwnSteps(setting, method) ? judge_.excess(setting) : kInfinity;
    if (excess <= 1.0 && soundAtLongerSteps(setting, 2, method, excess) &&
        isProvenWithAPast(setting, method, excess)) {
      found_ = choice;
      return;
    }
  }
}

StepChoice StepSearch::best() const {
  if (found_ || best_) {
    return found_ ? *found_ : *best_;
  }
  StepChoice plain;
  const SystemSpec& spec = one_.systems.front();
  plain.integrator = chooseIntegrator(setup_, spec.drive.has_value()).integrator;
  plain.substeps = spec.substeps;
  return plain;
}

/// An explicit method near its stability limit is rejected: it must be stable at longer steps.
bool StepSearch::soundAtLongerSteps(const StepSetting& setting, int times, const StepMethod& method,
                                    double excess) {
  return judge_.excessAtLongerSteps(setting, times) <=
         std::pow(times, method.order + 3) * std::max(excess, kRoundingExcess);
}

/// Beyond its stability limit a multistep method does not lose digits but diverges, and the limit
/// is low under strong damping: it must have taken many steps with full history, and must be stable
/// at four times the step, by its errors and by its growth of small deviations. With dry friction
/// that can stick, each event restarts the history.
bool StepSearch::isProvenWithAPast(const StepSetting& setting, const StepMethod& method,
                                   double excess) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(setup_.dynamics->dof());
  return one_.systems.front().inputs.empty() &&
         setup_.dynamics->dryHolds(zero, zero, zero, {}).empty() && hasOwnSteps(setting, method) &&
         soundAtLongerSteps(setting, kPastMargin, method, excess) &&
         growsNothing(one_, setup_, judge_.reference().trajectory, setting, kPastMargin);
}

bool StepSearch::hasOwnSteps(const StepSetting& setting, const StepMethod& method) const {
  return judge_.knownSteps(setting) >= kOwnSteps * static_cast<double>(method.past);
}

}  // namespace whirl_twin
