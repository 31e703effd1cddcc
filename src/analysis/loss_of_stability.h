// Where a steady motion loses its stability as one number of its system changes: the motion is
// followed in strides along the change, judged at each, and where the verdict turns the place is
// closed in on. An isle of instability that lies between two strides is not seen.
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

struct LossOfStability {
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
/// the system operates about `motion` and does not grow. Conserved momenta stay what they are.
/// Nothing if it is stable all along. Throws RunFailure as eigenvalues().
std::optional<LossOfStability> lossAlong(const SystemOfNumber& system, double value,
                                         const SteadyMotion& motion,
                                         const std::vector<double>& strides);

/// Do the matrices of the small motion stay what they are, bit by bit, at all these values? Then
/// the number is none of stability's (an eccentricity, the angle of a mark).
bool isWithoutEffect(const SystemOfNumber& system, double value, const SteadyMotion& motion,
                     const std::vector<double>& values);

}  // namespace whirl_twin
