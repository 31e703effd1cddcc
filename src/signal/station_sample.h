// What probes show of a whole shaft at an instant: its centre at several stations, and where it
// stands itself.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace whirl_twin {

struct StationSample {
  std::int64_t index = 0;  ///< rises by one from sample to sample; a hole is a sample that is lost
  double time = 0.0;       ///< [s]
  std::int64_t turns = 0;  ///< of the shaft, whole, from its phase mark
  double remainder = 0.0;  ///< [rad], and the rest of a turn
  double speed = 0.0;      ///< [rad/s]
  Eigen::VectorXcd z;      ///< [m], x + i y at each station
};

}  // namespace whirl_twin
