#include "accuracy/reference_trajectory.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "integration/step_methods.h"

namespace whirl_twin {

namespace {

/// Steps that are shorter by half and do not lessen the difference so much are in vain.
constexpr double kHalvingGain = 0.7;
constexpr double kLonger = 1.02;  // or make it last so much longer
/// A try that costs less than this part of the budget may be in vain.
constexpr double kCheap = 0.01;
constexpr int kMaxReferenceSubsteps = 1 << 20;
constexpr double kHopeless = 0.25;
/// A perturbation of the initial state relative to the largest coordinates, and the rounding error
/// of all steps that it represents.
constexpr double kDisturbance = 1.0e-13;
constexpr double kRounding = 2.0e-15;
/// Errors that have grown so much may have met what bounds them: a limit, a slew, a stop.
constexpr double kGrown = 1.0e4;
constexpr double kInProportion = 4.0;
constexpr std::size_t kFewSamples = 16;
constexpr std::int64_t kFinerSensing = 8;

/// The methods' order is six at least, where the motion is smooth.
int doublingsFor(double times) {
  return static_cast<int>(std::clamp(std::ceil(std::log2(times) / 6.0), 1.0, 3.0));
}

/// [ns]: the filter of a controller's sensor samples the motion at the twin's steps only
/// (control/sensor.h): a reference needs shorter ones.
std::int64_t referenceStep(const Scene& one) {
  const bool filters = std::any_of(one.controllers.begin(), one.controllers.end(),
                                   [](const auto& c) { return c.sensor.bandwidth > 0.0; });
  std::int64_t parts = filters ? kFinerSensing : 1;
  while (one.step % parts != 0) {
    --parts;
  }
  return one.step / parts;
}

}  // namespace

EvaluationBudget::EvaluationBudget(double evaluations, const Scene& one, const ModelSetup& setup)
    : left_(evaluations) {
  const double pairs = std::max(1.0, 0.5 * static_cast<double>(one.systems.front().q.size()));
  size_ = pairs * pairs * setup.evaluation_cost;
}

EvaluationBudget EvaluationBudget::upTo(double evaluations) const {
  EvaluationBudget part = *this;
  part.left_ = std::min(left_, evaluations);
  return part;
}

double EvaluationBudget::cost(const StepSetting& setting, std::int64_t interval,
                              std::size_t samples) const {
  const double steps = static_cast<double>(samples) * static_cast<double>(interval) /
                       static_cast<double>(setting.step);
  const StepMethod& method = stepMethod(setting.integrator);
  return size_ * steps * method.stepsFor(setting.substeps) * method.evaluations;
}

bool EvaluationBudget::take(double cost) {
  if (cost > left_) {
    return false;
  }
  left_ -= cost;
  return true;
}

namespace {

/// What rounding has become where a disturbance has become `disturbed`.
double inProportion(double disturbed) {
  return disturbed / kDisturbance * kRounding;
}

/// Of what `of` takes from a curve. Rounding counts in proportion, unless a disturbance as small as
/// rounding itself has become more than that: what bounds both makes them alike.
template <class Of>
double bound(const ReferenceTrajectory& reference, const Of& of) {
  const auto ofAny = [&](const ErrorCurve& curve) {
    return curve.samples() == 0 ? 0.0 : of(curve);
  };
  const double disturbed = ofAny(reference.disturbed);
  const double by_rounding = ofAny(reference.disturbed_by_rounding);
  const double in_proportion = inProportion(disturbed);
  const double rounding = by_rounding > kInProportion * in_proportion
                              ? 2.0 * std::max(disturbed, by_rounding)
                              : in_proportion;
  return std::max(2.0 * of(reference.difference), rounding);
}

}  // namespace

double ReferenceTrajectory::error(std::size_t sample) const {
  return bound(*this, [&](const ErrorCurve& curve) { return curve.position(sample); });
}

double ReferenceTrajectory::rateError(std::size_t sample) const {
  return bound(*this, [&](const ErrorCurve& curve) { return curve.rate(sample); });
}

std::size_t ReferenceTrajectory::lastWithin(double most) const {
  std::size_t last = difference.samples();
  while (last > 1 && error(last - 1) > most) {
    --last;
  }
  return last == 0 ? 0 : last - 1;
}

namespace {

/// One pair of trajectories, up to their divergence. Both methods miss a breakpoint of the forces
/// at the end of a step, after all of their nodes: they continue one sample further, and their
/// difference there is assigned to the sample before.
ReferenceTrajectory pair(const Scene& one, const StepSetting& setting, const StepSetting& other,
                         std::int64_t interval, std::size_t samples) {
  ReferenceTrajectory now;
  now.setting = setting;
  now.other = other;
  const Trajectory beside = motion(withSetting(one, other), interval, samples + 1);
  now.trajectory =
      motion(withSetting(one, setting), interval, samples + 1, [&](const Trajectory& t) {
        return now.difference.take(t, beside) &&
               now.difference.position(now.difference.samples() - 1) < kDivergedDistance;
      });
  now.difference.holdAgainstTheSampleBefore();
  now.trajectory.keep(now.difference.samples());
  return now;
}

/// How far one goes astray that starts slightly off: by parts of the largest coordinates, and in
/// parts of them, for at the start there may be none.
ErrorCurve disturbedBy(double disturbance, const Scene& one, const StepSetting& setting,
                       std::int64_t interval, const Trajectory& right) {
  std::vector<double> largest(right.dof);
  for (std::size_t i = 0; i < right.coordinates.size(); ++i) {
    double& own = largest[i % right.dof];
    own = std::max(own, std::fabs(right.coordinates[i]));
  }
  Scene off = withSetting(one, setting);
  for (std::size_t i = 0; i < right.dof; ++i) {
    off.systems.front().q[i] +=
        disturbance * (right.angular[i] ? std::min(largest[i], 1.0) : largest[i]);
  }
  ErrorCurve curve = ErrorCurve::inPartsOf(right);
  motion(off, interval, right.samples(), [&](const Trajectory& t) {
    return curve.take(t, right) && curve.position(curve.samples() - 1) < kDivergedDistance;
  });
  return curve;
}

/// What disturbances do to its motion.
void disturb(ReferenceTrajectory& reference, const Scene& one, std::int64_t interval,
             EvaluationBudget& budget) {
  const Trajectory& right = reference.trajectory;
  double cost = budget.cost(reference.other, interval, right.samples());
  reference.disturbed = disturbedBy(kDisturbance, one, reference.other, interval, right);
  const std::size_t followed = reference.disturbed.samples();
  if (followed > 0 && reference.disturbed.position(followed - 1) > kGrown * kDisturbance) {
    reference.disturbed_by_rounding = disturbedBy(kRounding, one, reference.other, interval, right);
    cost *= 2.0;
  }
  budget.take(std::min(cost, budget.left()));
}

/// Is a pair by shorter steps worth them?
bool isBetter(const ReferenceTrajectory& now, const ReferenceTrajectory& best, double wanted) {
  const auto longer = [](std::size_t a, std::size_t b) {
    return static_cast<double>(a) > kLonger * static_cast<double>(b);
  };
  const std::size_t common = std::min(now.difference.samples(), best.difference.samples());
  return longer(now.lastWithin(wanted), best.lastWithin(wanted)) ||
         longer(now.difference.samples(), best.difference.samples()) ||
         (common > 0 && now.error(common - 1) < kHalvingGain * best.error(common - 1));
}

}  // namespace

ReferenceTrajectory referenceTrajectory(const Scene& one, const std::string& method,
                                        std::vector<std::string> others, bool magnifies,
                                        std::int64_t interval, std::size_t samples, double wanted,
                                        EvaluationBudget& budget) {
  const double all = budget.left();
  const std::int64_t step = referenceStep(one);
  ReferenceTrajectory best;
  std::size_t asked = samples;
  bool parted = true;
  const auto settingOf = [&](const std::string& other, int substeps) {
    return StepSetting{other, step, substeps * (stepMethod(other).order == 4 ? 2 : 1)};
  };
  const auto costOfOne = [&](int substeps) {
    return budget.cost({method, step, substeps / 2 * 3}, interval, 1) +
           budget.cost(settingOf(others.front(), substeps), interval, 1);
  };
  for (int substeps = 2 * ownSubsteps(one); substeps <= kMaxReferenceSubsteps;) {
    const StepSetting setting{method, step, substeps / 2 * 3};
    const double of_one = costOfOne(substeps);
    const bool first = best.trajectory.samples() == 0;
    // The first run leaves budget for shorter steps; after divergence the whole budget may be used.
    const double affordable = (first ? 0.4 : 1.0) * budget.left() / of_one;
    if (static_cast<double>(asked) > affordable) {
      if (!first && !parted) {
        break;
      }
      asked = samples = static_cast<std::size_t>(affordable);
      if (asked < 2 || asked <= best.difference.samples()) {
        break;
      }
    }
    const double spent = of_one * static_cast<double>(asked);
    budget.take(spent);
    ReferenceTrajectory now =
        pair(one, setting, settingOf(others.front(), substeps), interval, asked);
    for (std::size_t i = 1; i < others.size() && 8 * now.lastWithin(wanted) < asked; ++i) {
      const StepSetting other = settingOf(others[i], substeps);
      if (!budget.take(budget.cost(setting, interval, asked) +
                       budget.cost(other, interval, asked))) {
        break;
      }
      ReferenceTrajectory by_other = pair(one, setting, other, interval, asked);
      if (by_other.lastWithin(wanted) > now.lastWithin(wanted) ||
          by_other.difference.samples() > 2 * now.difference.samples()) {
        now = std::move(by_other);
      }
    }
    const std::size_t got = now.difference.samples();
    if (got >= kFewSamples) {
      others = {now.other.integrator};
    }
    const double last = now.error(got - 1);
    parted = got < asked;
    const std::size_t agreed = now.lastWithin(wanted);
    const bool enough = agreed + 1 >= samples;
    if (magnifies && !enough && budget.left() > budget.cost(now.other, interval, got)) {
      disturb(now, one, interval, budget);
    }
    // Shorter steps do not help where rounding has grown as large as that.
    const bool rounding =
        now.disturbed.samples() > 0 &&
        inProportion(now.disturbed.position(agreed + 1)) > kHopeless * now.error(agreed + 1);
    if (first || isBetter(now, best, wanted)) {
      best = std::move(now);
    } else if (spent > kCheap * all) {
      break;
    }
    if (enough || rounding) {
      break;
    }
    if (!parted && asked < samples) {
      asked = samples;  // the same steps go further than the last ones did
      parted = true;
    } else if (parted) {
      substeps *= got < kFewSamples ? 4 : 2;
      asked = std::min(samples, 2 * got + kFewSamples);
    } else {
      int doublings = doublingsFor(last / wanted);
      while (doublings > 1 &&
             costOfOne(substeps << doublings) * static_cast<double>(asked) > budget.left()) {
        --doublings;
      }
      substeps <<= doublings;
    }
  }
  if (magnifies && best.trajectory.samples() > 0 && best.disturbed.samples() == 0) {
    disturb(best, one, interval, budget);
  }
  return best;
}

}  // namespace whirl_twin
