// Stoermer-Cowell steps in sums (Stoermer 1907, Cowell & Crommelin 1910; Hairer, Norsett & Wanner,
// Solving Ordinary Differential Equations I, III.10), on (q, v, work): a multistep method on past
// accelerations, so that a step costs one evaluation, or two. With d the last increment of q and
// the weights of stoermer_weights.h
//
//   d' = d + h^2 sum b_k a(n - k),  q' = q + d',  v' = d'/h + h sum g_k a(n - k),  a' = a(q', v')
//
// explicitly: `stoermer_6` and `stoermer_12`, one evaluation a step. `stoermer` corrects d' and v'
// by the polynomial that includes a', and evaluates a' again there (PECE, 10 terms). q and d are
// compensated sums; the work is that of the polynomial through the powers.
//
// Order 6, 11 and 12; the starting error is of order 9. Rates are extrapolated, so damping is the
// limit. Largest h omega that grows by less than 1e-3 a radian, by damping ratio:
//
//                  0      0.01   0.05   0.2    0.5
//   stoermer_6     0.56   0.71   0.40   0.13   0.05
//   stoermer       0.99   1.02   0.77   0.36   0.16
//   stoermer_12    0.12   0.04   0.01   0.002  0.0005
//
// Twelve explicit terms are for almost undamped motions.
//
// Not symplectic. The history is valid for one smooth motion: it is discarded at a breakpoint of
// the drive or of an input, and on a change of a zero-order-hold input, of a parameter or of the
// state. The first steps (terms - 1 of them) are then taken by dormand_prince_8, while
// accelerations are stored.
//
// `stoermer_ahead` is `stoermer` in macro-steps of many of the twin's, with dense output in between
// (macro_step.h). Its history is built at once: by steps of dormand_prince_8 backwards in time,
// with the present equations.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "integration/dormand_prince_8.h"
#include "integration/erased_ode.h"
#include "integration/motion_state.h"
#include "integration/simd_vector.h"
#include "integration/stoermer_weights.h"
#include "realtime/state_image.h"

namespace whirl_twin {

template <std::size_t n>
class Stoermer {
 public:
  static constexpr const auto& kSchemes = kStoermerSchemes;
  /// Multistep method: the conditions of the previous steps must not have changed.
  static constexpr bool kHasHistory = true;
  using Array = std::array<double, n>;

  explicit Stoermer(const StoermerScheme& scheme) : scheme_(&scheme) {}

  const StoermerScheme& scheme() const { return *scheme_; }
  /// Of one that steps ahead: the same by the twin's own steps.
  Stoermer byItself() const { return Stoermer(kSchemes[1]); }

  /// Discards the history.
  void restart() {
    ready_for_ = 0.0;
    gathered_ = 0;
  }

  void exchange(StateImage& image) noexcept {
    const StoermerScheme* const own = scheme_;
    image.whole(*this);
    scheme_ = own;
    image.requireWithin(newest_, std::size_t{0}, kLength - 1);
    image.requireWithin(gathered_, std::size_t{0}, std::size_t{scheme_->terms});
  }

  /// Whether the last step was a multistep one, not one of dormand_prince_8.
  bool hasPast() const { return ready_for_ != 0.0; }

  /// First-order error of d in the last step: by the polynomial with one more node (Milne's
  /// device). (v has a further error, which does not accumulate.)
  Array lastError() const {
    SimdVector<n> error{};
    for (std::size_t k = 0; k <= scheme_->terms; ++k) {
      error.add(ready_for_ * ready_for_ * scheme_->error[k], past_[newest_ + k]);
    }
    return error.array();
  }

