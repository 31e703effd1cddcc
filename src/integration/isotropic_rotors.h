// Many isotropic linear rotors on one shaft, stepped side by side in vectors.
//
// A disc whose support is the same all around, without rotating damping or cross-coupling, whirls
// as one complex number z = x + i y (lecture notes, "whirling of shafts"):
//
//   z'' + 2 n z' + p^2 z = E (w^2 - i a) e^(i theta) + B e^(i theta) + g
//
// E: eccentricity [m], B: what a bow adds [m/s^2], g: a constant load over mass [m/s^2]. The free
// motion goes by its propagator, exact for any step, and the forces by Gauss-Legendre quadrature of
// six nodes at the shaft's exact angle (variation of constants). They are the same for all rotors
// but for the factors E and B: a step evaluates them once, and every rotor takes their sum with
// weights of its own. Each rotor's plane is turned so that its mark is the first axis, which makes
// its eccentricity one number. Steps are parted so that in a part the shaft turns, and the free
// motion whirls or decays, by no more than 2 rad together at the highest speed prepared for; six
// nodes then leave 2e-12 of the force, and 2^12 times as much at twice the angle. Sums are not
// compensated. A corner of the drive's profile inside a step costs nothing: the nodes then stand
// for the force's projection on quintics.
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
  /// Prepares steps of h [s] for shaft speeds up to `highest_speed` [rad/s] of either sign, in so
  /// many times the parts that they need.
  IsotropicRotors(const std::vector<IsotropicRotor>& rotors, double h, double highest_speed,
                  int finer = 1);

  std::size_t count() const noexcept { return count_; }
  int parts() const noexcept { return parts_; }  ///< of a step
  /// [rad/s], at which parts turn twice as far as they are meant to.
  double limitSpeed() const noexcept { return limit_speed_; }

  // Real-time safe.

  /// Back to where they started.
  void reset() noexcept;
  void exchange(StateImage& image) noexcept { image(blocks_); }
  /// Advances all by h from the drive's begin().
  void step(const Drive& drive) noexcept;
  /// As step(), but the rotors may stay where they are until catchUp(): many steps of few rotors at
  /// a time, which the processor keeps at hand, are sooner done than a step of all after another.
  /// What is asked in between is of where they are. The same to the last bit.
  void stepLater(const Drive& drive) noexcept;
  void catchUp() noexcept;
  /// [m], z of a rotor. Not finite: it ran away.
  std::complex<double> position(std::size_t rotor) const noexcept;
  /// [m/s], z' likewise.
  std::complex<double> rate(std::size_t rotor) const noexcept;
  /// Puts a rotor where one of others, equal to it, is.
  void put(std::size_t rotor, const IsotropicRotors& others, std::size_t other) noexcept;
  /// [m], the largest |z| of a rotor at the start and after any step since.
  double peak(std::size_t rotor) const noexcept;

 private:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kNodes = 6;
  /// One number of each of eight rotors.
  typedef double Lanes __attribute__((vector_size(64), may_alias));

  /// Eight rotors, along the mark and across it; positions from where the load holds them, rates in
  /// parts of the frequency.
  struct alignas(64) Block {
    Lanes z_re, z_im, w_re, w_im;
    Lanes peak_square;             // [m^2]
    Lanes p_zz, p_zw, p_wz, p_ww;  // e^(A h) - I
    // Of the force at each node: of the eccentricity, or of unit force where there is a bow.
    Lanes to_z[kNodes], to_w[kNodes];
    Lanes eccentricity, bow_re, bow_im;  // where there is a bow
    Lanes rest_re, rest_im;
  };
  /// At the nodes.
  struct Force {
    std::array<double, kNodes> re{}, im{};
  };
  /// In a part, of unit eccentricity and of unit bow.
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
