#include "reports/rotor_systems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/whirl_modes.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "models/flexible_shaft_settings.h"

namespace whirl_twin {

namespace {

constexpr double kBeyondHighestSpeed = 1.2;  // of the drive's highest speed
constexpr double kFastestShaft = 1.0e6;
constexpr int kMaxRangePoints = 10'000;

bool isLinearRotor(const Dynamics& dynamics) {
  return dynamics.linear() && dynamics.hasShaft() && !dynamics.stations().empty();
}

}  // namespace

std::vector<std::size_t> selectedSystems(const Scene& scene,
                                         const std::optional<std::string>& name) {
  std::vector<std::size_t> selected;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    names.push_back(scene.systems[i].name);
    if (!name || *name == names.back()) {
      selected.push_back(i);
    }
  }
  if (selected.empty()) {
    throw InputError(
        fmt::format("--system: no system '{}' in {}{}", *name, scene.source, hint(*name, names)));
  }
  return selected;
}

std::optional<FlexibleShaft> shaftOf(const BuiltSystem& system) {
  if (system.model->name != "flexible_rotor") {
    return std::nullopt;
  }
  return flexibleShaft(system.spec.parameters, system.spec.settings,
                       system.spec.setup->around.gravity);
}

double speedOption(const char* option, double speed) {
  if (!(speed >= 0.0 && speed <= kFastestShaft)) {
    throw InputError(fmt::format("{}: expected a shaft speed from 0 to {:g} rad/s, found {:g}",
                                 option, kFastestShaft, speed));
  }
  return speed;
}

namespace {

std::size_t indexOf(const char* option, const std::string& station,
                    const std::vector<Station>& among, const std::string& title) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < among.size(); ++i) {
    names.push_back(among[i].name);
    if (names.back() == station) {
      return i;
    }
  }
  throw InputError(
      fmt::format("{}: no station '{}' on {}{}", option, station, title, hint(station, names)));
}

}  // namespace

std::size_t RotorSystem::stationNamed(const char* option, const std::string& station) const {
  return indexOf(option, station, stations, title());
}

std::size_t RotorSystem::placeNamed(const char* option, const std::string& place) const {
  return indexOf(option, place, places, title());
}

std::vector<RotorSystem> rotorSystems(const BuiltScene& scene,
                                      const std::optional<std::string>& name) {
  std::vector<RotorSystem> rotors;
  std::vector<std::string> others;
  for (const std::size_t i : selectedSystems(scene.scene, name)) {
    const BuiltSystem& system = *scene.systems[i];
    const Dynamics& dynamics = *system.dynamics;
    if (!isLinearRotor(dynamics)) {
      others.push_back(fmt::format("{} ({})", system.spec.name, system.spec.model));
      continue;
    }
    const auto [low, high] = scene.driveOf(system).speedRange();
    rotors.push_back({system.spec.name, system.spec.model, &dynamics, dynamics.linearRotor(),
                      dynamics.stations(), dynamics.places(), std::max(0.0, low),
                      std::max(std::fabs(low), std::fabs(high)), shaftOf(system)});
  }
  if (rotors.empty()) {
    throw InputError(
        fmt::format("{}: expected a linear rotor on a shaft of prescribed speed, found {}",
                    name ? "--system" : scene.scene.source, fmt::join(others, ", ")));
  }
  return rotors;
}

FullOrderModel fullOrderModel(const RotorSystem& system, std::optional<std::size_t> pushed) {
  if (!system.shaft) {
    return {system.rotor, system.stations, system.places};
  }
  FlexibleShaft shaft = *system.shaft;
  for (int node = 0; pushed && node < shaft.nodes(); ++node) {
    if (system.stations[*pushed].name == fmt::format("node_{}", node)) {
      shaft.pushed.push_back(node);
    }
  }
  const RotorAssembly assembly(shaft);
  FullOrderModel full{assembly.linearRotor(), {}, {}};
  std::vector<Station> all = assembly.stations();
  const std::vector<Station> pedestals = assembly.pedestals();
  all.insert(all.end(), pedestals.begin(), pedestals.end());
  for (const Station& place : system.places) {
    full.places.push_back(*std::find_if(
        all.begin(), all.end(), [&](const Station& one) { return one.name == place.name; }));
  }
  full.stations.assign(full.places.begin(),
                       full.places.begin() + static_cast<std::ptrdiff_t>(system.stations.size()));
  return full;
}

std::vector<double> SpeedRange::speeds() const {
  std::vector<double> all;
  for (int i = 0; i < points; ++i) {
    all.push_back(from + (to - from) * i / (points - 1));
  }
  return all;
}

SpeedRange SpeedRangeOptions::of(const RotorSystem& system) const {
  SpeedRange range{speedOption("--from", from.value_or(0.0)), 0.0, points};
  if (points < 2 || points > kMaxRangePoints) {
    throw InputError(
        fmt::format("--points: expected from 2 to {}, found {}", kMaxRangePoints, points));
  }
  if (to) {
    range.to = speedOption("--to", *to);
  } else if (system.highest_speed > 0.0) {
    range.to = kBeyondHighestSpeed * system.highest_speed;
  } else {
    const auto modes = whirlModes(system.rotor, system.stations, 0.0).modes;
    range.to = modes.empty()
                   ? 100.0
                   : 2.0 * modes[std::min<std::size_t>(2, modes.size() - 1)].naturalFrequency();
  }
  if (!(range.from < range.to)) {
    throw InputError(fmt::format("--from, --to: --from must be < --to, found {:g} and {:g} rad/s",
                                 range.from, range.to));
  }
  return range;
}

}  // namespace whirl_twin
