#include "monitoring/stability_evaluator.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <exception>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "analysis/equilibria.h"
#include "analysis/stability_margins.h"
#include "analysis/whirl_modes.h"
#include "scene/driven_dynamics.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

namespace {

/// The threshold of an equilibrium that moves with speed is searched again this often [s].
constexpr double kThresholdSearchPeriod = 1.0;
/// Of a speed, and of the evaluated place: a negligible change. The full-order model of a long
/// rotor takes ten times as long to evaluate as the reduced-order one.
constexpr double kSame = 1.0e-4;

/// [-], of the motions of a rotor that damping is required of: up to twice the frequency of its
/// fourth whirl, as a reduction holds (usualHighestSpeed), or what its scene gives as
/// highest_speed, and up to the speed of its shaft. Beyond are those of its mesh.
double leastDampingRatio(const BuiltSystem& system, const Stability& s, double speed) {
  constexpr std::size_t kWhirls = 4;
  std::vector<std::complex<double>> whirls;  // by rising |s|
  for (const std::complex<double>& root : s.eigenvalues) {
    if (root.imag() > 0.0 && -root.real() <= kMaxWhirlDamping * std::abs(root)) {
      whirls.push_back(root);
    }
  }
  if (!system.dynamics->isRotor() || !system.dynamics->hasShaft() || whirls.size() <= kWhirls ||
      std::isnan(s.damping_ratio)) {
    return s.damping_ratio;
  }
  const auto given = system.spec.parameters.find("highest_speed");
  const double highest = given != system.spec.parameters.end() && given->second > 0.0
                             ? given->second
                             : 2.0 * std::abs(whirls[kWhirls - 1]);
  double least = -whirls.front().real() / std::abs(whirls.front());
  for (const std::complex<double>& root : whirls) {
    if (std::abs(root) <= std::max(highest, std::fabs(speed))) {
      least = std::min(least, -root.real() / std::abs(root));
    }
  }
  return least;
}

state::StabilityMargin marginOf(const BuiltSystem& system, const Stability& s,
                                const state::Instant& at, const std::vector<double>& about,
                                double speed) {
  state::StabilityMargin m;
  m.at = at;
  m.system = system.spec.name;
  m.model = system.model->name;
  m.verdict = static_cast<std::uint8_t>(s.routh.verdict);
  m.verdict_name = name(s.routh.verdict);
  for (const CoordinateInfo& c : system.dynamics->coordinates()) {
    m.coordinate.emplace_back(c.name);
  }
  m.operating_point = about;
  m.speed = system.dynamics->hasShaft() ? speed : kNaN;
  m.polynomial = s.polynomial;
  m.first_column = s.routh.first_column;
  m.right = static_cast<std::uint32_t>(s.routh.right);
  m.imaginary = static_cast<std::uint32_t>(s.routh.imaginary);
  m.left = static_cast<std::uint32_t>(s.routh.left);
  m.decay_rate = s.decay_rate;
  m.damping_ratio = s.damping_ratio;
  m.log_decrement = s.log_decrement;
  m.right_by_eigenvalues = static_cast<std::uint32_t>(s.right_by_eigenvalues);
  m.routh_disagrees = s.right_by_eigenvalues != s.routh.right;
  return m;
}

}  // namespace

state::StabilityMargin uncertainMargin(const BuiltSystem& system, const state::Instant& at,
                                       const std::vector<double>& q, double speed) {
  state::StabilityMargin m = marginOf(system, unjudged(), at, q, speed);
  m.instability_speed = kNaN;
  return m;
}

StabilityEvaluator::StabilityEvaluator(SharedSystem system, std::shared_ptr<const ClosedLoop> loop)
    : system_(std::move(system)),
      driven_(judgedDynamics(system_->dynamics, system_->spec)),
      tables_(tableSpeeds(*system_)),
      steady_motions_(driven_) {
  if (loop) {
    loop_.emplace(system_, std::move(loop));
  } else {
    unreduced_ = FullOrderMargins::of(system_->dynamics);
  }
}

const CharacteristicSpeeds& StabilityEvaluator::speeds() {
  if (!speeds_) {
    speeds_ = loop_ ? CharacteristicSpeeds() : CharacteristicSpeeds::of(*system_);
  }
  return *speeds_;
}

void StabilityEvaluator::checkThresholds(double time, double speed, Verdict verdict) {
  // An equilibrium that moves with speed may differ from the one that was followed: then the
  // verdict decides.
  const bool expected =
      system_->dynamics->linear() ||
      (verdict == Verdict::kUnstable) == (speeds_ && speeds_->thresholds.unstableAt(speed));
  lacks_thresholds_ =
      !searched_at_ || (!expected && std::fabs(time - *searched_at_) >= kThresholdSearchPeriod);
}

void StabilityEvaluator::complete(double speed, state::StabilityMargin& margin) {
  if (loop_) {
    loop_->findMargins();
  } else {
    findSpeeds(speed, margin);
  }
}

std::vector<state::ControllerMargins> StabilityEvaluator::loopMargins(
    const state::Instant& at) const {
  auto margins = loop_ ? loop_->margins() : std::vector<state::ControllerMargins>{};
  for (state::ControllerMargins& one : margins) {
    one.at = at;
  }
  return margins;
}

void StabilityEvaluator::findSpeeds(double speed, state::StabilityMargin& margin) {
  static_cast<void>(speeds());
  if (lacks_thresholds_) {
    const std::vector<double>& about = margin.operating_point;
    const auto n = static_cast<Eigen::Index>(about.size());
    try {
      speeds_->thresholds = ThresholdSpeeds(stabilityThresholds(
          *driven_, Eigen::Map<const Eigen::VectorXd>(about.data(), n), shaftSpeed(speed)));
      searched_at_ = margin.at.time;
    } catch (const std::exception&) {
      // Numbers beyond the range of double, or a singular mass: it is tried again.
    }
    lacks_thresholds_ = false;
  }
  putSpeeds(speed, margin);
}

