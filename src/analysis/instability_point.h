// Instability point of a steady motion over one parameter: the motion is continued in steps of the
// parameter, its stability is evaluated at each, and a change of the verdict is located by
// bisection. An interval of instability between two steps is not detected.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/steady_motion.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// The two ways (Orlando: the last coefficient of the polynomial vanishes, or the Hurwitz
/// determinant before the last does) and the end of the motion itself.
enum class LossKind {
  kDivergence,  ///< a real root passes zero
  kFlutter,     ///< a pair passes the imaginary axis: of a rotor, whirl
  kNoMotion     ///< the steady motion ends, as it meets an unstable one: none is found beyond
};

struct InstabilityPoint {
  double value = 0.0;  ///< of the number, where the verdict turns, to 1e-9 of it
  LossKind kind = LossKind::kDivergence;
  double frequency = 0.0;  ///< [rad/s], of the pair; 0 of the others
};

/// A system as a number makes it.
struct SystemAtNumber {
  std::shared_ptr<const Dynamics> dynamics;
  double speed = 0.0;  ///< [rad/s], of its shaft
};
/// Nothing where the number cannot have that value: there a search ends.
using SystemOfNumber = std::function<std::optional<SystemAtNumber>(double)>;

/// The first loss along `strides`, the values of the number in order going away from `value`, where
/// the system operates about `motion` and does not grow. Conserved momenta are constant. Nothing if
/// it is stable all along. Throws RunFailure as eigenvalues().
std::optional<InstabilityPoint> lossAlong(const SystemOfNumber& system, double value,
                                          const SteadyMotion& motion,
                                          const std::vector<double>& strides);

/// Whether the matrices of the linearized motion are bit-identical at all these values. Then
/// stability does not depend on the parameter (an eccentricity, the angle of a phase reference).
bool isWithoutEffect(const SystemOfNumber& system, double value, const SteadyMotion& motion,
                     const std::vector<double>& values);

}  // namespace whirl_twin
