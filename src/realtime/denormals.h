// Denormal numbers, below 2.2e-308, take a hundred processor cycles and more each; a decaying
// vibration ends in them. While this object exists, the calling thread rounds them to zero: on
// x86-64 flush-to-zero and denormals-are-zero of MXCSR (Intel SDM vol. 1, 10.2.3), on arm64 FZ of
// FPCR (Arm ARM, C5.2.8). On other processors it has no effect.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace whirl_twin {

class DenormalsToZero {
 public:
  DenormalsToZero() noexcept : before_(control()) { setControl(before_ | kFlush); }
  ~DenormalsToZero() { setControl(before_); }
  DenormalsToZero(const DenormalsToZero&) = delete;
  DenormalsToZero& operator=(const DenormalsToZero&) = delete;

  /// Whether this processor is one where the object has an effect.
  static constexpr bool kSupported =
#if defined(__x86_64__) || defined(__aarch64__)
      true;
#else
      false;
#endif

 private:
#if defined(__x86_64__)
  static constexpr std::uint64_t kFlush = 0x8040;  // FTZ, bit 15; DAZ, bit 6
  static std::uint64_t control() noexcept {
    return _mm_getcsr();
  }
  static void setControl(std::uint64_t value) noexcept {
    _mm_setcsr(static_cast<unsigned>(value));
  }
#elif defined(__aarch64__)
  static constexpr std::uint64_t kFlush = std::uint64_t{1} << 24;  // FZ
  static std::uint64_t control() noexcept {
    std::uint64_t value = 0;
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
  }
  static void setControl(std::uint64_t value) noexcept {
    __asm__ volatile("msr fpcr, %0" : : "r"(value));
  }
#else
      static constexpr std::uint64_t kFlush = 0;
  static std::uint64_t control() noexcept {
    return 0;
  }
  static void setControl(std::uint64_t) noexcept {}
#endif

  std::uint64_t before_;
};

}  // namespace whirl_twin
