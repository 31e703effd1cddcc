// The errors of a method's steps, added up from a sample of them.
//
// A step of the sample is taken twice, the second time in halves; what the two differ by is the
// error of that step (order p leaves out a part of 2^-p of it), and stands for all steps since the
// one before it in the sample: the first, the second, the fourth ... the 64th, then one in 64 (or
// in another power of two). The sum is in parts of the largest coordinates and rates so far,
// lengths and angles each by themselves; of an angle that is larger than one radian, in radians.
// The first 64 steps count in parts of the largest at the 64th, or of the present ones before: a
// motion from rest is small.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace whirl_twin {

/// Of a linear system, whose step may cost no more than its two halves, one step in so many.
inline constexpr int kLinearErrorEvery = 256;

class StepErrorSum {
 public:
  /// Of one step in so many, once the beginning is over.
  explicit StepErrorSum(int every = 64, bool adding_up = true)
      : every_(every), adding_up_(adding_up) {}

  // Real-time safe.

  /// Counts a step. True: this one is of the sample, and is to be given to add() or passOver().
  bool countStep() noexcept { return --until_next_ == 0; }

  /// n coordinates and rates at the end of the step, as taken and in halves; angular(i): is
  /// coordinate i an angle?
  template <class Vector, class Angular>
  void add(std::size_t n, const Vector& q, const Vector& v, const Vector& finer_q,
           const Vector& finer_v, const Angular& angular) noexcept {
    std::array<Size, 2> errors{};
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t unit = angular(i) ? 1 : 0;
      sizes_[unit].q = std::fmax(sizes_[unit].q, std::fabs(q[i]));
      sizes_[unit].v = std::fmax(sizes_[unit].v, std::fabs(v[i]));
      errors[unit].q = std::fmax(errors[unit].q, std::fabs(q[i] - finer_q[i]));
      errors[unit].v = std::fmax(errors[unit].v, std::fabs(v[i] - finer_v[i]));
    }
    if (taken_ < every_) {
      for (std::size_t unit = 0; unit < 2; ++unit) {
        early_[unit].q += steps() * errors[unit].q;
        early_[unit].v += steps() * errors[unit].v;
      }
      early_sum_ = relative(early_);
    } else {
      sum_ += steps() * relative(errors);
    }
    passOver();
  }
  /// The step has no second outcome.
  void passOver() noexcept {
    taken_ += gap_;
    gap_ = taken_ < every_ ? taken_ : every_;
    taken_ = gap_;
    until_next_ = gap_;
  }

  double sum() const noexcept { return early_sum_ + sum_; }  ///< [-], of all steps so far
  void restart() noexcept { *this = StepErrorSum(every_, adding_up_); }

 private:
  struct Size {
    double q = 0.0;
    double v = 0.0;
  };

  /// That an error stands for.
  double steps() const noexcept { return adding_up_ ? gap_ : 1; }

  double relative(const std::array<Size, 2>& errors) const noexcept {
    const auto part = [](double error, double size) { return error == 0.0 ? 0.0 : error / size; };
    double largest = 0.0;
    for (std::size_t unit = 0; unit < 2; ++unit) {
      const double q_size = unit == 1 ? std::fmin(sizes_[unit].q, 1.0) : sizes_[unit].q;
      largest = std::fmax(
          largest, std::fmax(part(errors[unit].q, q_size), part(errors[unit].v, sizes_[unit].v)));
    }
    return largest;
  }

  int every_;
  bool adding_up_;
  std::array<Size, 2> sizes_{};  ///< of lengths, of angles
  std::array<Size, 2> early_{};  ///< errors of the beginning
  double early_sum_ = 0.0;
  double sum_ = 0.0;
  int gap_ = 1;         ///< steps that the next of the sample stands for
  int taken_ = 0;       ///< of all steps, as far as it matters
  int until_next_ = 1;  ///< steps
};

}  // namespace whirl_twin
