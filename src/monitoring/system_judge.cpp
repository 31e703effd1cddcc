#include "monitoring/system_judge.h"

#include <cmath>
#include <exception>

#include "analysis/equilibria.h"

namespace whirl_twin {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// The threshold of an equilibrium that moves with speed is searched anew this often [s].
constexpr double kSearchPeriod = 1.0;

}  // namespace

SystemJudge::SystemJudge(const BuiltSystem& system)
    : system_(system.spec.name),
      model_(system.model->name),
      dynamics_(system.dynamics),
      speeds_(JudgedSpeeds::of(system)),
      steady_motions_(system.dynamics) {}

void SystemJudge::findThresholds(double time, const Eigen::VectorXd& about, double speed,
                                 Verdict verdict) {
  // An equilibrium that moves with speed may be another than the one that was followed: then the
  // verdict tells.
  const bool expected = dynamics_->linear() ||
                        (verdict == Verdict::kUnstable) == speeds_.thresholds.unstableAt(speed);
  if (searched_at_ && (expected || std::fabs(time - *searched_at_) < kSearchPeriod)) {
    return;
  }
  speeds_.thresholds = ThresholdSpeeds(stabilityThresholds(*dynamics_, about, speed));
  searched_at_ = time;
}

state::StabilityMargin SystemJudge::judge(const state::Instant& at, const std::vector<double>& q,
                                          const std::vector<double>& v, double speed) {
  const double shaft_speed = dynamics_->hasShaft() ? speed : 0.0;
  const auto n = static_cast<Eigen::Index>(q.size());
  const Eigen::VectorXd present = Eigen::Map<const Eigen::VectorXd>(q.data(), n);
  const Eigen::VectorXd rates = Eigen::Map<const Eigen::VectorXd>(v.data(), n);
  Eigen::VectorXd about = present;
  Stability s;
  s.routh.verdict = Verdict::kUncertain;
  s.decay_rate = s.damping_ratio = s.log_decrement = kNaN;
  try {
    const std::optional<Equilibrium> point =
        settled_                  ? settled_
        : steady_motions_.apply() ? steady_motions_.operatingPoint(at.time, present, rates)
                                  : operatingPoint(*dynamics_, present, rates, shaft_speed);
    if (dynamics_->linear() && !dynamics_->hasShaft()) {
      settled_ = point;
    }
    if (point) {
      about = point->q;
    } else if (dynamics_->linear()) {
      about.setZero();
    }
    s = point ? point->stability
              : reducedStability(linearizationAbout(*dynamics_, about, rates, shaft_speed),
                                 cyclicCoordinates(*dynamics_, shaft_speed));
    findThresholds(at.time, about, shaft_speed, s.routh.verdict);
  } catch (const std::exception&) {
    // Numbers beyond the range of double, or a singular mass: uncertain. The others are watched on.
  }

  state::StabilityMargin m;
  m.at = at;
  m.system = system_;
  m.model = model_;
  m.verdict = static_cast<std::uint8_t>(s.routh.verdict);
  m.verdict_name = name(s.routh.verdict);
  for (const CoordinateInfo& c : dynamics_->coordinates()) {
    m.coordinate.emplace_back(c.name);
  }
  m.operating_point.assign(about.data(), about.data() + about.size());
  m.speed = dynamics_->hasShaft() ? speed : kNaN;
  m.polynomial = s.polynomial;
  m.first_column = s.routh.first_column;
  m.right = static_cast<std::uint32_t>(s.routh.right);
  m.imaginary = static_cast<std::uint32_t>(s.routh.imaginary);
  m.left = static_cast<std::uint32_t>(s.routh.left);
  m.decay_rate = s.decay_rate;
  m.damping_ratio = s.damping_ratio;
  m.log_decrement = s.log_decrement;
  m.instability_speed = speeds_.thresholds.lowest();
  m.threshold_below = speeds_.thresholds.below(shaft_speed);
  m.threshold_above = speeds_.thresholds.above(shaft_speed);
  m.critical_speeds = speeds_.marginsAt(speed);
  return m;
}

}  // namespace whirl_twin
