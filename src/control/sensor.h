// Sensor model of one signal: filter, delay, noise, range and resolution.
//
//   signal s(t) -> anti-alias filter, f' = w (s - f) -> delay -> noise -> range -> resolution
//
// The signal is known at the steps of the twin, with its rate; between two of them it is the cubic
// Hermite interpolant of values and rates, whose relative error for a motion at w rad/s is (w h)^4
// / 384. The filter response to that cubic is exact: with p = s - s'/w + s''/w^2 - s'''/w^3, f(t) =
// p(t) + (f(0) - p(0)) e^(-w t).
#pragma once

#include <cstdint>

namespace whirl_twin {

// Sample instants at a given rate: sample k at k / rate after simulated time 0, to the nearest
// nanosecond, independent of the step of the twin.

class SampleInstants {
 public:
  explicit SampleInstants(double rate);  ///< [Hz], > 0

  /// The nanoseconds from one sample to the next; 0 where that is not a whole number.
  std::int64_t period() const { return period_; }

  // Real-time safe.

  std::int64_t at(std::int64_t k) const noexcept;            ///< [ns]
  std::int64_t firstFrom(std::int64_t time) const noexcept;  ///< sample, not before `time` [ns]

 private:
  double rate_;
  std::int64_t period_;
};

// Counter-based noise: sample k of a channel and seed is the same number on every machine, in any
// order and however often it is evaluated, so that a reset or a replay is bit-identical. Philox
// 4x32-10 (Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11), by
// Random123; Box & Muller's transformation of two of its words.

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

/// Deviations of a sensor from the signal, in the unit of the signal; 0: none.
struct SensorSettings {
  double noise = 0.0;       ///< standard deviation of a sample
  double resolution = 0.0;  ///< of the converter: samples are whole multiples of it
  double range = 0.0;       ///< what lies beyond +-range is clipped, and not valid; 0: no limit
  double bandwidth = 0.0;   ///< [Hz], pole of the anti-alias filter; 0: none
  double delay = 0.0;       ///< [s], a sample at t shows what was at t - delay
};

/// A sample, and whether it is of the signal at all.
struct Sample {
  double value = 0.0;
  bool valid = false;
};

/// A signal between two instants: the cubic through its values and rates there.
struct CubicPiece {
  double length = 0.0;                    ///< [s]
  double from = 0.0, to = 0.0;            ///< values
  double from_rate = 0.0, to_rate = 0.0;  ///< [1/s]

  double at(double t) const noexcept;  ///< 0 <= t <= length [s]
};

class Sensor {
 public:
  /// channel distinguishes the sensors of a source, whose noise is independent.
  Sensor(const SensorSettings& settings, std::uint32_t seed, std::uint32_t channel);

  const SensorSettings& settings() const { return settings_; }

  // Real-time safe.

  /// The signal has been `value` for ever.
  void start(double value) noexcept { filtered_ = value; }
  /// Filter output t [s] after the start of the piece.
  double filtered(const CubicPiece& piece, double t) const noexcept;
  /// Advances the filter to the end of the piece.
  void pass(const CubicPiece& piece) noexcept { filtered_ = filtered(piece, piece.length); }
  /// The present filter output.
  double passed() const noexcept { return filtered_; }
  /// Sample k, of what came out of the filter.
  Sample sample(double filtered, std::int64_t k) const noexcept;

 private:
  SensorSettings settings_;
  CounterNoise noise_;
  double pole_;            ///< [rad/s]; 0: no filter
  double filtered_ = 0.0;  ///< at the start of the next piece
};

}  // namespace whirl_twin
