// SUNDIALS CVODE: the Adams methods with fixed-point iteration, and the BDF with Newton's and a
// dense solver; samples by its own interpolation.
#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "scene.h"

namespace whirl_twin::comparison {

/// Detects equations with an analytic Jacobian, by columns; else CVODE uses differences.
template <class Equations, class = void>
struct HasJacobian : std::false_type {};
template <class Equations>
struct HasJacobian<Equations, std::void_t<decltype(&Equations::jacobian)>> : std::true_type {};

template <class Equations>
class CvodeRun final : public Run {
 public:
  CvodeRun(const Problem<Equations>& problem, int method, double tolerance) : problem_(problem) {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(static_cast<sunindextype>(Equations::kStates), context_);
    putStart();
    solver_ = CVodeCreate(method, context_);
    CVodeInit(solver_, &CvodeRun::slope, 0.0, state_);
    CVodeSetUserData(solver_, &problem_.equations);
    CVodeSStolerances(solver_, tolerance, tolerance * problem.amplitude);
    CVodeSetMaxNumSteps(solver_, 1000000);
    CVodeSetErrFile(solver_, nullptr);
    if (method == CV_ADAMS) {
      fixed_point_ = SUNNonlinSol_FixedPoint(state_, 0, context_);
      CVodeSetNonlinearSolver(solver_, fixed_point_);
    } else {
      constexpr auto n = static_cast<sunindextype>(Equations::kStates);
      matrix_ = SUNDenseMatrix(n, n, context_);
      linear_ = SUNLinSol_Dense(state_, matrix_, context_);
      CVodeSetLinearSolver(solver_, linear_, matrix_);
      if constexpr (HasJacobian<Equations>::value) {
        CVodeSetJacFn(solver_, &CvodeRun::jacobian);
      }
    }
  }
  ~CvodeRun() override {
    CVodeFree(&solver_);
    if (fixed_point_ != nullptr) {
      SUNNonlinSolFree(fixed_point_);
    } else {
      SUNLinSolFree(linear_);
      SUNMatDestroy(matrix_);
    }
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }
  CvodeRun(const CvodeRun&) = delete;
  CvodeRun& operator=(const CvodeRun&) = delete;

  bool integrate(double* out) override {
    putStart();
    CVodeReInit(solver_, 0.0, state_);
    double t = 0.0;
    for (std::size_t sample = 0; sample < problem_.output.samples; ++sample) {
      if (CVode(solver_, problem_.output.time(sample), state_, &t, CV_NORMAL) < 0) {
        return false;
      }
      out = std::copy_n(N_VGetArrayPointer(state_), problem_.output.coordinates, out);
    }
    return true;
  }

 private:
  static_assert(std::is_same_v<realtype, double>, "a CVODE in double precision is expected");

  void putStart() {
    std::copy(problem_.start.begin(), problem_.start.end(), N_VGetArrayPointer(state_));
  }
  static int slope(realtype t, N_Vector x, N_Vector dxdt, void* equations) {
    (*static_cast<Equations*>(equations))(NV_DATA_S(x), NV_DATA_S(dxdt), t);
    return 0;
  }
  static int jacobian(realtype, N_Vector, N_Vector, SUNMatrix matrix, void* equations, N_Vector,
                      N_Vector, N_Vector) {
    if constexpr (HasJacobian<Equations>::value) {
      static_cast<Equations*>(equations)->jacobian(SM_DATA_D(matrix));
    }
    return 0;
  }

  Problem<Equations> problem_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  void* solver_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
};

template <class Equations>
void addCvode(const Problem<Equations>& problem, std::vector<Contender>& contenders) {
  const auto add = [&](const std::string& name, int method) {
    contenders.push_back({"CVODE " + name, false, Ladder::kTolerances, tolerances(),
                          [problem, method](double tolerance) {
                            return std::make_unique<CvodeRun<Equations>>(problem, method,
                                                                         tolerance);
                          }});
  };
  add("Adams", CV_ADAMS);
  add("BDF", CV_BDF);
}

}  // namespace whirl_twin::comparison
