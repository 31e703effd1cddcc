// The free motion of x'' + c x' + k x = 0 in closed form, whatever its damping.
#pragma once

#include <cmath>

namespace whirl_twin {

/// x(t) = x + by_place x + place_by_rate x', x'(t) = x' + rate_by_place x + by_rate x'.
struct FreeOscillation {
  double by_place, place_by_rate, rate_by_place, by_rate;
};

/// After a time t [s] >= 0 with c [1/s] >= 0 and k [1/s^2] > 0. Small increments are as exact as
/// large ones. Real-time safe.
inline FreeOscillation freeOscillation(double c, double k, double t) noexcept {
  const double n = 0.5 * c;
  const double square = n * n - k;
  if (square < 0.0) {
    const double frequency = std::sqrt(-square);
    const double half = std::sin(0.5 * frequency * t);
    const double half_cosine = std::cos(0.5 * frequency * t);
    const double less_one = -2.0 * half * half;  // cos - 1
    const double decayed = std::expm1(-n * t);
    const double impulse = (1.0 + decayed) * (2.0 * half * half_cosine) / frequency;
    const double both = less_one + decayed * (1.0 + less_one);
    return {both + n * impulse, impulse, -k * impulse, both - n * impulse};
  }
  const double apart = std::sqrt(square);
  const double slow = -k / (n + apart);
  const double decayed = std::expm1(slow * t);
  const double impulse =
      (1.0 + decayed) * (apart * t > 1.0e-200 ? -std::expm1(-2.0 * apart * t) / (2.0 * apart) : t);
  return {decayed - slow * impulse, impulse, -k * impulse, decayed - (n + apart) * impulse};
}

}  // namespace whirl_twin
