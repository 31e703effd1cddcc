// Corruption of bytes for the tests of this folder, and the number of runs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace whirl_twin {

using Bytes = std::vector<std::uint8_t>;

/// Few in the suite, many with WHIRL_TWIN_EXTREMES=full.
inline int often(int few, int many) {
  const char* length = std::getenv("WHIRL_TWIN_EXTREMES");
  return length != nullptr && std::string(length) == "full" ? many : few;
}

/// Damages bytes: single bits, numbers that are lengths or doubles at the ends of their ranges,
/// pieces that are cut out, doubled or overwritten.
class Breaker {
 public:
  explicit Breaker(unsigned seed) : random_(seed) {}

  void damage(Bytes& bytes) {
    for (std::size_t times = 1 + below(3); times > 0 && !bytes.empty(); --times) {
      damageOnce(bytes);
    }
  }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  void damageOnce(Bytes& bytes) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(bytes.size() - at, 1 + below(24));
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = from + static_cast<std::ptrdiff_t>(length);
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1u << below(8)));
        break;
      case 1:
        std::generate(from, to, [&] { return static_cast<std::uint8_t>(below(256)); });
        break;
      case 2:
        bytes.erase(from, to);
        break;
      case 3: {
        const Bytes piece(from, to);
        bytes.insert(from, piece.begin(), piece.end());
        break;
      }
      case 4:
        put(bytes, at, kWords[below(std::size(kWords))], 4);
        break;
      default:
        put(bytes, at, kNumbers[below(std::size(kNumbers))], 8);
    }
  }
  /// Big-endian, as far as it fits.
  static void put(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i) {
      bytes[at + i] = static_cast<std::uint8_t>(value >> 8 * (size - 1 - i));
    }
  }

  static constexpr std::uint64_t kWords[] = {0,          1,          0x7fffffff, 0x80000000,
                                             0xffffffff, 0x00ffffff, 0x10000};
  /// Infinity, NaN, the largest double and the smallest, 1e300, the ends of 64 bits.
  static constexpr std::uint64_t kNumbers[] = {
      0x7ff0000000000000u, 0x7ff8000000000000u, 0x7fefffffffffffffu, 0x0000000000000001u,
      0x7e37e43c8800759cu, 0x7fffffffffffffffu, 0x8000000000000000u};
  std::mt19937_64 random_;
};

}  // namespace whirl_twin
