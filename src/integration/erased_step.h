// Steps whose equations are reached by calls, the methods compiled once for a number of
// coordinates: of systems with inputs, so that steps without are the same code as if there were
// none; of the systems of erased_system.h; and on processors without fused multiply-add, so that
// steps need not be compiled twice for each model.
#pragma once

#include <cstddef>

#include "integration/dormand_prince_8.h"
#include "integration/erased_ode.h"
#include "integration/gauss_legendre.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/stoermer.h"
#include "integration/velocity_verlet.h"

namespace whirl_twin {

// Compiled in erased_step.cpp for the numbers of coordinates that the package's own models have.
#define WHIRL_TWIN_CALLED_STEP(storage, Method, n)                                     \
  storage template StepStatus erasedStep(Method&, const ErasedOde<n>&, double, double, \
                                         MotionState<n>&) noexcept;
#define WHIRL_TWIN_STIFF_STEP(storage, Method, n)                                         \
  storage template StepStatus Method::stiffStep(const ErasedOde<n>&, double, double, int, \
                                                MotionState<n>&);
#define WHIRL_TWIN_CALLED_STEPS(storage, n)                                                 \
  WHIRL_TWIN_CALLED_STEP(storage, SemiImplicitEuler, n)                                     \
  WHIRL_TWIN_CALLED_STEP(storage, VelocityVerlet, n)                                        \
  WHIRL_TWIN_CALLED_STEP(storage, RungeKutta4, n)                                           \
  WHIRL_TWIN_CALLED_STEP(storage, DormandPrince8, n)                                        \
  storage template StepStatus Stoermer<n>::startCalled(const ErasedOde<n>&, double, double, \
                                                       MotionState<n>&);                    \
  WHIRL_TWIN_CALLED_STEP(storage, Stoermer<n>, n)                                           \
  WHIRL_TWIN_STIFF_STEP(storage, ImplicitMidpoint<n>, n)                                    \
  WHIRL_TWIN_CALLED_STEP(storage, ImplicitMidpoint<n>, n)                                   \
  WHIRL_TWIN_STIFF_STEP(storage, GaussLegendre4<n>, n)                                      \
  WHIRL_TWIN_CALLED_STEP(storage, GaussLegendre4<n>, n)                                     \
  WHIRL_TWIN_STIFF_STEP(storage, GaussLegendre6<n>, n)                                      \
  WHIRL_TWIN_CALLED_STEP(storage, GaussLegendre6<n>, n)
WHIRL_TWIN_CALLED_STEPS(extern, 1)
WHIRL_TWIN_CALLED_STEPS(extern, 2)
WHIRL_TWIN_CALLED_STEPS(extern, 3)
WHIRL_TWIN_CALLED_STEPS(extern, 4)
WHIRL_TWIN_CALLED_STEPS(extern, 5)

}  // namespace whirl_twin
