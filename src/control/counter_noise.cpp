#include "control/counter_noise.h"

#include <Random123/philox.h>

#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kPerWord = 1.0 / 4294967296.0;  // 2^-32

/// The middle of the interval that a word stands for: never 0, never 1.
double uniform(std::uint32_t word) noexcept {
  return (static_cast<double>(word) + 0.5) * kPerWord;
}

r123::Philox4x32::ctr_type wordsOf(std::uint32_t seed, std::uint32_t channel,
                                   std::int64_t k) noexcept {
  const auto count = static_cast<std::uint64_t>(k);
  const r123::Philox4x32::ctr_type counter{
      {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(count >> 32U), 0U, 0U}};
  const r123::Philox4x32::key_type key{{seed, channel}};
  return r123::Philox4x32{}(counter, key);
}

}  // namespace

double CounterNoise::even(std::int64_t k) const noexcept {
  return 2.0 * uniform(wordsOf(seed_, channel_, k)[2]) - 1.0;
}

double CounterNoise::normal(std::int64_t k) const noexcept {
  const r123::Philox4x32::ctr_type words = wordsOf(seed_, channel_, k);
  return std::sqrt(-2.0 * std::log(uniform(words[0]))) * std::cos(kTwoPi * uniform(words[1]));
}

}  // namespace whirl_twin
