// The rotors of a scene, for `twin campbell`, `twin response`, `twin orbit` and others, and the
// options of these commands.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/linear_rotor.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "scene/built_scene.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Of one chart: as many as it has colours.
inline constexpr std::size_t kMaxStationsDrawn = 7;

struct RotorSystem {
  std::string name, model;
  const Dynamics* dynamics = nullptr;  ///< the scene's
  LinearRotor rotor;
  std::vector<Station> stations;                   ///< of the shaft
  std::vector<Station> places;                     ///< the same, then its casing
  double lowest_speed = 0.0, highest_speed = 0.0;  ///< [rad/s], that its drive runs through
  std::optional<FlexibleShaft> shaft;              ///< of a flexible_rotor, as its scene gives it

  /// That its tables cover.
  DataSpeeds tables() const { return dataSpeeds(rotor); }
  /// "NAME (MODEL)"
  std::string title() const { return name + " (" + model + ")"; }
  /// Of that name. Throws InputError, which names the option, with a hint.
  std::size_t stationNamed(const char* option, const std::string& station) const;
  /// Likewise among `places`.
  std::size_t placeNamed(const char* option, const std::string& place) const;
};

/// Of a flexible_rotor, as its scene gives it.
std::optional<FlexibleShaft> shaftOf(const BuiltSystem& system);

/// The linear rotors of a scene, or the one of that name. Throws InputError where there is none.
std::vector<RotorSystem> rotorSystems(const BuiltScene& scene,
                                      const std::optional<std::string>& name);

/// The full-order model, also where the simulation uses a reduced one: valid for motions that are
/// not caused by its unbalance.
struct FullOrderModel {
  LinearRotor rotor;
  std::vector<Station> stations, places;  ///< in the order of RotorSystem's
};
/// `pushed`: the station that another force acts on, whose motion then is not condensed where it
/// has no mass.
FullOrderModel fullOrderModel(const RotorSystem& system,
                              std::optional<std::size_t> pushed = std::nullopt);

/// The speed of a shaft [rad/s]. Throws InputError, which names the option.
double speedOption(const char* option, double speed);

struct SpeedRange {
  double from = 0.0, to = 0.0;  ///< [rad/s]
  int points = 200;

  std::vector<double> speeds() const;
};

/// Options of a command for a range of speeds.
struct SpeedRangeOptions {
  std::optional<double> from, to;  ///< [rad/s]
  int points = 200;

  /// Missing: from 0 to 1.2 times the drive's highest speed; of a shaft at standstill to twice
  /// the third natural frequency. Throws InputError.
  SpeedRange of(const RotorSystem& system) const;
};

/// The system of that name, or all of them without a name: indices into scene.systems.
/// Throws InputError with a hint.
std::vector<std::size_t> selectedSystems(const Scene& scene,
                                         const std::optional<std::string>& name);

}  // namespace whirl_twin
