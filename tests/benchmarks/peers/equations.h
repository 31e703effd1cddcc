// The equations of motion as one would write them by hand for a general solver: explicit, inlined,
// without allocation. Peers integrate these in double; references in long double.
//
// A state is the coordinates, then their rates, divided by kRate [1/s] where the motion is fast: so
// that all states are of one size, and a solver's one tolerance suits them all.
#pragma once

#include <cmath>
#include <cstddef>

namespace whirl_twin::comparison {

/// Jeffcott rotor: z'' + 2 zeta p z' + p^2 z = e w^2 e^(i w t), at constant speed w.
struct JeffcottEquations {
  static constexpr std::size_t kCoordinates = 2;
  static constexpr std::size_t kStates = 4;
  static constexpr double kRate = 100.0;           ///< p [rad/s]
  static constexpr double kDamping = 10.0;         ///< 2 zeta p [1/s], zeta = 0.05
  static constexpr double kEccentricity = 1.0e-4;  ///< [m]
  static constexpr double kSpeed = 80.0;           ///< [rad/s], 0.8 p

  template <class S>
  void operator()(const S* x, S* slope, S t) const {
    const S force = S(kEccentricity * kSpeed * kSpeed) / S(kRate);
    const S angle = S(kSpeed) * t;
    slope[0] = S(kRate) * x[2];
    slope[1] = S(kRate) * x[3];
    slope[2] = force * std::cos(angle) - S(kDamping) * x[2] - S(kRate) * x[0];
    slope[3] = force * std::sin(angle) - S(kDamping) * x[3] - S(kRate) * x[1];
  }
};

/// The same rotor run up from standstill at the constant acceleration a: the unbalance's force is
/// e (w^2 - i a) e^(i theta), w = a t, theta = a t^2 / 2.
struct RunUpEquations {
  static constexpr std::size_t kCoordinates = 2;
  static constexpr std::size_t kStates = 4;
  static constexpr double kAcceleration = 10.0;  ///< [rad/s^2]: critical after 10 s
  using Rotor = JeffcottEquations;

  template <class S>
  void operator()(const S* x, S* slope, S t) const {
    const S speed = S(kAcceleration) * t;
    const S angle = S(0.5) * speed * t;
    const S c = std::cos(angle);
    const S s = std::sin(angle);
    const S inward = S(Rotor::kEccentricity) / S(Rotor::kRate) * speed * speed;
    const S along = S(Rotor::kEccentricity) / S(Rotor::kRate) * S(kAcceleration);
    slope[0] = S(Rotor::kRate) * x[2];
    slope[1] = S(Rotor::kRate) * x[3];
    slope[2] = inward * c + along * s - S(Rotor::kDamping) * x[2] - S(Rotor::kRate) * x[0];
    slope[3] = inward * s - along * c - S(Rotor::kDamping) * x[3] - S(Rotor::kRate) * x[1];
  }
};

/// Double pendulum of unit masses and lengths, angles from the vertical. Two sines and cosines do:
/// those of the difference follow.
struct DoublePendulumEquations {
  static constexpr std::size_t kCoordinates = 2;
  static constexpr std::size_t kStates = 4;
  static constexpr double kGravity = 9.81;  ///< [m/s^2]

  template <class S>
  void operator()(const S* x, S* slope, S) const {
    const S s1 = std::sin(x[0]);
    const S c1 = std::cos(x[0]);
    const S s2 = std::sin(x[1]);
    const S c2 = std::cos(x[1]);
    const S c = c1 * c2 + s1 * s2;
    const S s = s1 * c2 - c1 * s2;
    const S upper = -s * x[3] * x[3] - S(2.0 * kGravity) * s1;
    const S lower = s * x[2] * x[2] - S(kGravity) * s2;
    const S per_determinant = S(1.0) / (S(2.0) - c * c);
    slope[0] = x[2];
    slope[1] = x[3];
    slope[2] = (upper - c * lower) * per_determinant;
    slope[3] = (S(2.0) * lower - c * upper) * per_determinant;
  }
};

/// Pendulum of unit length in a plane that turns at 1.5 sqrt(g / l): theta'' = (w^2 cos theta - g)
/// sin theta. Hanging is unstable; it swings about cos theta = g / (l w^2).
struct SpinningPendulumEquations {
  static constexpr std::size_t kCoordinates = 1;
  static constexpr std::size_t kStates = 2;
  static constexpr double kGravity = 9.81;  ///< [m/s^2]
  static constexpr double kSpeed = 4.7;     ///< [rad/s]

  template <class S>
  void operator()(const S* x, S* slope, S) const {
    slope[0] = x[1];
    slope[1] = (S(kSpeed) * S(kSpeed) * std::cos(x[0]) - S(kGravity)) * std::sin(x[0]);
  }
};

}  // namespace whirl_twin::comparison
