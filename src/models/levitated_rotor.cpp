#include "models/levitated_rotor.h"

#include <utility>

#include "mechanics/linear_rotor_dynamics.h"
#include "models/linear_rotor_setup.h"

namespace whirl_twin {

ModelSetup levitatedRotorSetup(std::shared_ptr<const Dynamics> plain,
                               const std::vector<PlacedMagnet>& magnets) {
  RotorDescription description;
  description.model = plain->model();
  description.coordinates = plain->coordinates();
  description.stations = plain->stations();
  description.casing = plain->casing();
  description.inputs = plain->inputs();
  description.phase_mark = plain->phaseMark();
  description.natural_length = plain->naturalLength();
  description.sketch = [plain](const Eigen::VectorXd& q, double angle) {
    return plain->sketch(q, {0.0, angle, 0.0, 0.0});
  };
  const std::size_t first_input = description.inputs.size();
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(plain->dof(), plain->dof());
  for (const PlacedMagnet& placed : magnets) {
    if (!placed.suffix.empty()) {
      description.stations.push_back(
          {"magnet_" + placed.suffix, 0.0, placed.along_x, placed.along_y});
    }
    for (const InputInfo& current : currentsOf(placed)) {
      description.inputs.push_back(current);
    }
    pull += placed.magnet.ks * (placed.along_x * placed.along_x.transpose() +
                                placed.along_y * placed.along_y.transpose());
  }
  LinearRotor rotor = plain->linearRotor();
  rotor.matrices = [plain, matrices = rotor.matrices, pull](double speed) {
    Linearization l = matrices(speed);
    l.stiffness -= pull;
    return l;
  };
  return linearRotorSetup(
      std::make_shared<LinearRotorDynamics>(std::move(description), std::move(rotor)),
      localForcesOf(magnets, first_input));
}

}  // namespace whirl_twin
