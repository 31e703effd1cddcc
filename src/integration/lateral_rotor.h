// A linear rotor of two coordinates, its disc's x and y, as two oscillators that the shaft drives
// and couples. Per unit of mass
//
//   x'' + c_x x' + k_x x = -n(w) y + f_x,   y'' + c_y y' + k_y y = n(w) x + f_y,   n = n_0 + n_1 w
//   f = Re[(w^2 - i a) E e^(i theta)] + Re[B e^(i theta)] + g
//
// n: what rotates with the shaft or around it (internal damping, a fluid, cross-coupled stiffness),
// linear in the speed w. All linear forms of the Jeffcott rotor are of this kind (lecture notes,
// "whirling of shafts").
#pragma once

#include <array>
#include <complex>
#include <optional>

#include "integration/finite.h"
#include "integration/motion_state.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

// The motion of a rotor of two coordinates, each number as a compensated sum (motion_state.h).

struct LateralMotion {
  alignas(32) std::array<double, 4> y{};    ///< x, y [m], x', y' [m/s]
  alignas(32) std::array<double, 4> low{};  ///< their rounding errors in double
  CompensatedSum work;                      ///< [J], integral of dh/dt

  void advance(const std::array<double, 4>& increment, double energy) noexcept {
    for (std::size_t i = 0; i < y.size(); ++i) {
      CompensatedSum sum{y[i], low[i]};
      sum.add(increment[i]);
      y[i] = sum.high;
      low[i] = sum.low;
    }
    work.add(energy);
  }
};

inline bool isFinite(const LateralMotion& motion) noexcept {
  return isFinite(motion.y[0]) && isFinite(motion.y[1]) && isFinite(motion.y[2]) &&
         isFinite(motion.y[3]) && isFinite(motion.work.high);
}

/// Along x and along y.
struct LateralRotor {
  using Complex = std::complex<double>;

  double mass = 0.0;                      ///< [kg]
  std::array<double, 2> damping{};        ///< c [1/s]
  std::array<double, 2> stiffness{};      ///< k [1/s^2]
  double coupling = 0.0;                  ///< n_0 [1/s^2]
  double coupling_slope = 0.0;            ///< n_1 [1/s]
  std::array<Complex, 2> eccentricity{};  ///< E [m]
  std::array<Complex, 2> bow_force{};     ///< B [m/s^2]
  std::array<double, 2> load{};           ///< g [m/s^2]

  double couplingAt(double speed) const noexcept { return coupling + coupling_slope * speed; }
  /// [1/s]: no free motion without coupling turns or decays faster.
  double fastest() const noexcept;
};

/// The rotor as one of this kind, if it is; one that is so but for rounding is not.
std::optional<LateralRotor> lateralRotor(const LinearRotor& rotor);

}  // namespace whirl_twin
