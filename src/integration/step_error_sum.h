// Accumulated error of a method's steps, estimated from a sample of them.
//
// A step of the sample is repeated as two half steps; the difference is the error of that step (up
// to a fraction 2^-p of it at order p), and represents all steps since the previous one in the
// sample: the first, the second, the fourth ... the 64th, then one in 64 (or in another power of
// two). The sum is relative to the largest coordinates and rates so far, lengths and angles
// separately; for an angle larger than one radian, in radians.
//
// A motion from rest is small at first. So the first 64 steps count relative to the sizes at the
// 64th, or the present ones before; and their rates relative to sqrt(a q) at least, a the
// acceleration at the start, which is the largest rate of a harmonic motion that starts from rest
// at q (a = w^2 q, v = w q). Where a size more than doubles from one sample to the next the motion
// has restarted from standstill, as when a force or a drive sets in.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace whirl_twin {

/// Of a linear system, whose step may cost no more than its two halves, one step in so many.
inline constexpr int kLinearErrorEvery = 256;

class StepErrorSum {
 public:
  /// Of one step in this number, after the start.
  explicit StepErrorSum(int every = 64, bool adding_up = true)
      : every_(every), adding_up_(adding_up) {}

  // Real-time safe.

  /// Counts a step. True: this one is of the sample, and is to be given to add() or passOver().
  bool countStep() noexcept { return --until_next_ == 0; }

  /// The rates at the start of a step of h [s], and n coordinates and rates at its end, as taken
  /// and in halves; angular(i): is coordinate i an angle?
  template <class Start, class Vector, class Angular>
  void add(std::size_t n, double h, const Start& start_v, const Vector& q, const Vector& v,
           const Vector& finer_q, const Vector& finer_v, const Angular& angular) noexcept {
    const std::array<Size, 2> before = sizes_;
    std::array<Size, 2> errors{};
    std::array<double, 2> accelerations{};
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t unit = angular(i) ? 1 : 0;
      sizes_[unit].q = std::fmax(sizes_[unit].q, std::fabs(q[i]));
      sizes_[unit].v = std::fmax(sizes_[unit].v, std::fabs(v[i]));
      errors[unit].q = std::fmax(errors[unit].q, std::fabs(q[i] - finer_q[i]));
      errors[unit].v = std::fmax(errors[unit].v, std::fabs(v[i] - finer_v[i]));
      accelerations[unit] = std::fmax(accelerations[unit], std::fabs(v[i] - start_v[i]) / h);
    }
    if (!started_) {
      started_ = true;
      start_accelerations_ = accelerations;
    }
    const bool starts_again = taken_ >= every_ && grew(before);
    if (starts_again) {
      sum_ += early_sum_;
      early_ = {};
    }
    if (taken_ < every_ || starts_again) {
      for (std::size_t unit = 0; unit < 2; ++unit) {
        early_[unit].q += steps() * errors[unit].q;
        early_[unit].v += steps() * errors[unit].v;
      }
      early_sum_ = relative(early_, harmonicSizes());
    } else {
      sum_ += steps() * relative(errors, sizes_);
    }
    passOver();
    if (starts_again) {
      gap_ = until_next_ = 1;
      taken_ = 0;
    }
  }
  /// The step has no second result.
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

  /// Number of steps that an error represents.
  double steps() const noexcept { return adding_up_ ? gap_ : 1; }

  bool grew(const std::array<Size, 2>& before) const noexcept {
    bool any = false;
    for (std::size_t unit = 0; unit < 2; ++unit) {
      any = any || sizes_[unit].q > 2.0 * before[unit].q || sizes_[unit].v > 2.0 * before[unit].v;
    }
    return any;
  }

  /// Of an angle at most one radian.
  static double positionSize(const std::array<Size, 2>& sizes, std::size_t unit) noexcept {
    return unit == 1 ? std::fmin(sizes[unit].q, 1.0) : sizes[unit].q;
  }

  /// The sizes of the motion, its rates those of a harmonic one at least.
  std::array<Size, 2> harmonicSizes() const noexcept {
    std::array<Size, 2> sizes = sizes_;
    for (std::size_t unit = 0; unit < 2; ++unit) {
      sizes[unit].v = std::fmax(sizes[unit].v,
                                std::sqrt(start_accelerations_[unit] * positionSize(sizes, unit)));
    }
    return sizes;
  }

  static double relative(const std::array<Size, 2>& errors,
                         const std::array<Size, 2>& sizes) noexcept {
    const auto part = [](double error, double size) { return error == 0.0 ? 0.0 : error / size; };
    double largest = 0.0;
    for (std::size_t unit = 0; unit < 2; ++unit) {
      largest = std::fmax(largest, std::fmax(part(errors[unit].q, positionSize(sizes, unit)),
                                             part(errors[unit].v, sizes[unit].v)));
    }
    return largest;
  }

  int every_;
  bool adding_up_;
  std::array<Size, 2> sizes_{};  ///< of lengths, of angles
  std::array<Size, 2> early_{};  ///< errors of the beginning
  std::array<double, 2> start_accelerations_{};
  bool started_ = false;
  double early_sum_ = 0.0;
  double sum_ = 0.0;
  int gap_ = 1;         ///< steps that the next of the sample represents
  int taken_ = 0;       ///< of all steps, as far as it matters
  int until_next_ = 1;  ///< steps
};

}  // namespace whirl_twin
