// Noise that is a function of a counter: sample k of a channel of a seed is the same number on
// every machine, in whatever order and how often it is asked for, so that a reset or a replay gives
// the same bytes. Philox 4x32-10 (Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as
// 1, 2, 3", SC11), by Random123; Box & Muller's transformation of two of its words.
#pragma once

#include <cstdint>

namespace whirl_twin {

class CounterNoise {
 public:
  CounterNoise(std::uint32_t seed, std::uint32_t channel) : seed_(seed), channel_(channel) {}

  /// Number k of a standard normal distribution: at most 6.7 standard deviations out, by the
  /// resolution of 32 bits. Real-time safe.
  double normal(std::int64_t k) const noexcept;
  /// Number k of an even distribution from -1 to 1, neither of them reached. Real-time safe.
  double even(std::int64_t k) const noexcept;

 private:
  std::uint32_t seed_;
  std::uint32_t channel_;
};

}  // namespace whirl_twin
