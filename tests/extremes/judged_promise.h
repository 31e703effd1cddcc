// The error bound of `integrator: auto` for a scene against its actual error.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "accuracy/step_choice.h"
#include "accuracy/trajectory_error.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Samples of a horizon, some hundreds of them.
struct Sampling {
  std::int64_t interval;  ///< [ns]
  std::size_t samples;

  Sampling(const Scene& one, double most) {
    const auto steps = std::max<std::int64_t>(
        1, std::llround(std::ceil(one.systems.front().horizon / one.stepSeconds() - 1e-6)));
    const auto stride =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<double>(steps) / most));
    interval = stride * one.step;
    samples = static_cast<std::size_t>(steps / stride) + 1;
  }
};

/// How many error bounds could be checked, and over what share of the time.
class EvaluatedBounds {
 public:
  explicit EvaluatedBounds(double rounding) : rounding_(rounding) {}

  /// error: of the bounded solution, own: of the reference; below `rounding` they are
  /// indistinguishable.
  void judge(const SystemSpec& spec, const ErrorBound& p, const Sampling& sampling,
             const ErrorCurve& error, const ErrorCurve& own) {
    const double interval = 1.0e-9 * static_cast<double>(sampling.interval);
    // Only while the reference is accurate, not at a later time after all solutions have diverged.
    const auto isKnown = [&](std::size_t sample) {
      return own.position(sample) <= 0.1 * std::max(spec.tolerance, error.position(sample));
    };
    const auto lastKnown = [&](double time) {
      std::size_t last = std::min(own.samples() - 1,
                                  static_cast<std::size_t>(std::floor(time / interval + 1.0e-9)));
      while (last > 0 && !isKnown(last)) {
        --last;
      }
      return last;
    };
    ++scenes_;
    kept_ += p.kept ? 1 : 0;
    whole_ += isKnown(sampling.samples - 1) ? 1 : 0;
    const std::size_t kept = lastKnown(p.kept_until);
    EXPECT_LE(error.position(kept), 2.0 * spec.tolerance + rounding_)
        << "not kept until " << p.kept_until << " s";
    const std::size_t known = lastKnown(p.known_until);
    EXPECT_GE(5.0 * p.error + 2.0 * own.position(known) + rounding_, error.position(known))
        << "its error is larger, until " << p.known_until << " s";
  }

  /// That more than half could be.
  void expectMost() const {
    fmt::print("[ MEASURED ] of {} scenes {} are promised, {} could be judged to the end\n",
               scenes_, kept_, whole_);
    EXPECT_GT(kept_, scenes_ / 2);
    EXPECT_GT(whole_, scenes_ / 2);
  }

 private:
  double rounding_;
  int scenes_ = 0, kept_ = 0, whole_ = 0;
};

}  // namespace whirl_twin
