// The rotors of a scene, as `twin campbell`, `twin response` and `twin orbit` look at them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/linear_rotor.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "scene/built_scene.h"

namespace whirl_twin {

/// Of one chart: as many as it has colours.
inline constexpr std::size_t kMostStationsDrawn = 7;

struct RotorSystem {
  std::string name, model;
  const Dynamics* dynamics = nullptr;  ///< the scene's
  LinearRotor rotor;
  std::vector<Station> stations;
  double lowest_speed = 0.0, highest_speed = 0.0;  ///< [rad/s], that its drive runs through
  std::optional<FlexibleShaft> shaft;              ///< of a flexible_rotor, as its scene gives it

  /// That its tables cover.
  DataSpeeds tables() const { return dataSpeeds(rotor); }
  /// "NAME (MODEL)"
  std::string title() const { return name + " (" + model + ")"; }
};

/// The linear rotors of a scene, or the one of that name. Throws Refusal where there is none.
std::vector<RotorSystem> rotorSystems(const BuiltScene& scene,
                                      const std::optional<std::string>& name);

/// In all coordinates of its nodes, however few it is stepped with: right for motions that its
/// unbalance does not make.
struct WholeRotor {
  LinearRotor rotor;
  std::vector<Station> stations;  ///< in the order of RotorSystem's
};
/// `pushed`: of its stations the one that something else acts on, whose motion then is not left to
/// the others' where it has no mass.
WholeRotor wholeRotor(const RotorSystem& system, std::optional<std::size_t> pushed = std::nullopt);

struct SpeedRange {
  double from = 0.0, to = 0.0;  ///< [rad/s]
  int points = 200;

  std::vector<double> speeds() const;
};

/// Options of a command that looks at a range of speeds.
struct SpeedRangeOptions {
  std::optional<double> from, to;  ///< [rad/s]
  int points = 200;

  /// Missing: from 0 to 1.2 times the drive's highest speed; of a shaft that stands still to twice
  /// the third natural frequency. Throws Refusal.
  SpeedRange of(const RotorSystem& system) const;
};

}  // namespace whirl_twin
