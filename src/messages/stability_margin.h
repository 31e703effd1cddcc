// What the monitor says of one system at one instant: the verdict, how far it is from instability,
// and the critical speeds around the present speed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin::state {

/// A critical speed seen from the present running speed (API 617/684).
struct CriticalSpeedMargin {
  double speed = 0.0;                       ///< [rad/s], of the peak unbalance response
  std::string direction;                    ///< "forward" or "backward"
  double amplification_factor = 0.0;        ///< [-], Nc / (N2 - N1); NaN: undefined, below 1
  double separation_margin = 0.0;           ///< [percent]; NaN at standstill
  double required_separation_margin = 0.0;  ///< [percent]
  double band_low = 0.0;                    ///< [rad/s], lower end of the speeds to avoid
  double band_high = 0.0;                   ///< [rad/s], upper end
};

/// The whole statement; fields as in whirl_twin/StabilityMargin.
struct StabilityMargin {
  Instant at;
  std::string system;
  std::string model;
  std::uint8_t verdict = 0;  ///< as in the message: 0 asymptotically_stable ... 4 uncertain
  std::string verdict_name;
  std::vector<std::string> coordinate;
  std::vector<double> operating_point;
  double speed = 0.0;  ///< [rad/s]; NaN without a shaft
  std::vector<double> polynomial;
  std::vector<double> first_column;
  std::uint32_t right = 0;
  std::uint32_t imaginary = 0;
  std::uint32_t left = 0;
  double decay_rate = 0.0;         ///< [1/s]
  double damping_ratio = 0.0;      ///< [-]
  double log_decrement = 0.0;      ///< [-]; NaN when overdamped
  double instability_speed = 0.0;  ///< [rad/s]; NaN: none found
  std::vector<CriticalSpeedMargin> critical_speeds;
};

}  // namespace whirl_twin::state
