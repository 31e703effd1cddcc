// Mode tracking of whirl modes over a parameter of the rotor: its speed, a cross-coupled stiffness.
// A mode is identified by its shape, not by its index: the correlation of two modes r = (phi, s
// phi) is the modal assurance criterion with the energy as its scalar product,
//
//   <r_i, r_j> = phi_i^H K phi_j + conj(s_i) s_j phi_i^H M phi_j,
//   c_ij = |<r_i, r_j>|^2 / (<r_i, r_i> <r_j, r_j>),
//
// in which the modes of an undamped rotor at one speed are orthogonal (Allemang, Sound and
// Vibration 37, 2003). Where no mode correlates well the step is halved, so that branches cross
// where they cross and veer where they veer.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "analysis/whirl_modes.h"
#include "mechanics/linearization.h"

namespace whirl_twin {

// A whirl mode of a long shaft found from the one that it was where the shaft, or its speed, was a
// little different: Newton's method for (s^2 M + s (C + G) + K + N) phi = 0, which near the
// diagonals costs in proportion to the length (nonlinear inverse iteration: A. Ruhe, SIAM J. Numer.
// Anal. 10, 1973).

class ModeContinuation {
 public:
  /// Keeps what it needs of the matrices.
  explicit ModeContinuation(const BandedLinearization& matrices);

  /// The mode that Newton's method comes to from `mode`, its shape not yet normalised. Nothing
  /// where it comes to none that vibrates, or to one whose shape is another: with the energy as
  /// scalar product, correlated by less than `least`. Nothing of a stiffness that is not positive
  /// definite.
  std::optional<WhirlMode> from(const WhirlMode& mode, double least) const;

 private:
  std::complex<double> product(const WhirlMode& a, const WhirlMode& b) const;

  BandedMatrix<double> mass_, by_rate_, by_place_, stiffness_, damping_;
  bool definite_ = false;
  bool cannot_grow_ = false;
};

class ModeTracker {
 public:
  /// The matrices at a value of the parameter.
  using System = std::function<Linearization(double parameter)>;
  /// None: the mode has become overdamped, or cannot be distinguished from others.
  using Modes = std::vector<std::optional<WhirlMode>>;

  ModeTracker(System system, std::vector<Station> stations);

  /// The `count` vibrating modes of lowest frequency, or as many as there are.
  Modes lowest(double parameter, std::size_t count) const;
  /// The modes at `from`, tracked to `to`, in the same order.
  Modes follow(const Modes& modes, double from, double to) const;

 private:
  Modes follow(const Modes& modes, double from, double to, int halvings) const;

  System system_;
  std::vector<Station> stations_;
};

}  // namespace whirl_twin
