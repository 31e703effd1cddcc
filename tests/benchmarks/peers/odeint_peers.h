// Boost.odeint: fixed steps, and steps under error control with and without dense output.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scene.h"

namespace whirl_twin::comparison {

template <class Equations, class Stepper>
class OdeintFixed final : public Run {
 public:
  using State = std::array<double, Equations::kStates>;

  OdeintFixed(const Problem<Equations>& problem, std::size_t steps)
      : problem_(problem), steps_(steps) {}

  bool integrate(double* out) override {
    const auto slope = [this](const State& x, State& dxdt, double t) {
      problem_.equations(x.data(), dxdt.data(), t);
    };
    Stepper stepper;
    State x = problem_.start;
    const double step = problem_.output.interval / static_cast<double>(steps_);
    std::size_t taken = 0;
    for (std::size_t sample = 0; sample < problem_.output.samples; ++sample) {
      for (std::size_t i = 0; i < steps_; ++i) {
        stepper.do_step(slope, x, static_cast<double>(taken++) * step, step);
      }
      out = std::copy_n(x.data(), problem_.output.coordinates, out);
    }
    return true;
  }

 private:
  Problem<Equations> problem_;
  std::size_t steps_;
};

template <class Equations, class Stepper>
class OdeintAdaptive final : public Run {
 public:
  using State = std::array<double, Equations::kStates>;

  OdeintAdaptive(const Problem<Equations>& problem, Stepper stepper)
      : problem_(problem), stepper_(std::move(stepper)) {
    for (std::size_t i = 0; i <= problem.output.samples; ++i) {
      times_.push_back(problem.output.interval * static_cast<double>(i));
    }
  }

  bool integrate(double* out) override {
    const auto slope = [this](const State& x, State& dxdt, double t) {
      problem_.equations(x.data(), dxdt.data(), t);
    };
    const auto observe = [&](const State& x, double t) {
      if (t > 0.0) {
        out = std::copy_n(x.data(), problem_.output.coordinates, out);
      }
    };
    Stepper stepper = stepper_;
    State x = problem_.start;
    try {
      boost::numeric::odeint::integrate_times(stepper, slope, x, times_.begin(), times_.end(),
                                              0.01 * problem_.output.interval, observe);
    } catch (const boost::numeric::odeint::odeint_error&) {
      return false;
    }
    return true;
  }

 private:
  Problem<Equations> problem_;
  Stepper stepper_;
  std::vector<double> times_;
};

template <class Equations>
void addOdeint(const Problem<Equations>& problem, std::vector<Contender>& contenders) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, Equations::kStates>;
  using RungeKutta4 = odeint::runge_kutta4<State>;
  using Fehlberg78 = odeint::runge_kutta_fehlberg78<State>;
  using DormandPrince5 = odeint::runge_kutta_dopri5<State>;

  const auto fixed = [&](const std::string& name, auto stepper) {
    using Fixed = OdeintFixed<Equations, decltype(stepper)>;
    contenders.push_back(
        {"odeint " + name, false, Ladder::kSteps, stepCounts(), [problem](double steps) {
           return std::make_unique<Fixed>(problem, static_cast<std::size_t>(steps));
         }});
  };
  const auto adaptive = [&](const std::string& name, auto make) {
    using Adaptive = OdeintAdaptive<Equations, decltype(make(0.0, 0.0))>;
    contenders.push_back({"odeint " + name, false, Ladder::kTolerances, tolerances(),
                          [problem, make](double tolerance) {
                            return std::make_unique<Adaptive>(
                                problem, make(tolerance * problem.amplitude, tolerance));
                          }});
  };
  fixed("rk4, fixed step", RungeKutta4());
  fixed("rkf78, fixed step", Fehlberg78());
  adaptive("rkf78", [](double absolute, double relative) {
    return odeint::make_controlled<Fehlberg78>(absolute, relative);
  });
  adaptive("dopri5", [](double absolute, double relative) {
    return odeint::make_controlled<DormandPrince5>(absolute, relative);
  });
  adaptive("dopri5, dense", [](double absolute, double relative) {
    return odeint::make_dense_output<DormandPrince5>(absolute, relative);
  });
}

}  // namespace whirl_twin::comparison
