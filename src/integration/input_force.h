// The inputs of a system as a generalized force during a step, piece by piece (control/inputs.h):
// Q = sum of u_i B_i.
//
// Of a piece the force is parted in two. What is held, the inputs that are constant in it, does the
// work Q . dq, whatever the method; what varies works by the method's own nodes.
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
  /// The first corner later than an offset [s] after the start of the twin's step, or the largest
  /// number there is.
  double nextCorner(double offset) const noexcept;
  /// Takes up the piece around an offset [s].
  void enter(double offset) noexcept;
  /// In that piece, at an offset [s]: Q, and what of it is not held. Beyond its ends it goes on.
  void at(double offset, double* all, double* varying) const noexcept;
  /// What of it is held.
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
