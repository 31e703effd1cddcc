#include "models/linear_rotor_setup.h"

#include <utility>

#include "integration/exponential.h"
#include "integration/lateral_rotor_stepper.h"
#include "integration/linear_rotor_stepper.h"
#include "mechanics/locally_forced_rotor.h"
#include "models/exact_stepper.h"

namespace whirl_twin {

std::unique_ptr<Stepper> exactStepper(std::shared_ptr<const Dynamics> dynamics,
                                      JacobiIntegral jacobi, const Excitation& excitation,
                                      double step, int substeps) {
  return std::make_unique<LinearRotorStepper>(std::move(dynamics), std::move(jacobi), excitation,
                                              step, substeps);
}

ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics,
                            std::vector<LocalForce> forces) {
  if (!forces.empty()) {
    dynamics = std::make_shared<LocallyForcedRotor>(std::move(dynamics), forces);
  }
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, forces = std::move(forces)](
                     const std::string&, const Excitation& excitation, double step, int substeps) {
    return std::make_unique<LinearRotorStepper>(dynamics, JacobiIntegral(), excitation, step,
                                                substeps, forces);
  };
  setup.exact_run_ups = true;
  return setup;
}

ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi) {
  setup.system = [dynamics = setup.dynamics, plain = setup.system, jacobi](
                     const std::string& integrator, const Excitation& excitation, double step,
                     int substeps) {
    if (integrator != Exponential<1>::kName) {
      return plain(integrator, excitation, step, substeps);
    }
    if (excitation.inputs == nullptr) {
      if (auto lateral =
              LateralRotorStepper::of(dynamics->linearRotor(), excitation.drive, step, substeps)) {
        return lateral;
      }
    }
    return exactStepper(dynamics, jacobi, excitation, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace whirl_twin
