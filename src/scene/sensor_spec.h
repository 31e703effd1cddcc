// Specification of the sensors of a scene: signals and errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/keyphasor.h"
#include "control/sensor.h"

namespace whirl_twin {

/// Largest rate of a sensor or a controller [Hz].
inline constexpr double kMaxSampleRate = 1.0e7;

/// Longest delay of a sensor or a controller [s].
inline constexpr double kMaxSignalDelay = 1.0e3;

/// The signal of a sensor: a coordinate or its rate, or the displacement of a rotor at a station in
/// a direction across the shaft.
struct SignalSpec {
  enum class Kind { kCoordinate, kRate, kDisplacement };
  Kind kind = Kind::kCoordinate;
  std::size_t system = 0;      ///< of Scene::systems
  std::size_t coordinate = 0;  ///< of kCoordinate and kRate
  std::size_t station = 0;     ///< of the system's stations
  double direction = 0.0;      ///< [rad], from +x towards +y
  std::string unit;            ///< "m", "rad", "m/s" or "rad/s"
};

/// Run-out of the surface under a probe: amplitude cos(shaft angle + angle - direction).
struct RunOut {
  double amplitude = 0.0;  ///< [m]
  double angle = 0.0;      ///< [rad], from the phase reference of the shaft to the high spot
};

struct SensorChannelSpec {
  std::string name;
  SignalSpec signal;
  SensorSettings sensor;
  RunOut run_out;
};

/// Sensors that are sampled together, or one keyphasor: a stream of measurements of this name.
struct SensorSpec {
  std::string name;
  double rate = 0.0;       ///< [Hz]; sample k at k / rate after simulated time 0, to a nanosecond
  std::uint32_t seed = 1;  ///< of the noise
  double block = 0.1;      ///< [s], length of the samples in a message
  std::vector<SensorChannelSpec> channels;
  std::optional<KeyphasorSettings> keyphasor = std::nullopt;
  std::size_t drive = 0;  ///< of a keyphasor: index in Scene::drives
};

}  // namespace whirl_twin
