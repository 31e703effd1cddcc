// What a run publishes that a study can measure, by its name.
//
//   rotor.x, rotor.x_rate                        coordinates and rates of a system
//   rotor.whirl.radius, rotor.whirl.x, .y        of a rotor, and of its further stations
//                                                (`rotor_node_3.whirl.radius`) [m]
//   rotor.whirl.vibration                        likewise: the amplitude over a revolution, without
//                                                sag, that alarms go by (WhirlVibration) [m]
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
  std::size_t owner = 0;  ///< place of the system, or of the drive
  std::size_t place = 0;  ///< of the coordinate, or of the station
  std::string unit;

  bool ofDrive() const { return kind == Kind::kSpeed || kind == Kind::kAcceleration; }
};

std::map<std::string, PublishedQuantity> publishedQuantities(const BuiltScene& scene);

/// Reads quantities of a twin where it stands. The twin outlives it.
class QuantityReader {
 public:
  explicit QuantityReader(const Twin& twin);
  /// Takes the twin's present state.
  void look();
  /// NaN: it is not known yet, as a vibration before the first revolution has ended. To be asked
  /// for after each look().
  double value(const PublishedQuantity& quantity);

 private:
  double energy(const PublishedQuantity& quantity) const;
  double vibration(const PublishedQuantity& quantity, double x, double y);

  const Twin& twin_;
  std::vector<double> record_;
  std::vector<std::vector<Station>> stations_;  // of each system
  struct Vibration {
    WhirlVibration followed;
    std::int64_t step = -1;  // that it has taken last
    double amplitude = 0.0;  // [m]
  };
  std::map<std::pair<std::size_t, std::size_t>, Vibration> vibrations_;  // by system and station
};

}  // namespace whirl_twin
