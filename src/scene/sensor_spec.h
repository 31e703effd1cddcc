// The sensors of a scene: what is measured of its systems and shafts, and how badly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/keyphasor.h"
#include "control/sensor.h"

namespace whirl_twin {

/// Largest rate of a sensor or a controller accepted [Hz].
inline constexpr double kMaxSampleRate = 1.0e7;

/// Longest delay of a sensor or a controller accepted [s].
inline constexpr double kMaxSignalDelay = 1.0e3;

/// What a sensor is at: a coordinate or its rate, or a rotor's displacement at a station along a
/// direction across the shaft.
struct SignalSpec {
  enum class Kind { kCoordinate, kRate, kDisplacement };
  Kind kind = Kind::kCoordinate;
  std::size_t system = 0;      ///< of Scene::systems
  std::size_t coordinate = 0;  ///< of kCoordinate and kRate
  std::size_t station = 0;     ///< of the system's stations
  double direction = 0.0;      ///< [rad], from +x towards +y
  std::string unit;            ///< "m", "rad", "m/s" or "rad/s"
};

/// A surface that is not round turns under a probe: amplitude cos(shaft angle + angle - direction).
struct RunOut {
  double amplitude = 0.0;  ///< [m]
  double angle = 0.0;      ///< [rad], of the high spot from the shaft's mark
};

struct SensorChannelSpec {
  std::string name;
  SignalSpec signal;
  SensorSettings sensor;
  RunOut run_out;
};

/// Sensors that are sampled together, or one keyphasor: a stream of measurements by this name.
struct SensorSpec {
  std::string name;
  double rate = 0.0;       ///< [Hz]; sample k at k / rate after simulated time 0, to a nanosecond
  std::uint32_t seed = 1;  ///< of the noise
  double block = 0.1;      ///< [s], of samples in a message
  std::vector<SensorChannelSpec> channels;
  std::optional<KeyphasorSettings> keyphasor = std::nullopt;
  std::size_t drive = 0;  ///< of a keyphasor: of Scene::drives
};

}  // namespace whirl_twin
