#include "integration/lateral_gauss_step.h"

#include <cstdint>

#include "mechanics/force_inline.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define WHIRL_TWIN_FOUR_WIDE
#endif

namespace whirl_twin {

namespace {

/// So many nodes at a time.
template <int lanes>
struct StageVector {
  typedef double Doubles __attribute__((vector_size(8 * lanes), may_alias));
  typedef std::int64_t Bits __attribute__((vector_size(8 * lanes), may_alias));
};

/// Of angles up to 1e5 rad, to an ulp or so. The series are those of Sun's fdlibm.
template <int lanes, class Doubles = typename StageVector<lanes>::Doubles>
WHIRL_TWIN_INLINE void sineCosine(const Doubles& angle, Doubles& sine, Doubles& cosine) {
  using Bits = typename StageVector<lanes>::Bits;
  constexpr double kQuarters = 0.63661977236758134308;
  constexpr double kPart1 = 1.57079632673412561417e+00;  // pi/2 in pieces of 33, 33 and 53 bits
  constexpr double kPart2 = 6.07710050630396597660e-11;
  constexpr double kPart3 = 2.02226624879595063154e-21;
  constexpr double kToWhole = 6755399441055744.0;  // then the whole number is in the lowest bits
  const Doubles shifted = angle * kQuarters + kToWhole;
  const Doubles quarters = shifted - kToWhole;
  const Bits count = (Bits)shifted;
  const Doubles x = ((angle - quarters * kPart1) - quarters * kPart2) - quarters * kPart3;
  const Doubles z = x * x;
  const Doubles s =
      x + (x * z) *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const Doubles c =
      (1.0 - 0.5 * z) +
      (z * z) *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const Bits odd = -(count & 1);
  sine = (Doubles)((((Bits)c & odd) | ((Bits)s & ~odd)) ^ ((count & 2) << 62));
  cosine = (Doubles)((((Bits)s & odd) | ((Bits)c & ~odd)) ^ (((count + 1) & 2) << 62));
}

/// Keeps e^(i theta) at nodes, with a turn [rad] for each of them to its next place.
template <int lanes, class Doubles = typename StageVector<lanes>::Doubles>
WHIRL_TWIN_INLINE void begin(NodePhasors& p, int i, const Doubles& turn, const Doubles& sine,
                             const Doubles& cosine) {
  Doubles turn_sine, turn_cosine;
  sineCosine<lanes>(turn, turn_sine, turn_cosine);
  reinterpret_cast<Doubles*>(p.sine.data())[i] = sine;
  reinterpret_cast<Doubles*>(p.cosine.data())[i] = cosine;
  reinterpret_cast<Doubles*>(p.turn_sine.data())[i] = turn_sine;
  reinterpret_cast<Doubles*>(p.turn_cosine.data())[i] = turn_cosine;
}

/// Turns them on by a step.
template <int lanes, class Doubles = typename StageVector<lanes>::Doubles>
WHIRL_TWIN_INLINE void resume(NodePhasors& p, int i, Doubles& sine, Doubles& cosine) {
  Doubles& s = reinterpret_cast<Doubles*>(p.sine.data())[i];
  Doubles& c = reinterpret_cast<Doubles*>(p.cosine.data())[i];
  Doubles& turn_s = reinterpret_cast<Doubles*>(p.turn_sine.data())[i];
  Doubles& turn_c = reinterpret_cast<Doubles*>(p.turn_cosine.data())[i];
  const Doubles by_s = turn_s;
  const Doubles by_c = turn_c;
  sine = s * by_c + c * by_s;
  cosine = c * by_c - s * by_s;
  s = sine;
  c = cosine;
  turn_s = by_s * p.growth_cosine + by_c * p.growth_sine;
  turn_c = by_c * p.growth_cosine - by_s * p.growth_sine;
}

/// A matrix of two axes times a vector of two, column by column; the sums stay in registers.
template <int lanes, int vectors>
struct Sums {
  using Doubles = typename StageVector<lanes>::Doubles;

  const double* of_x;
  const double* of_y;
  Doubles x[vectors] = {};
  Doubles y[vectors] = {};

