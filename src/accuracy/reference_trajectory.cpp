#include "accuracy/reference_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

/// Half the step makes an error of order one half; rounding, which hides any order, it does not.
constexpr double kFalling = 0.7;
/// A disturbance of the start in parts of the motion, and the rounding that it stands for.
constexpr double kDisturbance = 1.0e-8;
constexpr double kRounding = 2.0e-15;

std::vector<double> smallDisturbance(const Trajectory& t) {
  std::vector<double> largest(t.dof);
  for (std::size_t i = 0; i < t.coordinates.size(); ++i) {
    double& own = largest[i % t.dof];
    own = std::max(own, std::fabs(t.coordinates[i]));
  }
  for (std::size_t i = 0; i < t.dof; ++i) {
    largest[i] = kDisturbance * (t.angular[i] ? std::min(largest[i], 1.0) : largest[i]);
  }
  return largest;
}

}  // namespace

std::size_t ReferenceTrajectory::samplesWithin(double most) const {
  if (error <= most) {
    return trajectory.samples();
  }
  return std::min(whirl_twin::samplesWithin(coarser.back().second, trajectory, most),
                  whirl_twin::samplesWithin(disturbed, coarser.front().second,
                                            most * kDisturbance / kRounding));
}

ReferenceTrajectory referenceTrajectory(const Scene& one, const std::string& integrator,
                                        std::int64_t duration, std::int64_t interval, double wanted,
                                        int most_substeps) {
  StepSetting setting{integrator, one.step, one.systems.front().substeps};
  const auto run = [&] { return trajectory(withSetting(one, setting), duration, interval); };
  ReferenceTrajectory best;
  best.trajectory = run();
  double before = std::numeric_limits<double>::infinity();
  for (bool last = false; !last;) {
    best.coarser.emplace_back(setting.substeps, std::move(best.trajectory));
    setting.substeps *= 2;
    best.trajectory = run();
    const Trajectory& coarser = best.coarser.back().second;
    const double difference =
        trajectoryError(coarser, best.trajectory, best.trajectory.samples()).position;
    // A geometric series from here on, as far as rounding lets it.
    const double ratio = difference / before;
    const bool converging = ratio < kFalling;
    best.error = difference * (converging ? std::max(0.25, ratio / (1.0 - ratio)) : 1.0);
    last = best.error <= wanted || (!converging && before < 1.0) ||
           setting.substeps * 2 > most_substeps;
    before = difference;
  }
  best.setting = setting;
  const auto& [substeps, undisturbed] = best.coarser.front();
  best.disturbed = trajectory(withSetting(one, {integrator, one.step, substeps}), duration,
                              interval, smallDisturbance(undisturbed));
  best.growth =
      trajectoryError(best.disturbed, undisturbed, undisturbed.samples()).position / kDisturbance;
  best.error = std::max(best.error, best.growth * kRounding);
  return best;
}

}  // namespace whirl_twin
