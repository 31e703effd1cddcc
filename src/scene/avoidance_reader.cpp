#include "scene/avoidance_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <vector>

#include "analysis/critical_speeds.h"
#include "analysis/separation_margin.h"
#include "control/drive.h"
#include "control/exclusion_bands.h"
#include "messages/input_error.h"
#include "scene/built_system.h"
#include "scene/held_rotor.h"
#include "scene/model_context.h"

namespace whirl_twin {

namespace {

constexpr int kDigits = 6;  // significant digits of a band edge in a message

/// Rounds an edge to kDigits digits, away from the band, so that it can be typed.
double outward(double edge, bool upwards) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(edge))) + 1 - kDigits);
  const double count = edge / unit;
  const double whole = std::round(count);
  return unit * (std::abs(count - whole) < 1.0e-6 ? whole
                 : upwards                        ? std::ceil(count)
                                                  : std::floor(count));
}

void readBands(const YAML::Node& list, const std::string& key, std::vector<SpeedBand>& bands,
               Diagnostics& diagnostics) {
  if (!list.IsSequence()) {
    diagnostics.add(key, fmt::format("must be a list of speed bands, found {}", shown(list)));
    return;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const MapReader map(list[i], fmt::format("{}[{}]", key, i), {"from", "to"}, "key of a band",
                        diagnostics);
    if (!map.usable()) {
      continue;
    }
    const SpeedBand band{map.number("from", Range::kPositive, "rad/s", std::nullopt),
                         map.numberBetween("to", 0.0, kMaxSpeed, "rad/s", std::nullopt)};
    if (band.from > 0.0 && !band.empty()) {
      bands.push_back(band);
    } else if (band.from > 0.0 && band.to > 0.0) {
      diagnostics.add(map.key("to"), fmt::format("must be greater than from, {} rad/s, found {}",
                                                 band.from, band.to));
    }
  }
}

/// Reports an initial or target speed of a drive inside a barred speed range.
void checkSpeeds(const DriveSpec& drive, const std::string& key, std::int64_t start,
                 Diagnostics& diagnostics) {
  const ExclusionBands avoid(drive.avoid);
  const auto check = [&](const std::string& at, double speed, double acceleration, double jerk) {
    const std::optional<SpeedBand> band = avoid.bandOf(speed, acceleration, jerk);
    if (band) {
      diagnostics.add(
          at,
          fmt::format(
              "must be outside the barred speed range from {0:.{2}g} to {1:.{2}g} rad/s, found {3}",
              outward(band->from, false), outward(band->to, true), kDigits, speed));
    }
    return !band;
  };
  bool fit = check(key + ".speed", drive.speed, 1.0, 0.0);
  for (std::size_t i = 0; i < drive.profile.size(); ++i) {
    const SpeedMove& move = drive.profile[i];
    if (faultOf(move)) {
      return;  // reported before
    }
    fit = check(fmt::format("{}.profile[{}].speed", key, i), move.speed, move.max_acceleration,
                move.max_jerk) &&
          fit;
  }
  if (fit) {
    try {  // errors of the profile as a whole
      static_cast<void>(Drive(drive.speed, drive.angle, drive.profile, start, avoid));
    } catch (const InputError& error) {
      diagnostics.add(key, error.what());
    }
  }
}

}  // namespace

std::vector<SpeedBand> criticalBands(const Scene& scene, std::size_t drive,
                                     std::optional<double> margin, const std::string& key,
                                     Diagnostics& diagnostics) {
  std::vector<SpeedBand> bands;
  for (const SystemSpec& system : scene.systems) {
    if (!system.setup || scene.driveOf(system) != drive) {
      continue;
    }
    try {
      const SharedSystem built = build(system, surroundingsOf(scene, system), drive);
      for (const CriticalSpeed& critical : criticalSpeeds(*heldDynamics(*built))) {
        SpeedBand band = criticalBand(critical.speed, critical.amplification_factor);
        if (margin) {
          band = {critical.speed * (1.0 - *margin), critical.speed * (1.0 + *margin)};
        }
        band.to = std::min(band.to, kMaxSpeed);
        if (!band.empty() && band.from > 0.0) {
          bands.push_back(band);
        }
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      diagnostics.add(key, fmt::format("the critical speeds of systems.{} cannot be computed: {}",
                                       system.name, error.what()));
    }
  }
  return bands;
}

namespace {

/// Into Scene::drives[drive], from the node under `key`.
void readAvoidance(const YAML::Node& node, const std::string& key, std::size_t drive, Scene& scene,
                   Diagnostics& diagnostics) {
  DriveSpec& spec = scene.drives[drive];
  const MapReader map(node, key, {"bands", "critical_speeds", "margin"}, "key of barred speeds",
                      diagnostics);
  if (!map.usable()) {
    return;
  }
  if (spec.motor) {
    diagnostics.add(key,
                    "must not be given with a motor, whose speed is not prescribed: give avoid or "
                    "critical_speeds to a controller of type speed");
    return;
  }
  if (map.has("bands")) {
    readBands(map.at("bands"), map.key("bands"), spec.avoid, diagnostics);
  }
  const bool critical =
      map.choice("critical_speeds", {"false", "true"}, "true or false", "false") == "true";
  std::optional<double> margin;
  if (map.has("margin")) {
    margin =
        map.numberBetween("margin", kMinBandMargin, kMaxBandMargin, "of a critical speed", 0.0);
    if (!critical) {
      diagnostics.add(map.key("margin"), "needs critical_speeds: true");
    }
  }
  if (critical) {
    const std::vector<SpeedBand> found =
        criticalBands(scene, drive, margin, map.key("critical_speeds"), diagnostics);
    spec.avoid.insert(spec.avoid.end(), found.begin(), found.end());
  }
  checkSpeeds(spec, key.substr(0, key.rfind('.')), scene.time, diagnostics);
}

}  // namespace

void readAvoidedSpeeds(const MapReader& scene_map, Scene& scene, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < scene.drives.size(); ++i) {
    const YAML::Node drive = scene_map.at("drives")[scene.drives[i].name];
    if (drive.IsMap() && drive["avoid"]) {
      readAvoidance(drive["avoid"], fmt::format("drives.{}.avoid", scene.drives[i].name), i, scene,
                    diagnostics);
    }
  }
}

}  // namespace whirl_twin
