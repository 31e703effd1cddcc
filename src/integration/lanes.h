// The values of n coordinates, for the sums of a step. Two are a vector register: stored one by one
// and loaded as a pair, as compilers do with an array, they would be late by as much as the
// equations take.
#pragma once

#include <array>
#include <cstddef>

#include "mechanics/force_inline.h"

namespace whirl_twin {

template <std::size_t n>
class Lanes {
 public:
  Lanes() = default;
  WHIRL_TWIN_INLINE explicit Lanes(const std::array<double, n>& x) : x_(x) {}
  WHIRL_TWIN_INLINE const std::array<double, n>& array() const { return x_; }
  WHIRL_TWIN_INLINE void add(double factor, const Lanes& other) {
    for (std::size_t i = 0; i < n; ++i) {
      x_[i] += factor * other.x_[i];
    }
  }
  WHIRL_TWIN_INLINE Lanes operator+(const Lanes& other) const {
    Lanes sum = *this;
    for (std::size_t i = 0; i < n; ++i) {
      sum.x_[i] += other.x_[i];
    }
    return sum;
  }
  WHIRL_TWIN_INLINE Lanes operator-(const Lanes& other) const {
    Lanes rest = *this;
    for (std::size_t i = 0; i < n; ++i) {
      rest.x_[i] -= other.x_[i];
    }
    return rest;
  }

 private:
  std::array<double, n> x_;
};

template <>
class Lanes<2> {
 public:
  Lanes() = default;
  WHIRL_TWIN_INLINE explicit Lanes(const std::array<double, 2>& x) : x_{x[0], x[1]} {}
  WHIRL_TWIN_INLINE std::array<double, 2> array() const { return {x_[0], x_[1]}; }
  WHIRL_TWIN_INLINE void add(double factor, const Lanes& other) { x_ += factor * other.x_; }
  WHIRL_TWIN_INLINE Lanes operator+(const Lanes& other) const {
    Lanes sum;
    sum.x_ = x_ + other.x_;
    return sum;
  }
  WHIRL_TWIN_INLINE Lanes operator-(const Lanes& other) const {
    Lanes rest;
    rest.x_ = x_ - other.x_;
    return rest;
  }

 private:
  using Pair = double __attribute__((vector_size(16)));
  Pair x_;
};

}  // namespace whirl_twin
