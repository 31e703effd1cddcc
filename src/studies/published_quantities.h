// Quantities published by a run that a study can measure, by name.
//
//   rotor.x, rotor.x_rate                        coordinates and rates of a system
//   rotor.whirl.radius, rotor.whirl.x, .y        of a rotor, and of its further stations
//                                                (`rotor_node_3.whirl.radius`) [m]
//   rotor.whirl.vibration                        likewise: amplitude over a revolution, without
//                                                sag, used for alarms (WhirlVibration) [m]
//   rotor.kinetic, rotor.potential, rotor.energy [J]
//   shaft.speed, shaft.acceleration              of a drive [rad/s], [rad/s^2]
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "monitoring/whirl_vibration.h"
#include "scene/built_scene.h"
#include "twin/twin.h"

namespace whirl_twin {

struct PublishedQuantity {
  enum class Kind {
    kCoordinate,
    kRate,
    kRadius,
    kVibration,
    kX,
    kY,
    kKinetic,
    kPotential,
    kEnergy,
    kSpeed,
    kAcceleration
  };
  Kind kind = Kind::kCoordinate;
  std::size_t owner = 0;  ///< index of the system, or of the drive
  std::size_t place = 0;  ///< of the coordinate, or of the station
  std::string unit;

  bool ofDrive() const { return kind == Kind::kSpeed || kind == Kind::kAcceleration; }
};

std::map<std::string, PublishedQuantity> publishedQuantities(const BuiltScene& scene);

/// Reads quantities of a twin. The twin must outlive it.
class QuantityReader {
 public:
  explicit QuantityReader(const Twin& twin);
  /// Reads the twin's current state.
  void look();
  /// NaN: not known yet, such as a vibration before the end of the first revolution. Must be called
  /// after each look().
  double value(const PublishedQuantity& quantity);

 private:
  double energy(const PublishedQuantity& quantity) const;
  double vibration(const PublishedQuantity& quantity, double x, double y);

  const Twin& twin_;
  std::vector<double> record_;
  std::vector<std::vector<Station>> stations_;  // of each system
  struct Vibration {
    WhirlVibration followed;
    std::int64_t step = -1;  // last step processed
    double amplitude = 0.0;  // [m]
  };
  std::map<std::pair<std::size_t, std::size_t>, Vibration> vibrations_;  // by system and station
};

}  // namespace whirl_twin
