// Random numbers that are the same on any machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace whirl_twin {

/// Draw no two of them among a call's arguments: compilers evaluate those in any order.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  /// As likely in any decade.
  double anySize(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform(0.0, static_cast<double>(count)));
  }

 private:
  std::mt19937_64 generator_;
};

/// WHIRL_TWIN_SEED of the environment: other scenes.
inline std::uint64_t seedOr(std::uint64_t seed) {
  const char* given = std::getenv("WHIRL_TWIN_SEED");
  return given == nullptr ? seed : std::stoull(given);
}

}  // namespace whirl_twin
