// The acceleration of a linear rotor at rest, as a synchronous force:
//
//   a(theta, w, alpha) = Re[(F (w^2 - i alpha) + B) e^(i theta)] + g
//
// of an unbalance F, a bow B and a load g (mechanics/linear_rotor.h), identified by evaluating the
// equations at a few points: so a step needs no evaluation where only the shaft has moved.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "mechanics/evaluation_point.h"
#include "mechanics/sine_cosine.h"

namespace whirl_twin {

/// Half the sum of what is found at opposite angles; zero where it is the rounding of what turns:
/// sin(pi) is not 0.
inline double steadyPart(double ahead, double aside, double behind) {
  const double sum = ahead + behind;
  const double size = std::fabs(ahead) + std::fabs(aside) + std::fabs(behind);
  return std::fabs(sum) <= 1.0e-15 * size ? 0.0 : 0.5 * sum;
}

template <std::size_t n>
class SynchronousForce {
 public:
  using Array = std::array<double, n>;

  /// accelerationAtRest(moment): [rad/s^2] or [m/s^2]; frequency > 0 [rad/s]: of the order of the
  /// system's. False: the force is not of this form, as a check at a further point shows.
  template <class AccelerationAtRest>
  bool find(const AccelerationAtRest& accelerationAtRest, double frequency) {
    constexpr double kHalfTurn = 3.14159265358979323846;
    const double square = frequency * frequency;
    const auto standing = [&](double angle) { return accelerationAtRest({0.0, angle, 0.0, 0.0}); };
    const auto turning = [&](double angle) {
      return accelerationAtRest({0.0, angle, frequency, 0.0});
    };
    // Differences of opposite angles: a load, however large, leaves little of itself in them.
    const Array still[]{standing(0.0), standing(0.5 * kHalfTurn), standing(kHalfTurn),
                        standing(1.5 * kHalfTurn)};
    const Array fast[]{turning(0.0), turning(0.5 * kHalfTurn), turning(kHalfTurn),
                       turning(1.5 * kHalfTurn)};
    for (std::size_t i = 0; i < n; ++i) {
      steady_[i] = steadyPart(still[0][i], still[1][i], still[2][i]);
      cosine_[i] = 0.5 * (still[0][i] - still[2][i]);
      sine_[i] = 0.5 * (still[1][i] - still[3][i]);
      inertial_cosine_[i] = (0.5 * (fast[0][i] - fast[2][i]) - cosine_[i]) / square;
      inertial_sine_[i] = (0.5 * (fast[1][i] - fast[3][i]) - sine_[i]) / square;
    }
    const EvaluationPoint<double> other{0.9 / frequency, 0.7, 1.3 * frequency, 0.4 * square};
    const Array expected = at(other);
    const Array found = accelerationAtRest(other);
    bool same = true;
    for (std::size_t i = 0; i < n; ++i) {
      const double size =
          2.0 * square * (std::fabs(inertial_cosine_[i]) + std::fabs(inertial_sine_[i])) +
          std::fabs(cosine_[i]) + std::fabs(sine_[i]) + std::fabs(steady_[i]);
      same = same && std::fabs(expected[i] - found[i]) <= 1.0e-13 * size;
    }
    return same;
  }

  /// Real-time safe.
  Array at(const EvaluationPoint<double>& moment) const {
    const SineCosine turn = sineCosine(moment.angle);
    const double square = moment.speed * moment.speed;
    const double ahead = square * turn.cosine + moment.acceleration * turn.sine;
    const double aside = square * turn.sine - moment.acceleration * turn.cosine;
    Array acceleration;
    for (std::size_t i = 0; i < n; ++i) {
      acceleration[i] = steady_[i] + inertial_cosine_[i] * ahead + inertial_sine_[i] * aside +
                        cosine_[i] * turn.cosine + sine_[i] * turn.sine;
    }
    return acceleration;
  }

 private:
  Array steady_{}, cosine_{}, sine_{}, inertial_cosine_{}, inertial_sine_{};
};

}  // namespace whirl_twin
