// How fast simulated time goes beside wall time: which steps are due in a period of the loop.
//
// At a factor of 1 one step is; below, a step in some of the periods, evenly; above, several in
// each. The loop itself keeps its rate, so that commands, and its statistics, are what they are at
// any factor. As fast as it goes: as many as there is time and room for.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>

namespace whirl_twin {

class Pace {
 public:
  static constexpr double kSlowest = 0.01;
  static constexpr double kFastest = 1000.0;
  static constexpr double kAsFastAsItGoes = 0.0;

  /// The real-time factor [-], simulated seconds in one of wall time.
  static bool canBe(double factor) {
    return factor == kAsFastAsItGoes || (factor >= kSlowest && factor <= kFastest);
  }

  // Any thread.
  void set(double factor) noexcept { factor_.store(factor, std::memory_order_relaxed); }
  double factor() const noexcept { return factor_.load(std::memory_order_relaxed); }

  // The loop's thread. Real-time safe.

  /// Whole steps that are due in the period that begins; not to be asked as fast as it goes.
  std::int64_t due() noexcept {
    owed_ += factor();
    const double whole = std::floor(owed_ + kRounding);
    owed_ -= whole;
    return static_cast<std::int64_t>(whole);
  }

 private:
  static constexpr double kRounding = 1.0e-9;  ///< ten tenths are a whole

  std::atomic<double> factor_{1.0};
  double owed_ = 0.0;  ///< [steps]
};

}  // namespace whirl_twin
