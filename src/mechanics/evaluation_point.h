// Evaluation point of the energies: the time and the motion of the shaft, if there is one.
#pragma once

namespace whirl_twin {

/// S is double, or a dual number whose rate follows the shaft.
template <class S>
struct EvaluationPoint {
  S time{};          ///< [s]
  S angle{};         ///< [rad], of the shaft; whole turns may be left out
  S speed{};         ///< [rad/s]
  S acceleration{};  ///< [rad/s^2]
};

}  // namespace whirl_twin
