// Steps of a rotor of two coordinates while the speed of its shaft changes.
//
// The free motion of each axis is advanced by its propagator, exact for any step; the forces are
// integrated by Gauss-Legendre quadrature with the exact shaft angle at the nodes (variation of
// constants),
//
//   y(h) = e^(A h) y(0) + sum of w_j h e^(A (h - x_j h)) f(x_j h).
//
// Four nodes, eight or twelve: as many as the step needs for a relative error of the forces of
// 1e-12 or less where the shaft turns, and the free motion whirls or decays, by (w + p) h together.
// A step too long for twelve nodes is divided.
//
// The rates at the nodes follow from the polynomial through the forces there (collocation), and
// with them the audited work by the same nodes and weights, to the same order. The coupling of the
// axes, n(w) (-y, x), is a force like the others, at deflections found iteratively: each sweep
// reduces the error by a factor of n h^2 / 2 / (number of the sweep) or less.
//
// lateral_gauss_step.h implements the step. In consecutive steps of h at constant acceleration it
// updates the phasors of the nodes recursively.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "control/drive.h"
#include "integration/gauss_nodes.h"
#include "integration/lateral_gauss_step.h"
#include "integration/lateral_rotor.h"

namespace whirl_twin {

// The free motion of x'' + c x' + k x = 0 in closed form, for any damping.

/// x(t) = x + by_place x + place_by_rate x', x'(t) = x' + rate_by_place x + by_rate x'.
struct FreeOscillation {
  double by_place, place_by_rate, rate_by_place, by_rate;
};

/// After a time t [s] >= 0 with c [1/s] >= 0 and k [1/s^2] > 0. Small increments are as exact as
/// large ones. Real-time safe.
inline FreeOscillation freeOscillation(double c, double k, double t) noexcept {
  const double n = 0.5 * c;
  const double square = n * n - k;
  if (square < 0.0) {
    const double frequency = std::sqrt(-square);
    const double half = std::sin(0.5 * frequency * t);
    const double half_cosine = std::cos(0.5 * frequency * t);
    const double less_one = -2.0 * half * half;  // cos - 1
    const double decayed = std::expm1(-n * t);
    const double impulse = (1.0 + decayed) * (2.0 * half * half_cosine) / frequency;
    const double both = less_one + decayed * (1.0 + less_one);
    return {both + n * impulse, impulse, -k * impulse, both - n * impulse};
  }
  const double apart = std::sqrt(square);
  const double slow = -k / (n + apart);
  const double decayed = std::expm1(slow * t);
  const double impulse =
      (1.0 + decayed) * (apart * t > 1.0e-200 ? -std::expm1(-2.0 * apart * t) / (2.0 * apart) : t);
  return {decayed - slow * impulse, impulse, -k * impulse, decayed - (n + apart) * impulse};
}

class LateralRunUp {
 public:
  /// Prepares steps of h [s].
  LateralRunUp(const LateralRotor& rotor, double h);

  // Real-time safe.

  /// Discards the history, after the motion has been set.
  void restart() noexcept { turns_left_ = 0; }

  /// Weights are the same whenever they are prepared.
  void exchange(StateImage& image) noexcept {
    image(phasors_, begun_, next_, piece_, of_set_, turns_left_);
    image.requireWithin(of_set_, std::size_t{0}, kSets - 1);
  }

  /// The speed [rad/s] if the last step of h ended at the drive's begin() and its phasors can be
  /// continued; does not compute the drive's angle.
  std::optional<double> speedAt(const Drive& drive) const noexcept {
    if (turns_left_ == 0 || !follows(drive)) {
      return std::nullopt;
    }
    return begun_.speed + begun_.acceleration * ((NodePhasors::kSteps + 1 - turns_left_) * h_);
  }