  /// Whether the accelerations of the last step, which ended at `end`, were predicted by the
  /// history to a relative 1e-4. If not, steps of that length do not resolve the motion.
  bool resolves(const MotionState<n>& end) const noexcept {
    constexpr double kPart = 1.0e-4;
    // What was long ago may be far larger: a past that was made backwards.
    constexpr std::size_t kLately = 3;
    constexpr double kRounding = 1.0e-13;
    std::array<double, n> largest{};
    double rounding = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < kLately; ++k) {
        const double a = std::fabs(past_[newest_ + k].array()[i]);
        largest[i] = a > largest[i] ? a : largest[i];
      }
      rounding = std::fmax(rounding, kRounding * std::fabs(end.q[i]));
    }
    const Array error = lastError();
    for (std::size_t i = 0; i < n; ++i) {
      const double estimated = kPart * ready_for_ * ready_for_ * largest[i];
      if (!(std::fabs(error[i]) <= std::fmax(estimated, rounding))) {
        return false;
      }
    }
    return true;
  }

  /// q, v and, if requested, the work at a point inside the last step, which ended at `end`;
  /// requires hasPast(). Real-time safe.
  [[gnu::noinline]] void readOff(const DenseOutputWeights& reading, const MotionState<n>& end,
                                 bool with_work, double* out) const noexcept {
    const double h = ready_for_;
    SimdVector<n> off{};
    SimdVector<n> v{};
    double work = 0.0;
    for (std::size_t k = 0; k < scheme_->terms; ++k) {
      off.add(h * h * reading.position[k], past_[newest_ + k]);
      v.add(h * reading.rate[k], past_[newest_ + k]);
      work += h * reading.work[k] * powers_[newest_ + k].array()[0];
    }
    off.add(reading.share - 1.0, increment_);
    v.add(per_step_, increment_);
    SimdVector<n> q(end.q);
    SimdVector<n> q_low(end.q_low);
    addTo(q, q_low, off);
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = q.array()[i];
      out[n + i] = v.array()[i];
    }
    if (with_work) {
      CompensatedSum passed = end.work;
      passed.add(-work);
      out[2 * n] = passed.high;
    }
  }

  /// Drops the past if the shaft's motion [rad/s^3, rad/s^2] is another polynomial in time than
  /// that of the last call.
  void follow(double jerk, double acceleration) {
    if (jerk != jerk_ || (jerk == 0.0 && acceleration != acceleration_)) {
      restart();
    }
    jerk_ = jerk;
    acceleration_ = acceleration;
  }
  /// Discards the history if the zero-order hold part of the force differs from the last call.
  void hold(const double* force) {
    for (std::size_t i = 0; i < n; ++i) {
      if (force[i] != held_[i]) {
        restart();
      }
      held_[i] = force[i];
    }
  }

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    if (__builtin_expect(h != ready_for_, 0)) {
      const StepStatus status = start(equation, offset, h, state);
      if (h != ready_for_) {
        return status;
      }
    }
    const SimdVector<n> q0(state.q);
    const SimdVector<n> last = past_[newest_];
    SimdVector<n> increment = known_increment_;
    increment.add(position_[0], last);
    // What waits for the last acceleration comes by one multiplication: the rest was known before.
    SimdVector<n> q = q0 + known_advance_;
    SimdVector<n> v = known_rate_;
    q.add(position_[0], last);
    v.add(rate_[0], last);
    SimdVector<n> corrected_increment{};
    SimdVector<n> corrected_rate{};
    if (scheme_->corrected) {
      const SimdVector<n>* const past = &past_[newest_];
      corrected_increment = sumOfPast<kCorrectedTerms - 1>(corrected_position_, past);
      corrected_rate = sumOfPast<kCorrectedTerms - 1>(corrected_rate_, past);
      corrected_rate.add(per_step_, increment_);
    }
    double work = scheme_->corrected            ? prepare<kCorrectedTerms>()
                  : scheme_->terms == kFewTerms ? prepare<kFewTerms>()
                                                : prepare<kMaxTerms>();
    bool last_evaluation = !scheme_->corrected;
    if (last_evaluation) {
      advance(increment, v, state);
    }
    while (true) {
      const auto found = equation(q.array(), v.array(), offset + h);
      const SimdVector<n> acceleration(found.acceleration);
      if (last_evaluation) {
        work += work_[0] * found.power;
        keep(acceleration, found.power);
        break;
      }
      corrected_increment.add(corrected_position_[0], acceleration);
      corrected_rate.add(corrected_rate_[0], acceleration);
      q = q0 + (increment_ + corrected_increment);
      v = corrected_rate;
      advance(corrected_increment, v, state);
      last_evaluation = true;
    }
    state.work.add(work);
    return StepStatus::kOk;
  }

 private:
  using Weights = NodeWeights<n>;

  static constexpr std::size_t kFewTerms = kSchemes[0].terms;
  static constexpr std::size_t kCorrectedTerms = kSchemes[1].terms;
  static constexpr std::size_t kMaxTerms = kSchemes[3].terms;
  static_assert(!kSchemes[0].corrected && kSchemes[1].corrected && !kSchemes[3].corrected &&
                kSchemes[2].terms == kCorrectedTerms && kMaxTerms == stoermer::kMaxTerms);
  static constexpr std::size_t kLength = stoermer::kMaxStoermerNodes;

  static WHIRL_TWIN_INLINE void addTo(SimdVector<n>& high, SimdVector<n>& low,
                                      const SimdVector<n>& increment) {
    const SimdVector<n> corrected = increment + low;
    const SimdVector<n> sum = high + corrected;
    low = corrected - (sum - high);
    high = sum;
  }

  WHIRL_TWIN_INLINE void advance(const SimdVector<n>& increment, const SimdVector<n>& v,
                                 MotionState<n>& state) {
    addTo(increment_, increment_low_, increment);
    SimdVector<n> q(state.q);
    SimdVector<n> q_low(state.q_low);
    addTo(q, q_low, increment_);
    state.q = q.array();
    state.q_low = (q_low + increment_low_).array();
    state.v = v.array();
    state.v_low = {};
    known_advance_ = increment_ + known_increment_;
    known_rate_ = known_of_rate_;
    known_rate_.add(per_step_, increment_);
  }

  /// What the next step knows before this one's acceleration; and the work [J] of this one, but for
  /// the power that is yet to be evaluated.
  template <std::size_t terms>
  WHIRL_TWIN_INLINE double prepare() {
    known_increment_ = sumOfPast<terms - 1>(position_, &past_[newest_]);
    known_of_rate_ = sumOfPast<terms - 1>(rate_, &past_[newest_]);
    return sumOfPast<terms - 1>(work_, &powers_[newest_]).array()[0];
  }
  /// In two places, so that the past is in a row wherever it begins.
  WHIRL_TWIN_INLINE void keep(const SimdVector<n>& acceleration, double power) {
    newest_ = newest_ == 0 ? kLength - 1 : newest_ - 1;
    past_[newest_] = past_[newest_ + kLength] = acceleration;
    powers_[newest_] = powers_[newest_ + kLength] = SimdVector<1>({power});
  }

  /// One step of dormand_prince_8, or, once all accelerations are stored, the preparation of the
  /// first multistep step.
  template <class Equation>
  [[gnu::noinline, gnu::cold]] StepStatus start(const Equation& equation, double offset, double h,
                                                MotionState<n>& state) {
    return withCalls(equation, [&](const ErasedOde<n>& called) {
      return startCalled(called, offset, h, state);
    });
  }
  [[gnu::noinline]] StepStatus startCalled(const ErasedOde<n>& called, double offset, double h,
                                           MotionState<n>& state) {
    if (scheme_->ahead) {
      return startBackwards(called, offset, h, state);
    }
    ready_for_ = 0.0;
    if (gathered_ == 0 || h != gathered_at_) {
      past_ = {};
      powers_ = {};
      gathered_ = 0;
      gathered_at_ = h;
    }
    const Derivative<n> now = called(state.q, state.v, offset);
    keep(SimdVector<n>(now.acceleration), now.power);
    if (++gathered_ == scheme_->terms) {
      begin(h, state);
      return StepStatus::kOk;
    }
    DormandPrince8 alone;
    return erasedStep(alone, called, offset, h, state);
  }
  /// Makes the whole past.
  StepStatus startBackwards(const ErasedOde<n>& called, double offset, double h,
                            const MotionState<n>& state) {
    restart();
    std::array<Derivative<n>, kMaxTerms> found;
    MotionState<n> before = state;
    DormandPrince8 alone;
    for (std::size_t k = 0; k < scheme_->terms; ++k) {
      const double then = offset - static_cast<double>(k) * h;
      found[k] = called(before.q, before.v, then);
      if (k + 1 < scheme_->terms) {
        const StepStatus status = erasedStep(alone, called, then, -h, before);
        if (status != StepStatus::kOk) {
          return status;
        }
      }
    }
    past_ = {};
    powers_ = {};
    for (std::size_t k = scheme_->terms; k > 0; --k) {
      keep(SimdVector<n>(found[k - 1].acceleration), found[k - 1].power);
    }
    begin(h, state);
    return StepStatus::kOk;
  }
  void begin(double h, const MotionState<n>& state) {
    per_step_ = 1.0 / h;
    SimdVector<n> behind{};
    for (std::size_t k = 0; k < kMaxTerms; ++k) {
      const StoermerScheme& s = *scheme_;
      position_.set(k, h * h * s.position[k]);
      rate_.set(k, h * (s.position[k] + s.rate[k]));
      corrected_position_.set(k, h * h * s.corrected_position[k]);
      corrected_rate_.set(k, h * (s.corrected_position[k] + s.corrected_rate[k]));
      work_.set(k, h * s.work[k]);
      behind.add(-h * h * s.backwards[k], past_[newest_ + k]);
    }
    behind.add(h, SimdVector<n>(state.v));
    increment_ = behind;
    increment_low_ = {};
    // Of the step that begins now, whose last acceleration is there already.
    const std::size_t now = newest_;
    newest_ = now + 1;
    prepare<kMaxTerms>();
    newest_ = now;
    known_advance_ = increment_ + known_increment_;
    known_rate_ = known_of_rate_;
    known_rate_.add(per_step_, increment_);
    ready_for_ = h;
  }

  const StoermerScheme* scheme_;
  double ready_for_ = 0.0;  ///< [s], step; 0: the past is not complete
  std::size_t newest_ = 0;
  SimdVector<n> increment_{}, increment_low_{};        ///< d
  SimdVector<n> known_increment_{}, known_advance_{};  ///< of d' - d, of q' - q
  SimdVector<n> known_of_rate_{}, known_rate_{};       ///< of v' - d/h, of v'
  double per_step_ = 0.0;                              ///< [1/s]
  Weights position_{}, rate_{};                        ///< times h^2, h
  NodeWeights<1> work_{};                              ///< times h
  Weights corrected_position_{}, corrected_rate_{};    ///< times h^2, h
  std::array<SimdVector<n>, 2 * kLength> past_{};      ///< accelerations
  std::array<SimdVector<1>, 2 * kLength> powers_{};    ///< [W]
  std::size_t gathered_ = 0;
  double gathered_at_ = 0.0;  ///< [s], step
  double jerk_ = 0.0;
  double acceleration_ = 0.0;
  Array held_{};
};

}  // namespace whirl_twin
