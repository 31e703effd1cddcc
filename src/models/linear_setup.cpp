#include "models/linear_setup.h"

#include <memory>
#include <string>
#include <utility>

#include "integration/linear_methods.h"
#include "integration/linear_stepper.h"

namespace whirl_twin {

ModelSetup linearSetup(LinearModel model) {
  const auto dynamics = std::make_shared<const LinearDynamics>(std::move(model));
  return {dynamics, linearMethodNames(),
          [dynamics](const std::string& integrator, const Excitation& excitation, double step,
                     int substeps) {
            return std::make_unique<LinearStepper>(dynamics->linearModel(), integrator, step,
                                                   substeps, excitation.inputs);
          }};
}

}  // namespace whirl_twin
