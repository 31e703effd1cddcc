#include "integration/step_methods.h"

#include <algorithm>
#include <stdexcept>

#include "integration/dormand_prince_8.h"
#include "integration/exponential.h"
#include "integration/gauss_legendre.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/stoermer_weights.h"
#include "integration/velocity_verlet.h"

namespace whirl_twin {

const std::vector<StepMethod>& stepMethods() {
  static const std::vector<StepMethod> methods{
      {SemiImplicitEuler::kName, 1, false, true, false, true, 1.0},
      {VelocityVerlet::kName, 2, false, true, false, true, 2.0},
      {ImplicitMidpoint<1>::kName, 2, true, true, true, false, 5.0},
      {RungeKutta4::kName, 4, false, false, false, false, 4.0},
      {GaussLegendre4<1>::kName, 4, true, true, true, false, 10.0},
      {GaussLegendre6<1>::kName, 6, true, true, true, false, 15.0},
      {kStoermerSchemes[0].name, 6, false, false, false, false, 1.8, kStoermerSchemes[0].terms - 1},
      {DormandPrince8::kName, 8, false, false, false, false, 13.0},
      {kStoermerSchemes[1].name, 9, false, false, false, false, 3.2, kStoermerSchemes[1].terms - 1},
      {kStoermerSchemes[2].name, 9, false, false, false, false, 3.2, kStoermerSchemes[2].terms - 1,
       true},
      {kStoermerSchemes[3].name, 9, false, false, false, false, 1.9, kStoermerSchemes[3].terms - 1,
       false, true},
      {Exponential<1>::kName, 0, false, true, true, false, 1.0}};
  return methods;
}

const StepMethod& stepMethod(const std::string& name) {
  const auto found = std::find_if(stepMethods().begin(), stepMethods().end(),
                                  [&](const StepMethod& m) { return m.name == name; });
  if (found == stepMethods().end()) {
    throw std::logic_error("unknown integrator: " + name);
  }
  return *found;
}

std::string stepsText(const std::string& integrator, int substeps) {
  return stepMethod(integrator).ahead && substeps > 1
             ? "one for " + std::to_string(substeps) + " steps"
             : std::to_string(substeps) + " per step";
}

}  // namespace whirl_twin
