// Reference solutions for the solvers, in long double.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scene.h"

namespace whirl_twin::comparison {

/// A motion by a method of order 8 in long double at two step sizes. Their difference, which is
/// some 250 times the error of the finer, is the bound of it.
template <class Equations>
Reference fineReference(const Problem<Equations>& problem, std::size_t steps) {
  using State = std::array<long double, Equations::kStates>;
  const Output& output = problem.output;
  const auto motion = [&](std::size_t steps_now) {
    boost::numeric::odeint::runge_kutta_fehlberg78<State, long double> stepper;
    const auto slope = [&](const State& x, State& dxdt, long double t) {
      problem.equations(x.data(), dxdt.data(), t);
    };
    const long double step =
        static_cast<long double>(output.interval) / static_cast<long double>(steps_now);
    State x;
    std::copy(problem.start.begin(), problem.start.end(), x.begin());
    std::vector<double> all;
    for (std::size_t sample = 0; sample < output.samples; ++sample) {
      for (std::size_t i = 0; i < steps_now; ++i) {
        const std::size_t taken = sample * steps_now + i;
        stepper.do_step(slope, x, static_cast<long double>(taken) * step, step);
      }
      for (std::size_t i = 0; i < output.coordinates; ++i) {
        all.push_back(static_cast<double>(x[i]));
      }
    }
    return all;
  };
  const std::vector<double> coarse = motion(steps);
  Reference reference{"order 8 in long double", motion(2 * steps), 0.0};
  double largest = 0.0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    reference.error = std::max(reference.error, std::abs(coarse[i] - reference.coordinates[i]));
    largest = std::max(largest, std::abs(reference.coordinates[i]));
  }
  reference.error /= largest;
  return reference;
}

/// Largest coordinate among those of the given indices.
double amplitude(const Reference& reference, const Output& output,
                 const std::vector<std::size_t>& positions);

}  // namespace whirl_twin::comparison
