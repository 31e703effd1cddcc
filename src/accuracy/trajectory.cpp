#include "accuracy/trajectory.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "analysis/cyclic_coordinates.h"
#include "integration/step_methods.h"
#include "realtime/denormals.h"
#include "scene/part_of_scene.h"
#include "scene/scene_error.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {

Scene sceneOfOne(const Scene& scene, std::size_t system) {
  Scene one = partOf(scene, {system});
  const std::size_t drive = scene.driveOf(one.systems.front());
  one.drives.clear();
  one.sensors.clear();
  if (drive < scene.drives.size()) {
    one.drives = {scene.drives[drive]};
    one.systems.front().drive_place = 0;
  }
  return one;
}

int ownSubsteps(const Scene& one) {
  const SystemSpec& spec = one.systems.front();
  const bool ahead = spec.integrator != "auto" && stepMethod(spec.integrator).ahead;
  return ahead ? 1 : spec.substeps;
}

Scene withSetting(const Scene& one, const StepSetting& setting) {
  Scene scene = one;
  scene.step = setting.step;
  scene.systems.front().integrator = setting.integrator;
  scene.systems.front().substeps = setting.substeps;
  return scene;
}

namespace {

/// Follows the momenta that the equations conserve.
class MomentumWatch {
 public:
  MomentumWatch(const Dynamics& dynamics, double speed) : dynamics_(dynamics) {
    if (!dynamics.linear()) {
      conserved_ = cyclicCoordinates(dynamics, speed).conserved;
    }
  }

  void take(const double* q, const double* v, const EvaluationPoint<double>& at) {
    if (conserved_.empty()) {
      return;
    }
    const Eigen::Map<const Eigen::VectorXd> position(q, dynamics_.dof());
    const Eigen::Map<const Eigen::VectorXd> rate(v, dynamics_.dof());
    const Eigen::VectorXd momenta = dynamics_.momenta(position, rate, at);
    if (start_.size() == 0) {
      start_ = momenta;
    }
    const Eigen::MatrixXd mass = dynamics_.massMatrix(position, rate, at);
    for (const Eigen::Index i : conserved_) {
      size_ = std::max(size_, mass.row(i).cwiseAbs().dot(rate.cwiseAbs()));
      change_ = std::max(change_, std::fabs(momenta[i] - start_[i]));
    }
  }
  double drift() const {
    return conserved_.empty() ? std::numeric_limits<double>::quiet_NaN()
           : change_ == 0.0   ? 0.0
                              : change_ / size_;
  }

 private:
  const Dynamics& dynamics_;
  CyclicCoordinates::Places conserved_;
  Eigen::VectorXd start_;
  double size_ = 0.0;
  double change_ = 0.0;
};

Trajectory emptyTrajectory(const Dynamics& dynamics, std::int64_t interval) {
  Trajectory result;
  result.interval = static_cast<double>(interval) * 1.0e-9;
  result.dof = static_cast<std::size_t>(dynamics.dof());
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    result.angular.push_back(c.isAngle());
  }
  return result;
}

}  // namespace

Trajectory motion(const Scene& one, std::int64_t interval, std::size_t samples,
                  const std::function<bool(const Trajectory&)>& go_on) {
  const DenormalsToZero denormals_to_zero;
  BuiltScene built = build(one);
  Trajectory result = emptyTrajectory(*built.systems.front()->dynamics, interval);
  std::unique_ptr<Twin> twin;
  try {
    twin = std::make_unique<Twin>(std::move(built));
  } catch (const SceneError&) {
    return result;
  }
  std::vector<double> record(twin->layout().size);
  const std::int64_t stride = interval / one.step;
  for (std::size_t k = 0; k < samples; ++k) {
    for (std::int64_t i = 0; k > 0 && i < stride; ++i) {
      twin->step();
    }
    result.status = twin->status(0);
    if (result.status != StepStatus::kOk) {
      break;
    }
    twin->write(record.data());
    const SystemView now = twin->layout().system(record.data(), 0);
    result.coordinates.insert(result.coordinates.end(), now.q(), now.q() + result.dof);
    result.rates.insert(result.rates.end(), now.v(), now.v() + result.dof);
    if (go_on && !go_on(result)) {
      break;
    }
  }
  return result;
}

Trajectory trajectory(const Scene& one, std::int64_t duration, std::int64_t interval,
                      const std::vector<double>& dq) {
  const DenormalsToZero denormals_to_zero;
  Scene scene = one;
  for (std::size_t i = 0; i < dq.size(); ++i) {
    scene.systems.front().q[i] += dq[i];
  }
  Twin twin(scene);
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  const Dynamics& dynamics = *twin.systems().front()->dynamics;
  Trajectory result = emptyTrajectory(dynamics, interval);
  MomentumWatch momentum(dynamics, twin.drive(twin.systems().front()->drive).at(0.0).speed);
  const auto sample = [&] {
    twin.write(record.data());
    observer.observe(record.data());
    result.coordinates.insert(result.coordinates.end(), observer.coordinates(0),
                              observer.coordinates(0) + result.dof);
    result.rates.insert(result.rates.end(), observer.rates(0), observer.rates(0) + result.dof);
    if (dynamics.isRotor()) {
      result.whirl_radius.push_back(observer.whirlRadius(0));
      result.whirl_phase.push_back(observer.whirlPhase(0));
    }
    momentum.take(observer.coordinates(0), observer.rates(0), observer.moment(0));
    const Energies energies = observer.energies(0);
    result.energy.push_back(energies.kinetic + energies.potential);
    result.energy_drift = std::max(result.energy_drift, std::abs(observer.energyResidual(0)));
  };
  sample();
  const std::int64_t stride = interval / scene.step;
  for (std::int64_t time = interval; time <= duration; time += interval) {
    for (std::int64_t i = 0; i < stride; ++i) {
      twin.step();
    }
    result.status = twin.status(0);
    if (result.status != StepStatus::kOk) {
      break;
    }
    sample();
  }
  result.momentum_drift = momentum.drift();
  return result;
}

}  // namespace whirl_twin
