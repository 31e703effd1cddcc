// Many isotropic linear rotors on one shaft, stepped as a batch in SIMD vectors.
//
// A disc whose support is the same all around, without rotating damping or cross-coupling, whirls
// as one complex number z = x + i y (lecture notes, "whirling of shafts"):
//
//   z'' + 2 n z' + p^2 z = E (w^2 - i a) e^(i theta) + B e^(i theta) + g
//
// E: eccentricity [m], B: the contribution of a bow [m/s^2], g: a constant load over mass [m/s^2].
// The free motion is advanced by its propagator, exact for any step, and the forces by
// Gauss-Legendre quadrature of six nodes at the shaft's exact angle (variation of constants). They
// are the same for all rotors but for the factors E and B: a step evaluates them once, and every
// rotor forms their sum with its own weights. Each rotor's plane is rotated so that its phase
// reference is the first axis, which makes its eccentricity one number. Steps are divided so that
// in a sub-step the shaft turns, and the free motion whirls or decays, by no more than 2 rad
// together at the highest speed prepared for; six nodes then leave 2e-12 of the force, and 2^12
// times as much at twice the angle. Sums are not compensated. A breakpoint of the drive's profile
// inside a step costs nothing: the nodes then represent the force's projection on quintics.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "control/drive.h"
#include "integration/shaft_nodes.h"
#include "realtime/state_image.h"

namespace whirl_twin {

struct IsotropicRotor {
  double damping = 0.0;                        ///< [1/s], 2 n
  double stiffness = 0.0;                      ///< [1/s^2], p^2
  std::complex<double> eccentricity;           ///< [m], E: along the shaft's mark and across it
  std::complex<double> bow_force;              ///< [m/s^2], B
  std::complex<double> load;                   ///< [m/s^2], g
  std::complex<double> start{}, start_rate{};  ///< [m], [m/s]
};

class IsotropicRotors {
 public:
  /// Prepares steps of h [s] for shaft speeds up to `highest_speed` [rad/s] of either sign, with a
  /// multiple of the required number of sub-steps.
  IsotropicRotors(const std::vector<IsotropicRotor>& rotors, double h, double highest_speed,
                  int finer = 1);

  std::size_t count() const noexcept { return count_; }
  int parts() const noexcept { return parts_; }  ///< of a step
  /// [rad/s], at which sub-steps turn twice the intended angle.
  double limitSpeed() const noexcept { return limit_speed_; }

  // Real-time safe.

  /// Resets all rotors to their initial states.
  void reset() noexcept;
  void exchange(StateImage& image) noexcept { image(blocks_); }
  /// Advances all by h from the drive's begin().
  void step(const Drive& drive) noexcept;
  /// As step(), but the steps may be deferred until catchUp(): many steps of few rotors at a time,
  /// whose data stay in the cache, are faster than step after step of all. Getters in between
  /// return the state before. Results are bit-identical.
  void stepLater(const Drive& drive) noexcept;
  void catchUp() noexcept;
  /// [m], z of a rotor. Not finite: it diverged.
  std::complex<double> position(std::size_t rotor) const noexcept;
  /// [m/s], z' likewise.
  std::complex<double> rate(std::size_t rotor) const noexcept;
  /// Copies the state of an equal rotor.
  void put(std::size_t rotor, const IsotropicRotors& others, std::size_t other) noexcept;
  /// [m], the largest |z| of a rotor at the start and after any step since.
  double peak(std::size_t rotor) const noexcept;

 private:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kNodes = 6;
  /// One number of each of eight rotors.
  typedef double SimdVector __attribute__((vector_size(64), may_alias));

  /// Eight rotors, along the phase reference and normal to it; positions from the static
  /// equilibrium, rates relative to the frequency.
  struct alignas(64) Block {
    SimdVector z_re, z_im, w_re, w_im;
    SimdVector peak_square;             // [m^2]
    SimdVector p_zz, p_zw, p_wz, p_ww;  // e^(A h) - I
    // Of the force at each node: of the eccentricity, or of unit force where there is a bow.
    SimdVector to_z[kNodes], to_w[kNodes];
    SimdVector eccentricity, bow_re, bow_im;  // where there is a bow
    SimdVector rest_re, rest_im;
  };
  /// At the nodes.
  struct Force {
    std::array<double, kNodes> re{}, im{};
  };
  /// In a sub-step, of unit eccentricity and of unit bow.
  struct Forces {
    Force unbalance, bow;
    bool last = true;  // of its step
  };

  static void advance(Block* blocks, std::size_t count, const Forces* forces, std::size_t parts,
                      bool bowed) noexcept;
  template <int lanes, bool bowed>
  static void advanceSome(Block& block, std::size_t lane, const Forces* forces,
                          std::size_t parts) noexcept;
  void prepare(Block& block, std::size_t lane, const IsotropicRotor& rotor) const;
  Forces sampled(const Drive& drive, double offset) const noexcept;
  Forces projected(const Drive& drive, double offset) const noexcept;

  std::size_t count_;
  int parts_ = 1;
  double part_;  // [s]
  double limit_speed_;
  bool bowed_;
  std::vector<Forces> later_;  // of parts that are still to be taken
  std::size_t waiting_ = 0;    // of them
  std::vector<IsotropicRotor> rotors_;
  std::vector<double> frequencies_;          // [rad/s], the rates' units
  std::vector<std::complex<double>> marks_;  // [-], directions of the eccentricities
  std::vector<Block> blocks_;
};

}  // namespace whirl_twin
