#include "mechanics/oscillators/hinged_beam.h"

#include <utility>

#include "integration/linear_methods.h"
#include "mechanics/lagrangian_dynamics.h"
#include "models/linear_rotor_setup.h"
#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

namespace {

/// The linearized form by its matrices: their exact step supports harmonic loads.
ModelSetup smallSetup(const ParameterValues& values, double gravity) {
  const SmallHingedBeam beam = makeModel<SmallHingedBeam>(values, gravity);
  const LagrangianDynamics<SmallHingedBeam> dynamics(beam);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(1);
  const Linearization l = dynamics.linearization(rest, rest, rest, {});
  LinearModel model;
  model.model = SmallHingedBeam::kName;
  model.coordinates = dynamics.coordinates();
  model.mass = l.mass;
  model.damping = l.damping;
  model.gyroscopic = l.gyroscopic;
  model.stiffness = l.stiffness;
  model.circulatory = l.circulatory;
  if (beam.load_amplitude != 0.0) {
    // At t = 0 the load is at its amplitude.
    model.forces.push_back({dynamics.residualForce(rest, rest, {}), beam.load_frequency, 0.0});
  }
  model.inputs = dynamics.inputs();
  model.sketch = [beam](const Eigen::VectorXd& q, double time) {
    return beam.sketch({q[0]}, {time, 0.0, 0.0, 0.0});
  };
  return linearSetup(std::move(model));
}

}  // namespace

ModelInfo hingedBeamInfo() {
  ModelInfo info = modelInfo<HingedBeam>();
  info.variants.push_back(variant<SmallHingedBeam>("geometry: small"));
  info.variants.back().integrators = linearMethodNames();
  info.settings.push_back({"geometry",
                           SettingKind::kChoice,
                           "",
                           "finite rotation, or small as in the lecture notes",
                           {"finite", "small"},
                           false,
                           {},
                           {}});
  info.setUp = [finite = info.setUp](const ParameterValues& values, const Settings& settings,
                                     const ModelContext& around) {
    const auto geometry = settings.choices.find("geometry");
    return geometry != settings.choices.end() && geometry->second == "small"
               ? smallSetup(values, around.gravity)
               : finite(values, settings, around);
  };
  return info;
}

}  // namespace whirl_twin