void StabilityEvaluator::putSpeeds(double speed, state::StabilityMargin& margin) const {
  const CharacteristicSpeeds known = speeds_.value_or(CharacteristicSpeeds());
  margin.instability_speed = known.thresholds.lowest();
  margin.threshold_below = known.thresholds.below(shaftSpeed(speed));
  margin.threshold_above = known.thresholds.above(shaftSpeed(speed));
  margin.critical_speeds = known.marginsAt(speed);
}

Stability StabilityEvaluator::openStability(const state::Instant& at,
                                            const Eigen::VectorXd& present,
                                            const Eigen::VectorXd& rates, double speed,
                                            Eigen::VectorXd& about) {
  const Dynamics& dynamics = *driven_;
  const std::optional<Equilibrium> point =
      settled_                  ? settled_
      : steady_motions_.apply() ? steady_motions_.operatingPoint(at.time, present, rates)
                                : operatingPoint(dynamics, present, rates, speed);
  if (dynamics.linear() && !dynamics.hasShaft()) {
    settled_ = point;
  }
  evaluated_about_ = state::StabilityMargin::About::kEquilibrium;
  if (point && point->periodic) {
    evaluated_about_ = state::StabilityMargin::About::kPeriodicMotion;
  } else if (!dynamics.linear() && &dynamics.atMeanLoad() != &dynamics) {
    evaluated_about_ = state::StabilityMargin::About::kMeanLoads;
  }
  if (point) {
    about = point->q;
    motion_ = SteadyMotion{point->q, point->v};
  } else if (dynamics.linear()) {
    about.setZero();
  }
  if (!point && !dynamics.linear()) {
    return unjudged();
  }
  Stability s = point ? point->stability
                      : reducedStability(linearizationAbout(dynamics, about, rates, speed),
                                         cyclicCoordinates(dynamics, speed));
  if (!point && isUnsupported(dynamics, speed)) {
    s.routh.verdict = Verdict::kUncertain;
  }
  checkThresholds(at.time, speed, s.routh.verdict);
  return s;
}

ReducedMargins StabilityEvaluator::fullOrderMargins(const Eigen::VectorXd& about, double speed) {
  const Eigen::VectorXd place = about.head(unreduced_->amplitudes());  // without a motor's angle
  const bool same =
      reduction_ && std::fabs(speed - reduction_->speed) <= kSame * std::fabs(speed) &&
      (system_->dynamics->linear() || (place - reduction_->place).norm() <= kSame * place.norm());
  if (!same) {
    reduction_.reset();
    reduction_ = EvaluatedReduction{speed, place, unreduced_->at(place, speed)};
  }
  return reduction_->margins;
}

state::StabilityMargin StabilityEvaluator::evaluate(const state::Instant& at,
                                                    const std::vector<double>& q,
                                                    const std::vector<double>& v, double speed,
                                                    const SystemMotions& beside,
                                                    double acceleration) {
  const Dynamics& dynamics = *system_->dynamics;
  const double shaft_speed = shaftSpeed(speed);
  const auto n = static_cast<Eigen::Index>(q.size());
  const Eigen::VectorXd present = Eigen::Map<const Eigen::VectorXd>(q.data(), n);
  const Eigen::VectorXd rates = Eigen::Map<const Eigen::VectorXd>(v.data(), n);
  Eigen::VectorXd about = present;
  Stability s = unjudged();
  std::optional<ReducedMargins> reduction;
  motion_.reset();
  failure_.clear();
  lacks_thresholds_ = false;
  try {
    s = loop_ ? loop_->evaluate(at.time, {&dynamics, present, rates, shaft_speed, acceleration},
                                beside, about)
              : openStability(at, present, rates, shaft_speed, about);
    if (unreduced_ && (motion_ || dynamics.linear())) {
      reduction = fullOrderMargins(
          about, dynamics.hasShaft() ? speed : (motion_ ? motion_->v : rates)[n - 1]);
    }
  } catch (const LoopNotLinear&) {
    s = unjudged();
  } catch (const std::exception& failure) {
    // Numbers beyond the range of double, a singular mass, or a full-order rotor without an
    // equilibrium: uncertain. The others are evaluated as before.
    failure_ = failure.what();
    s = unjudged();
  }
  if (reduction && reduction->disagree()) {
    s.routh.verdict = Verdict::kUncertain;
  }
  if (!tables_.covers(dynamics.hasShaft() ? speed : rates[n - 1])) {
    s.routh.verdict = Verdict::kUncertain;  // of coefficients that were not measured
  }

  state::StabilityMargin m =
      marginOf(*system_, s, at, {about.data(), about.data() + about.size()}, speed);
  m.judged_about = evaluated_about_;
  if (!loop_ && !unreduced_) {
    m.damping_ratio = leastDampingRatio(*system_, s, speed);
    m.log_decrement =
        m.damping_ratio == s.damping_ratio ? s.log_decrement : logDecrement(m.damping_ratio);
  }
  if (reduction) {
    m.unreduced_decay_rate = reduction->unreduced.decay_rate;
    m.unreduced_log_decrement = reduction->unreduced.log_decrement;
    m.reduction_disagrees = reduction->disagree();
  }
  putSpeeds(speed, m);
  return m;
}

}  // namespace whirl_twin
