#include "models/linear_rotor_setup.h"

#include <utility>

#include "integration/exponential.h"

namespace whirl_twin {

namespace {

ModelSetup exactSetup(std::shared_ptr<const Dynamics> dynamics, const JacobiIntegral& jacobi) {
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, jacobi](const std::string&, const Drive& drive, double step,
                                    int substeps) {
    return std::make_unique<LinearRotorStepper>(dynamics, jacobi, drive, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace

ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics) {
  return exactSetup(std::move(dynamics), {});
}

ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi) {
  if (!setup.dynamics->linear() || !setup.dynamics->speedDependent()) {
    return setup;
  }
  setup.system = [plain = setup.system, exact = exactSetup(setup.dynamics, jacobi).system](
                     const std::string& integrator, const Drive& drive, double step, int substeps) {
    const bool exponential = integrator == Exponential<1>::kName;
    return (exponential ? exact : plain)(integrator, drive, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace whirl_twin
