// Systems with type-erased equations, compiled once for a number of coordinates: methods that
// `auto` does not select for speed, and models whose equations are long compared with a call.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "integration/erased_step.h"
#include "integration/method_list.h"

namespace whirl_twin {

/// Methods of any model.
template <std::size_t n>
using AnyModelsMethods =
    MethodList<SemiImplicitEuler, VelocityVerlet, RungeKutta4, DormandPrince8, Stoermer<n>,
               ImplicitMidpoint<n>, GaussLegendre4<n>, GaussLegendre6<n>>;

/// nullptr: no such method is of any model.
template <std::size_t n>
std::unique_ptr<Stepper> erasedSystem(const ErasedModel<n>& model, const std::string& integrator,
                                      const Drive& drive, const InputForce& inputs, double step,
                                      int substeps) {
  return makeStepper(AnyModelsMethods<n>{}, model, integrator, drive, inputs, step, substeps);
}

// Compiled in erased_step.cpp for the numbers of coordinates that the package's own models have.
#define WHIRL_TWIN_CALLED_SYSTEM(storage, n)              \
  storage template std::unique_ptr<Stepper> erasedSystem( \
      const ErasedModel<n>&, const std::string&, const Drive&, const InputForce&, double, int);
WHIRL_TWIN_CALLED_SYSTEM(extern, 1)
WHIRL_TWIN_CALLED_SYSTEM(extern, 2)
WHIRL_TWIN_CALLED_SYSTEM(extern, 3)
WHIRL_TWIN_CALLED_SYSTEM(extern, 4)
WHIRL_TWIN_CALLED_SYSTEM(extern, 5)

}  // namespace whirl_twin
