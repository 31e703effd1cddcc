// The fixed-size snapshot of one step that travels from the real-time thread to the publisher: a
// flat row of doubles, whole numbers carried by their bits. The layout is set by the scene, once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace whirl_twin {

/// A whole number in a double's place.
inline double packed(std::int64_t value) noexcept {
  double bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline std::int64_t unpacked(double bits) noexcept {
  std::int64_t value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Where things stand in a record.
struct RecordLayout {
  static constexpr std::size_t kStep = 0;       ///< steps since the start
  static constexpr std::size_t kScheduled = 1;  ///< [ns], when the step was due; set by the loop
  static constexpr std::size_t kDrives = 2;
  /// A drive: turns, remainder [rad], speed [rad/s], acceleration [rad/s^2], jerk [rad/s^3], target
  /// speed [rad/s]. Of a motor the jerk is 0 and the target the present speed: it has none.
  static constexpr std::size_t kDriveSize = 6;

  /// Of each system: status, q, v, work [J] since it was set, generation (0: as the scene says; see
  /// system_generations.h), sum of its steps' errors [-] since it was set.
  std::vector<std::size_t> system;
  std::size_t size = 0;
};

}  // namespace whirl_twin
