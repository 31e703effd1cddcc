// Everything in a scene that can be measured, by the names that sensors and controllers use:
// SYSTEM.COORDINATE, SYSTEM.COORDINATE_rate, SYSTEM.STATION.x, and SYSTEM or SYSTEM.STATION where a
// direction goes with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "scene/node_reader.h"
#include "scene/scene.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

// Under which names a rotor's whirl is published: the system's own for the station published first,
// SYSTEM_STATION for every further one. Topics and channels follow from them as from a system's.

/// "rotor_node_3"
std::string stationName(const std::string& system, const Station& station);

/// All names of a system, its own first; of what is no rotor only that.
std::vector<std::string> publishedStations(const std::string& system, const Dynamics& dynamics);

/// With a to z in capitals, as in the names of LCM channels.
std::string capitals(std::string text);

struct NamedSignal {
  std::string name;
  SignalSpec signal;
  bool takes_direction = false;
};

class SignalNames {
 public:
  /// Of a scene whose systems have been read.
  explicit SignalNames(const Scene& scene);

  /// The signal of that name; nothing, with a complaint at `key`, if there is none.
  std::optional<NamedSignal> find(const std::string& name, const std::string& key,
                                  Complaints& complaints) const;

 private:
  void add(const std::string& name, const SignalSpec& signal, bool takes_direction = false);
  void addDisplacements(const std::string& prefix, SignalSpec at);

  std::vector<NamedSignal> all_;
};

}  // namespace whirl_twin