  WHIRL_TWIN_INLINE void add(int column, double for_x, double for_y) {
    const auto* const x_column = reinterpret_cast<const Doubles*>(of_x) + column * vectors;
    const auto* const y_column = reinterpret_cast<const Doubles*>(of_y) + column * vectors;
    for (int i = 0; i < vectors; ++i) {
      x[i] += x_column[i] * for_x;
      y[i] += y_column[i] * for_y;
    }
  }
  /// The forces at all nodes, then the start.
  template <int count>
  WHIRL_TWIN_INLINE void addAll(const double* x_force, const double* y_force,
                                const std::array<double, 4>& start) {
#pragma GCC unroll 4
    for (int k = 0; k < count; ++k) {
      add(k, x_force[k], y_force[k]);
    }
    add(count, start[0], start[1]);
    add(count + 1, start[2], start[3]);
  }
};

template <int lanes, int count>
WHIRL_TWIN_INLINE void take(const LateralGaussStep& step, LateralGaussResult& result) {
  using Doubles = typename StageVector<lanes>::Doubles;
  constexpr int kVectors = count / lanes;
  const LateralRotor& r = step.rotor;
  const ShaftMotion& shaft = step.shaft;
  const auto* const nodes = reinterpret_cast<const Doubles*>(step.nodes);
  const auto* const weights = reinterpret_cast<const Doubles*>(step.weights);
  Doubles outer_x[kVectors], outer_y[kVectors], coupling[kVectors];  // without the load
  alignas(32) double x_force[count];
  alignas(32) double y_force[count];
  auto* const x_forces = reinterpret_cast<Doubles*>(x_force);
  auto* const y_forces = reinterpret_cast<Doubles*>(y_force);
#pragma GCC unroll 8
  for (int i = 0; i < kVectors; ++i) {
    const Doubles t = step.length * nodes[i];
    const Doubles speed = shaft.speed + t * (shaft.acceleration + t * (0.5 * shaft.jerk));
    const Doubles acceleration = shaft.acceleration + t * shaft.jerk;
    const Doubles square = speed * speed;
    Doubles sine, cosine;
    if (step.use == PhasorUse::kGoOn) {
      resume<lanes>(step.phasors, i, sine, cosine);
    } else {
      const Doubles turned =
          t * (shaft.speed + t * (0.5 * shaft.acceleration + t * (shaft.jerk * (1.0 / 6.0))));
      sineCosine<lanes>(shaft.angle + turned, sine, cosine);
      if (step.use == PhasorUse::kBegin) {
        begin<lanes>(step.phasors, i, step.length * (speed + 0.5 * step.length * acceleration),
                     sine, cosine);
      }
    }
    const auto along = [&](std::size_t axis, Doubles & force) __attribute__((always_inline)) {
      const LateralRotor::Complex e = r.eccentricity[axis];
      const LateralRotor::Complex b = r.bow_force[axis];
      force = cosine * (square * e.real() + acceleration * e.imag() + b.real()) -
              sine * (square * e.imag() - acceleration * e.real() + b.imag());
    };
    along(0, outer_x[i]);
    along(1, outer_y[i]);
    x_forces[i] = outer_x[i] + r.load[0];
    y_forces[i] = outer_y[i] + r.load[1];
    coupling[i] = r.coupling + r.coupling_slope * speed;
  }
  for (int sweep = 0; sweep < step.sweeps; ++sweep) {
    Sums<lanes, kVectors> at{step.axes[0]->deflections.data(), step.axes[1]->deflections.data()};
    at.template addAll<count>(x_force, y_force, step.y);
    for (int i = 0; i < kVectors; ++i) {
      x_forces[i] = (outer_x[i] - coupling[i] * at.y[i]) + r.load[0];
      y_forces[i] = (outer_y[i] + coupling[i] * at.x[i]) + r.load[1];
    }
  }
  constexpr int kRows = (count + 4) / lanes;
  Sums<lanes, kRows> rates{step.axes[0]->rates.data(), step.axes[1]->rates.data()};
  rates.template addAll<count>(x_force, y_force, step.y);
  result.increment = {rates.x[kVectors][0], rates.y[kVectors][0], rates.x[kVectors][1],
                      rates.y[kVectors][1]};
  Doubles powers{};
  for (int i = 0; i < kVectors; ++i) {
    const Doubles x = rates.x[i];
    const Doubles y = rates.y[i];
    powers += weights[i] * (x * ((x_forces[i] - r.load[0]) - r.damping[0] * x) +
                            y * ((y_forces[i] - r.load[1]) - r.damping[1] * y));
  }
  double power = 0.0;
  for (int lane = 0; lane < lanes; ++lane) {
    power += powers[lane];
  }
  result.work = r.mass * step.length * power;
}

/// {x[0], y[0], x[1], y[1]} as vectors of a motion.
template <class Doubles>
WHIRL_TWIN_INLINE void interleave(const Doubles& x, const Doubles& y, Doubles* both) {
  if constexpr (sizeof(Doubles) == 4 * sizeof(double)) {
    both[0] = Doubles{x[0], y[0], x[1], y[1]};
  } else {
    both[0] = Doubles{x[0], y[0]};
    both[1] = Doubles{x[1], y[1]};
  }
}

template <int lanes, int count>
WHIRL_TWIN_INLINE StepStatus continueWith(const LateralGaussContinuation& step,
                                          LateralMotion& motion) {
  using Doubles = typename StageVector<lanes>::Doubles;
  constexpr int kVectors = count / lanes;
  constexpr int kRows = (count + 4) / lanes;
  const LateralRotor& r = step.rotor;
  const double a = step.acceleration;
  const auto* const nodes = reinterpret_cast<const Doubles*>(step.nodes);
  const auto* const weights = reinterpret_cast<const Doubles*>(step.weights);
  const auto* const columns = reinterpret_cast<const Doubles*>(step.axis.rates.data());
  // The start first: it is there before the forces are.
  Doubles x_sum[kRows], y_sum[kRows];
  for (int i = 0; i < kRows; ++i) {
    const Doubles by_place = columns[count * kRows + i];
    const Doubles by_rate = columns[(count + 1) * kRows + i];
    x_sum[i] = by_place * motion.y[0] + by_rate * motion.y[2];
    y_sum[i] = by_place * motion.y[1] + by_rate * motion.y[3];
  }
  alignas(32) double x_force[count];
  alignas(32) double y_force[count];
  Doubles x_turning[kVectors], y_turning[kVectors];  // without the load
  const LateralRotor::Complex* const e = r.eccentricity.data();
  const LateralRotor::Complex* const b = r.bow_force.data();
  const double x_cosine = a * e[0].imag() + b[0].real();
  const double x_sine = b[0].imag() - a * e[0].real();
  const double y_cosine = a * e[1].imag() + b[1].real();
  const double y_sine = b[1].imag() - a * e[1].real();
#pragma GCC unroll 8
  for (int i = 0; i < kVectors; ++i) {
    const Doubles speed = step.speed + (step.length * a) * nodes[i];
    const Doubles square = speed * speed;
    Doubles sine, cosine;
    resume<lanes>(step.phasors, i, sine, cosine);
    x_turning[i] =
        cosine * (square * e[0].real() + x_cosine) - sine * (square * e[0].imag() + x_sine);
    y_turning[i] =
        cosine * (square * e[1].real() + y_cosine) - sine * (square * e[1].imag() + y_sine);
    reinterpret_cast<Doubles*>(x_force)[i] = x_turning[i] + r.load[0];
    reinterpret_cast<Doubles*>(y_force)[i] = y_turning[i] + r.load[1];
  }
#pragma GCC unroll 4
  for (int k = 0; k < count; ++k) {
    for (int i = 0; i < kRows; ++i) {
      const Doubles column = columns[k * kRows + i];
      x_sum[i] += column * x_force[k];
      y_sum[i] += column * y_force[k];
    }
  }
  Doubles powers{};
  for (int i = 0; i < kVectors; ++i) {
    powers += weights[i] * (x_sum[i] * (x_turning[i] - r.damping[0] * x_sum[i]) +
                            y_sum[i] * (y_turning[i] - r.damping[1] * y_sum[i]));
  }
  constexpr int kParts = 4 / lanes;
  Doubles increment[kParts], next[kParts], corrected[kParts];
  interleave(x_sum[kVectors], y_sum[kVectors], increment);
  auto* const y = reinterpret_cast<Doubles*>(motion.y.data());
  auto* const low = reinterpret_cast<Doubles*>(motion.low.data());
  double power = 0.0;
  for (int lane = 0; lane < lanes; ++lane) {
    power += powers[lane];
  }
  Doubles none{};
  for (int i = 0; i < kParts; ++i) {
    corrected[i] = increment[i] + low[i];
    next[i] = y[i] + corrected[i];
    none += next[i] - next[i];
  }
  double nothing = none[0] + none[1];
  if constexpr (lanes == 4) {
    nothing += none[2] + none[3];
  }
  CompensatedSum work = motion.work;
  work.add(r.mass * step.length * power + nothing);  // no number where one of them is none
  if (__builtin_expect(!(work.high - work.high == 0.0), 0)) {
    return StepStatus::kNotFinite;
  }
  for (int i = 0; i < kParts; ++i) {
    low[i] = corrected[i] - (next[i] - y[i]);
    y[i] = next[i];
  }
  motion.work = work;
  return StepStatus::kOk;
}

template <int count>
StepStatus continueByTwos(const LateralGaussContinuation& step, LateralMotion& motion) noexcept {
  return continueWith<2, count>(step, motion);
}

template <int count>
void takeByTwos(const LateralGaussStep& step, LateralGaussResult& result) noexcept {
  take<2, count>(step, result);
}

#ifdef WHIRL_TWIN_FOUR_WIDE
template <int count>
[[gnu::target("avx2,fma")]] void takeByFours(const LateralGaussStep& step,
                                             LateralGaussResult& result) noexcept {
  take<4, count>(step, result);
}

template <int count>
[[gnu::target("avx2,fma")]] StepStatus continueByFours(const LateralGaussContinuation& step,
                                                       LateralMotion& motion) noexcept {
  return continueWith<4, count>(step, motion);
}

bool fourWide() noexcept {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}
#endif

}  // namespace

TakeLateralGaussStep lateralGaussStep(std::size_t nodes) noexcept {
#ifdef WHIRL_TWIN_FOUR_WIDE
  if (fourWide()) {
    return nodes == 4 ? takeByFours<4> : nodes == 8 ? takeByFours<8> : takeByFours<12>;
  }
#endif
  return nodes == 4 ? takeByTwos<4> : nodes == 8 ? takeByTwos<8> : takeByTwos<12>;
}

GoOnLateralGauss lateralGaussContinuation(std::size_t nodes) noexcept {
#ifdef WHIRL_TWIN_FOUR_WIDE
  if (fourWide()) {
    return nodes == 4 ? continueByFours<4> : nodes == 8 ? continueByFours<8> : continueByFours<12>;
  }
#endif
  return nodes == 4 ? continueByTwos<4> : nodes == 8 ? continueByTwos<8> : continueByTwos<12>;
}

}  // namespace whirl_twin
