#include "scene/signal_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "messages/names.h"
#include "scene/system_setup.h"

namespace whirl_twin {

std::string stationName(const std::string& system, const Station& station) {
  return system + "_" + station.name;
}

std::vector<std::string> publishedStations(const std::string& system, const Dynamics& dynamics) {
  std::vector<std::string> names{system};
  for (const Station& station : dynamics.stations()) {
    if (station.published) {
      names.push_back(stationName(system, station));
    }
  }
  return names;
}

namespace {

constexpr double kHalfPi = 1.57079632679489661923;

}  // namespace

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

SignalNames::SignalNames(const Scene& scene) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (!scene.systems[i].setup) {
      continue;  // rejected before
    }
    const Dynamics& dynamics = *scene.systems[i].setup->made.dynamics;
    const std::string& system = scene.systems[i].name;
    SignalSpec signal;
    signal.system = i;
    const std::vector<Station> stations = dynamics.places();
    for (std::size_t k = 0; k < stations.size(); ++k) {
      signal.station = k;
      if (k == 0) {
        addDisplacements(system, signal);
      }
      addDisplacements(system + "." + stations[k].name, signal);
    }
    const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      signal.coordinate = k;
      signal.kind = SignalSpec::Kind::kCoordinate;
      signal.unit = coordinates[k].unit;
      add(system + "." + coordinates[k].name, signal);
      signal.kind = SignalSpec::Kind::kRate;
      signal.unit += "/s";
      add(system + "." + coordinates[k].name + "_rate", signal);
    }
  }
}

void SignalNames::add(const std::string& name, const SignalSpec& signal, bool takes_direction) {
  const bool taken = std::any_of(all_.begin(), all_.end(),
                                 [&](const NamedSignal& known) { return known.name == name; });
  if (!taken) {
    all_.push_back({name, signal, takes_direction});
  }
}

void SignalNames::addDisplacements(const std::string& prefix, SignalSpec at) {
  at.kind = SignalSpec::Kind::kDisplacement;
  at.unit = "m";
  add(prefix, at, true);
  add(prefix + ".x", at);
  at.direction = kHalfPi;
  add(prefix + ".y", at);
}

std::optional<NamedSignal> SignalNames::find(const std::string& name, const std::string& key,
                                             Diagnostics& diagnostics) const {
  std::vector<std::string> names;
  for (const NamedSignal& known : all_) {
    if (known.name == name) {
      return known;
    }
    names.push_back(known.name);
  }
  const std::string near = nearestName(name, names);
  diagnostics.add(
      key,
      fmt::format("must be SYSTEM.COORDINATE, SYSTEM.COORDINATE_rate, SYSTEM or SYSTEM.STATION (a "
                  "displacement, also with .x or .y), found {}{}",
                  whirl_twin::inQuotes(name),
                  near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  return std::nullopt;
}

}  // namespace whirl_twin
