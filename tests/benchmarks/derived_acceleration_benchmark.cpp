// Cost of the double pendulum's accelerations derived from its energies compared with hand-written
// equations of motion: both in one run, interleaved.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "mechanics/lagrangian.h"
#include "mechanics/pendulums/double_pendulum.h"

namespace whirl_twin {
namespace {

using Array = std::array<double, 2>;

DoublePendulum pendulum() {
  DoublePendulum p;
  p.mass1 = 1.0;
  p.mass2 = 0.7;
  p.length1 = p.center1 = 1.0;
  p.length2 = p.center2 = 0.6;
  p.coulomb_rate = 0.01;
  p.gravity = 9.81;
  return p;
}

/// Point masses, with damping: the textbook equations, solved by Cramer's rule.
Array byHand(const DoublePendulum& p, const Array& q, const Array& v) {
  const double c = std::cos(q[0] - q[1]);
  const double s = std::sin(q[0] - q[1]);
  const double m11 = (p.mass1 + p.mass2) * p.length1 * p.length1;
  const double m12 = p.mass2 * p.length1 * p.length2 * c;
  const double m22 = p.mass2 * p.length2 * p.length2;
  const double joint = p.damping2 * (v[1] - v[0]);
  const double f1 = -p.mass2 * p.length1 * p.length2 * s * v[1] * v[1] -
                    (p.mass1 + p.mass2) * p.gravity * p.length1 * std::sin(q[0]) -
                    p.damping1 * v[0] + joint;
  const double f2 = p.mass2 * p.length1 * p.length2 * s * v[0] * v[0] -
                    p.mass2 * p.gravity * p.length2 * std::sin(q[1]) - joint;
  const double inverse = 1.0 / (m11 * m22 - m12 * m12);
  return {(m22 * f1 - m12 * f2) * inverse, (m11 * f2 - m12 * f1) * inverse};
}

Array derived(const DoublePendulum& p, const Array& q, const Array& v) {
  return derivative(p, q, v, EvaluationPoint<double>{}).acceleration;
}

/// The same with the energy audit that every step of the twin carries.
struct Audited {
  double& work;
  Array operator()(const DoublePendulum& p, const Array& q, const Array& v) const {
    const Derivative<2> d = derivative(p, q, v, EvaluationPoint<double>{});
    work += d.power;
    return d.acceleration;
  }
};

/// A chain of evaluations, each of which needs the one before, as in a step.
template <class Acceleration>
double chain(const Acceleration& acceleration, const DoublePendulum& p, int count) {
  Array q{0.3, -0.2};
  Array v{0.1, 0.4};
  for (int i = 0; i < count; ++i) {
    const Array a = acceleration(p, q, v);
    for (std::size_t k = 0; k < 2; ++k) {
      v[k] += 1e-4 * a[k];
      q[k] += 1e-4 * v[k];
    }
  }
  return q[0] + q[1];
}

constexpr int kChain = 2000;

/// [ns] for one evaluation.
template <class Acceleration>
double cost(const Acceleration& acceleration, const DoublePendulum& p) {
  const auto start = std::chrono::steady_clock::now();
  benchmark::DoNotOptimize(chain(acceleration, p, kChain));
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start)
             .count() /
         kChain;
}

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

void doublePendulum(benchmark::State& state) {
  const DoublePendulum p = pendulum();
  std::vector<double> hand;
  std::vector<double> lagrangian;
  std::vector<double> with_audit;
  for (auto _ : state) {
    hand.push_back(cost(byHand, p));
    lagrangian.push_back(cost(derived, p));
    double work = 0.0;
    with_audit.push_back(cost(Audited{work}, p));
    benchmark::DoNotOptimize(work);
  }
  state.counters["by_hand_ns"] = median(hand);
  state.counters["derived_ns"] = median(lagrangian);
  state.counters["derived_with_audit_ns"] = median(with_audit);
  state.counters["derived/by_hand"] = median(lagrangian) / median(hand);
}
BENCHMARK(doublePendulum);

}  // namespace
}  // namespace whirl_twin

BENCHMARK_MAIN();
