#include "scene/controlled_plant.h"

#include <cmath>

#include "algebra/dense.h"
#include "analysis/equilibria.h"
#include "mechanics/held_inputs.h"
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

SystemMotion motionAtStart(const Scene& scene, std::size_t system, std::optional<double> speed) {
  const SystemSpec& spec = scene.systems[system];
  const auto n = static_cast<Index>(spec.q.size());
  return {spec.setup->made.dynamics.get(), Eigen::Map<const VectorXd>(spec.q.data(), n),
          Eigen::Map<const VectorXd>(spec.v.data(), n),
          speed.value_or(startSpeedOf(scene, system))};
}

ClosedLoopEquilibrium restNear(const SystemMotion& present) {
  const Dynamics& dynamics = *present.dynamics;
  const std::optional<VectorXd> rest =
      dynamics.linear() ? std::nullopt : equilibriumNear(dynamics, present.q, present.speed);
  return {&dynamics, rest.value_or(present.q), VectorXd::Zero(present.q.size()), present.speed,
          VectorXd::Zero(static_cast<Index>(dynamics.inputs().size()))};
}

SignalRow rowOf(const SignalSpec& signal, const Dynamics& dynamics) {
  if (signal.kind != SignalSpec::Kind::kDisplacement) {
    return {VectorXd::Unit(dynamics.dof(), static_cast<Index>(signal.coordinate)),
            signal.kind == SignalSpec::Kind::kRate};
  }
  const Station station = dynamics.places()[signal.station];
  const double cosine = std::cos(signal.direction);  // the cosine of a right angle is rounding only
  return {(std::fabs(cosine) < 1.0e-16 ? 0.0 : cosine) * station.along_x +
              std::sin(signal.direction) * station.along_y,
          false};
}

LinearPlant linearPlant(const std::vector<SignalSpec>& measures,
                        const std::vector<ActedInput>& acts_on, const HeldMotions& about) {
  Index size = 0;
  for (const auto& [system, motion] : about) {
    size += 2 * motion.q.size();
  }
  LinearPlant plant{MatrixXd::Zero(size, size),
                    MatrixXd::Zero(size, static_cast<Index>(acts_on.size())),
                    MatrixXd::Zero(static_cast<Index>(measures.size()), size)};
  Index q = 0;  // index of a system's first state
  for (const auto& [system, motion] : about) {
    const Dynamics& dynamics = *motion.dynamics;
    const Index n = dynamics.dof();
    const Index v = q + n;
    const Linearization matrices = linearizationAbout(dynamics, motion.q, motion.v, motion.speed);
    const HeldInputs inputs = heldInputs(dynamics, motion.q, motion.inputs);
    const Lu mass(matrices.mass);
    plant.a.block(q, v, n, n).setIdentity();
    plant.a.block(v, q, n, n) =
        -mass.solve(matrices.stiffness + matrices.circulatory + inputs.stiffness);
    plant.a.block(v, v, n, n) = -mass.solve(matrices.damping + matrices.gyroscopic);
    for (std::size_t k = 0; k < acts_on.size(); ++k) {
      if (acts_on[k].system == system) {
        plant.b.block(v, static_cast<Index>(k), n, 1) =
            mass.solve(inputs.by_input.col(static_cast<Index>(acts_on[k].input)));
      }
    }
    for (std::size_t k = 0; k < measures.size(); ++k) {
      if (measures[k].system == system) {
        const SignalRow row = rowOf(measures[k], dynamics);
        plant.c.block(static_cast<Index>(k), row.of_rates ? v : q, 1, n) = row.along.transpose();
      }
    }
    q += 2 * n;
  }
  return plant;
}

}  // namespace whirl_twin
