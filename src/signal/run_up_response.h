// Critical speeds and amplification factors from an actual run-up or run-down: its amplitudes over
// the speed, by the half-power method of API 684,
//
//   AF = Nc / (N2 - N1),   N1 and N2 where the amplitude is 0.707 of the peak at Nc.
//
// In a fast passage the peak is later and lower than at constant speed: the factor is that of the
// rotor where the passage is slow, a < 0.15 (N2 - N1)^2 (ISO 7626-2 is quoted with 54 f^2/Q^2
// Hz/min, which is the same), and else too small.
#pragma once

#include <optional>
#include <vector>

namespace whirl_twin {

struct ResponsePeak {
  double time = 0.0;                           ///< [s], of the highest amplitude that was given
  double speed = 0.0;                          ///< Nc [rad/s], of the peak
  double amplitude = 0.0;                      ///< as given
  std::optional<double> lower, upper;          ///< N1, N2 [rad/s]; none: not within the run
  std::optional<double> amplification_factor;  ///< [-], with both
  double acceleration = 0.0;                   ///< [rad/s^2], of the passage, its size
  bool slow = false;                           ///< the factor, if there is one, is the rotor's
};

class RunUpResponse {
 public:
  /// The next amplitude, of an order (order_vector.h), at a time [s] and a speed [rad/s]. A speed
  /// that turns back begins another run, and the one before is gone.
  void take(double time, double speed, double amplitude);
  /// This speed goes back by more than a fiftieth of the span.
  bool turnsBack(double speed) const;

  /// The peaks of the run, as it went: those that are 1/0.707 times the lowest amplitude on either
  /// side at least, as far as the next higher peak.
  std::vector<ResponsePeak> peaks() const;

 private:
  struct Point {
    double time, speed, amplitude;
  };

  std::optional<double> crossing(std::size_t peak, double level, int direction) const;

  std::vector<Point> run_;
};

}  // namespace whirl_twin