  /// Advances by h from the drive's begin() on, if the last step ended there and all is as it was
  /// then; false, with nothing done, where it is not, and once in a while. A motion that would not
  /// be finite stays as it was.
  bool goesOn(const Drive& drive, LateralMotion& motion, StepStatus& status) noexcept {
    const std::optional<double> speed = speedAt(drive);
    if (!speed || !plain_ || drive.nextCorner(0.0) < h_ ||
        !(std::fabs(*speed) + std::fabs(begun_.acceleration) * h_ <= fastest_turn_[of_set_])) {
      return false;
    }
    --turns_left_;
    goTo(drive);
    const Set& set = (*sets_)[of_set_];
    status = set.go_on({rotor_, set.nodes.data(), set.weights.data(), whole_[of_set_]->first, h_,
                        *speed, begun_.acceleration, phasors_},
                       motion);
    return true;
  }

  /// Advances by a length [s] from offset [s] after the drive's begin(), with no breakpoint of its
  /// motion inside. A length other than h is first prepared. kOutOfRange where the shaft turns too
  /// far for the maximum number of sub-steps.
  StepStatus advance(const Drive& drive, double offset, double length,
                     LateralMotion& motion) noexcept;

 private:
  static constexpr std::size_t kSets = 3;  // of nodes
  static constexpr double kNoAcceleration = std::numeric_limits<double>::quiet_NaN();

  struct Weights {
    double length = 0.0;  ///< [s], prepared for
    std::size_t set = 0;
    LateralGaussWeights first;                    ///< of x, and of y too
    std::unique_ptr<LateralGaussWeights> second;  ///< but where its own are others
  };
  struct Set {
    Set(std::size_t count, double farthest);
    GaussStretches stretches;
    double reach;  ///< (w + p) h up to which it leaves 1e-12 or less
    TakeLateralGaussStep take;
    GoOnLateralGauss go_on;
    alignas(32) std::array<double, kMaxGaussNodes> nodes{};
    alignas(32) std::array<double, kMaxGaussNodes> weights{};
  };
  static const std::array<Set, kSets>& sets();

  std::unique_ptr<Weights> room() const;
  void prepare(Weights& weights, std::size_t set, double length) const noexcept;
  void prepare(LateralGaussWeights& axis, std::size_t of, const Set& set,
               double length) const noexcept;
  const Weights& weightsFor(std::size_t set, double length) noexcept;
  double couplingWithin(double highest_speed, double length) const noexcept;
  bool follows(const Drive& drive) const noexcept {
    return drive.nanoseconds() == next_ && drive.piece() == piece_;
  }
  PhasorUse beginOrNot(const Drive& drive, const ShaftMotion& start, std::size_t set) noexcept;
  void goTo(const Drive& drive) noexcept {
    next_ = drive.nanoseconds() + nanoseconds_;
    piece_ = drive.piece();
  }

  LateralRotor rotor_;
  double h_;    ///< [s]
  bool alike_;  ///< of both axes the weights are the same
  bool plain_;  ///< and nothing is between them
  const std::array<Set, kSets>* sets_;
  double fastest_;                          ///< [1/s], of the free motion
  std::array<double, kSets> fastest_turn_;  ///< [rad/s], up to which each set does for h
  double flexibility_;                      ///< [s], largest deflection after a unit impulse
  std::array<std::unique_ptr<Weights>, kSets> whole_;
  /// Cached lengths: of half steps with each set of nodes, of sub-steps at a breakpoint.
  std::array<std::unique_ptr<Weights>, 5> other_;
  std::size_t oldest_ = 0;                             ///< of those
  NodePhasors phasors_;                                ///< of steps of h
  std::int64_t nanoseconds_;                           ///< h, if it is whole
  ShaftMotion begun_{0.0, 0.0, kNoAcceleration, 0.0};  ///< where they were made
  std::int64_t next_ = 0;                              ///< [ns], where the last step of h ended
  std::uint64_t piece_ = 0;                            ///< of the drive
  std::size_t of_set_ = 0;                             ///< nodes that the phasors are for
  int turns_left_ = 0;                                 ///< until they are recomputed
};

}  // namespace whirl_twin
