#include "scene/controlled_plant.h"

#include <cmath>
#include <map>
#include <set>

#include "algebra/lu.h"
#include "analysis/equilibria.h"
#include "scene/system_setup.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

double startSpeedOf(const Scene& scene, std::size_t system) {
  const SystemSpec& spec = scene.systems[system];
  const std::size_t drive = scene.driveOf(spec);
  return drive < scene.drives.size() ? scene.drives[drive].speed : spec.speed.value_or(0.0);
}

Linearization smallMotionAtStart(const Scene& scene, std::size_t system,
                                 std::optional<double> speed) {
  const SystemSpec& spec = scene.systems[system];
  const Dynamics& dynamics = *spec.setup->made.dynamics;
  const double at = speed.value_or(startSpeedOf(scene, system));
  const VectorXd start =
      Eigen::Map<const VectorXd>(spec.q.data(), static_cast<Index>(spec.q.size()));
  const std::optional<VectorXd> rest =
      dynamics.linear() ? std::nullopt : equilibriumNear(dynamics, start, at);
  return linearizationAtRest(dynamics, rest.value_or(start), at);
}

SignalRow rowOf(const SignalSpec& signal, const Dynamics& dynamics) {
  if (signal.kind != SignalSpec::Kind::kDisplacement) {
    return {VectorXd::Unit(dynamics.dof(), static_cast<Index>(signal.coordinate)),
            signal.kind == SignalSpec::Kind::kRate};
  }
  const Station station = dynamics.stations()[signal.station];
  const double cosine = std::cos(signal.direction);  // along y: the rounding of a right angle
  return {(std::fabs(cosine) < 1.0e-16 ? 0.0 : cosine) * station.along_x +
              std::sin(signal.direction) * station.along_y,
          false};
}

LinearPlant linearPlant(const Scene& scene, const std::vector<SignalSpec>& measures,
                        const std::vector<ActedInput>& acts_on, const SmallMotions& small_motions) {
  std::set<std::size_t> systems;
  for (const SignalSpec& signal : measures) {
    systems.insert(signal.system);
  }
  for (const ActedInput& input : acts_on) {
    systems.insert(input.system);
  }
  std::map<std::size_t, Index> start;  // of each system's states
  Index size = 0;
  for (const std::size_t i : systems) {
    start[i] = size;
    size += 2 * static_cast<Index>(scene.systems[i].q.size());
  }
  LinearPlant plant{MatrixXd::Zero(size, size),
                    MatrixXd::Zero(size, static_cast<Index>(acts_on.size())),
                    MatrixXd::Zero(static_cast<Index>(measures.size()), size)};
  for (const std::size_t i : systems) {
    const SystemSpec& system = scene.systems[i];
    const Dynamics& dynamics = *system.setup->made.dynamics;
    const Index n = dynamics.dof();
    const Index q = start[i];
    const Index v = q + n;
    const Linearization matrices = small_motions(i);
    const Eigen::PartialPivLU<MatrixXd> mass(matrices.mass);
    plant.a.block(q, v, n, n).setIdentity();
    plant.a.block(v, q, n, n) = -mass.solve(matrices.stiffness + matrices.circulatory);
    plant.a.block(v, v, n, n) = -mass.solve(matrices.damping + matrices.gyroscopic);
    const std::vector<InputInfo> inputs = dynamics.inputs();
    for (std::size_t k = 0; k < acts_on.size(); ++k) {
      if (acts_on[k].system == i) {
        plant.b.block(v, static_cast<Index>(k), n, 1) =
            mass.solve(inputs[acts_on[k].input].direction);
      }
    }
    for (std::size_t k = 0; k < measures.size(); ++k) {
      if (measures[k].system == i) {
        const SignalRow row = rowOf(measures[k], dynamics);
        plant.c.block(static_cast<Index>(k), row.of_rates ? v : q, 1, n) = row.along.transpose();
      }
    }
  }
  return plant;
}

}  // namespace whirl_twin
