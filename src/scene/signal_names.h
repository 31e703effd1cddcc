// Names of the measurable signals of a scene, for sensors and controllers: SYSTEM.COORDINATE,
// SYSTEM.COORDINATE_rate, SYSTEM.STATION.x, and SYSTEM or SYSTEM.STATION together with a direction.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "scene/node_reader.h"
#include "scene/scene.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

// Names under which a rotor's whirl is published: that of the system for the station published
// first, SYSTEM_STATION for every further one. Topics and channels are derived from them as from a
// system's name.

/// "rotor_node_3"
std::string stationName(const std::string& system, const Station& station);

/// All names of a system, that of the system first; for a system that is not a rotor only that.
std::vector<std::string> publishedStations(const std::string& system, const Dynamics& dynamics);

/// Converts a to z to capitals, as in the names of LCM channels.
std::string capitals(std::string text);

struct NamedSignal {
  std::string name;
  SignalSpec signal;
  bool takes_direction = false;
};

class SignalNames {
 public:
  /// For a scene whose systems have been read.
  explicit SignalNames(const Scene& scene);

  /// The signal of that name; nothing, with a diagnostic at `key`, if there is none.
  std::optional<NamedSignal> find(const std::string& name, const std::string& key,
                                  Diagnostics& diagnostics) const;

 private:
  void add(const std::string& name, const SignalSpec& signal, bool takes_direction = false);
  void addDisplacements(const std::string& prefix, SignalSpec at);

  std::vector<NamedSignal> all_;
};

}  // namespace whirl_twin
