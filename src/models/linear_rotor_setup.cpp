#include "models/linear_rotor_setup.h"

#include <utility>

#include "integration/exponential.h"
#include "integration/lateral_rotor_stepper.h"
#include "integration/linear_rotor_stepper.h"
#include "models/exact_stepper.h"

namespace whirl_twin {

namespace {

ModelSetup exactSetup(std::shared_ptr<const Dynamics> dynamics, const JacobiIntegral& jacobi) {
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, jacobi](const std::string&, const Excitation& excitation, double step,
                                    int substeps) {
    return exactStepper(dynamics, jacobi, excitation, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace

std::unique_ptr<Stepper> exactStepper(std::shared_ptr<const Dynamics> dynamics,
                                      JacobiIntegral jacobi, const Excitation& excitation,
                                      double step, int substeps) {
  return std::make_unique<LinearRotorStepper>(std::move(dynamics), std::move(jacobi), excitation,
                                              step, substeps);
}

ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics) {
  return exactSetup(std::move(dynamics), {});
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
