#include "accuracy/past_margin.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/dense.h"
#include "integration/step_methods.h"
#include "integration/stoermer_growth.h"

namespace whirl_twin {

namespace {

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

/// Does a method make of small deviations q'' = by_q q + by_v q' in a step of h [s] no more than
/// they themselves do?
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

}  // namespace

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
      const Moment<double> at{0.0, 0.0, speed, 0.0};
      const Linearization l = dynamics.linearization(q, v, dynamics.acceleration(q, v, at), at);
      if (!growsNoFaster(*scheme, l, h)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace whirl_twin
