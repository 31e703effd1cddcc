// GNU Scientific Library: explicit Runge-Kutta pairs under its standard error control.
#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "scene.h"

namespace whirl_twin::comparison {

template <class Equations>
class GslRun final : public Run {
 public:
  GslRun(const Problem<Equations>& problem, const gsl_odeiv2_step_type* type, double tolerance)
      : problem_(problem),
        system_{&GslRun::slope, nullptr, Equations::kStates, &problem_.equations},
        driver_(gsl_odeiv2_driver_alloc_y_new(&system_, type, firstStep(),
                                              tolerance * problem.amplitude, tolerance),
                &gsl_odeiv2_driver_free) {
    gsl_odeiv2_driver_set_nmax(driver_.get(), 1000000);
  }

  bool integrate(double* out) override {
    gsl_odeiv2_driver_reset_hstart(driver_.get(), firstStep());
    auto x = problem_.start;
    double t = 0.0;
    for (std::size_t sample = 0; sample < problem_.output.samples; ++sample) {
      const double end = problem_.output.time(sample);
      if (gsl_odeiv2_driver_apply(driver_.get(), &t, end, x.data()) != GSL_SUCCESS) {
        return false;
      }
      out = std::copy_n(x.data(), problem_.output.coordinates, out);
    }
    return true;
  }

 private:
  static int slope(double t, const double* x, double* dxdt, void* equations) {
    (*static_cast<Equations*>(equations))(x, dxdt, t);
    return GSL_SUCCESS;
  }
  double firstStep() const { return 0.01 * problem_.output.interval; }

  Problem<Equations> problem_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver_;
};

template <class Equations>
void addGsl(const Problem<Equations>& problem, std::vector<Contender>& contenders) {
  gsl_set_error_handler_off();  // it would end the program; failures are returned as well
  const auto add = [&](const std::string& name, const gsl_odeiv2_step_type* type) {
    contenders.push_back({"GSL " + name, false, Ladder::kTolerances, tolerances(),
                          [problem, type](double tolerance) {
                            return std::make_unique<GslRun<Equations>>(problem, type, tolerance);
                          }});
  };
  add("rk8pd", gsl_odeiv2_step_rk8pd);
  add("rkf45", gsl_odeiv2_step_rkf45);
}

}  // namespace whirl_twin::comparison
