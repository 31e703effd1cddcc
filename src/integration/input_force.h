// Generalized force of the inputs of a system during a step, piecewise (control/inputs.h): Q = sum
// of u_i B_i.
//
// In a piece the force has two parts. The zero-order-hold part, of inputs that are constant in it,
// does the work Q . dq for any method; the work of the varying part is computed at the method's
// nodes.
#pragma once

#include <cstddef>
#include <vector>

#include "control/inputs.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

class InputForce {
 public:
  InputForce();
  InputForce(const InputForce& other);
  InputForce& operator=(const InputForce& other);
  ~InputForce();
  /// One of `directions`, of the model, for each of `inputs`, which may be none and outlive this.
  InputForce(const Inputs* inputs, const std::vector<InputInfo>& directions);

  // Real-time safe. Forces are of as many numbers as the model has coordinates.

  bool acts() const noexcept { return inputs_ != nullptr; }
  /// The first breakpoint later than an offset [s] after the start of the twin's step, or the
  /// largest number there is.
  double nextCorner(double offset) const noexcept;
  /// Takes up the piece around an offset [s].
  void enter(double offset) noexcept;
  /// In that piece, at an offset [s]: Q, and its part that is not zero-order hold. Extrapolated
  /// beyond the ends of the piece.
  void at(double offset, double* all, double* varying) const noexcept;
  /// Its zero-order hold part.
  const double* held() const noexcept { return held_.data(); }
  /// At the start of the twin's step.
  void now(double* all) const noexcept;

 private:
  struct Acting {
    std::size_t input;
    bool harmonic;
    double amplitude, frequency;  // [rad/s]
    std::vector<double> direction;
    // Of the piece.
    SignalPiece piece;
    double phase;  // [rad]
  };

  const Inputs* inputs_ = nullptr;
  std::vector<Acting> acting_;
  std::vector<double> held_;
  bool varies_ = false;
};

}  // namespace whirl_twin
