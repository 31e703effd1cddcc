#include <fmt/format.h>

#include <cmath>

#include "integration/step_methods.h"
#include "messages/names.h"
#include "reports/asked_cost.h"
#include "reports/scene_check.h"
#include "scene/drive_reader.h"
#include "scene/resonance_passage_check.h"

namespace whirl_twin {

namespace {

std::string topicText(const PublishedTopic& topic) {
  return fmt::format("{} ({})", topic.topic, topic.type);
}

std::string publishedText(const Published& published) {
  return fmt::format("    published on {}, LCM {}\n", joined(published.topics, topicText, ", "),
                     fmt::join(published.channels, ", "));
}

/// Without those that are the same in the other direction.
std::vector<SpeedBand> forwardBands(const ExclusionBands& avoid) {
  std::vector<SpeedBand> bands;
  for (const SpeedBand& band : avoid.bands()) {
    if (band.from > 0.0) {
      bands.push_back(band);
    }
  }
  return bands;
}

std::string avoidedText(const ExclusionBands& avoid) {
  const std::string bands = joined(
      forwardBands(avoid),
      [](const SpeedBand& band) {
        return fmt::format("{:.6g} to {:.6g} rad/s", band.from, band.to);
      },
      ", ");
  return bands.empty()
             ? ""
             : "    barred speeds " + bands + ", in both directions: passed at full acceleration\n";
}

std::string driveText(const DriveSpec& drive, const Published& published) {
  std::string out = fmt::format("  {}: {:g} rad/s", drive.name, drive.speed);
  out += drive.profile.empty()
             ? ", constant until set_speed changes it\n"
             : fmt::format(" at the start, a profile of {:.4g} s\n", profileDuration(drive));
  const std::vector<double> durations = changeDurations(drive);
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const SpeedMove& move = drive.profile[i];
    out += fmt::format("    to {:g} rad/s in {:.4g} s (within {:g} rad/s^2{}), then {:g} s there\n",
                       move.speed, durations[i], move.max_acceleration,
                       move.max_jerk > 0.0 ? fmt::format(" and {:g} rad/s^3", move.max_jerk) : "",
                       move.dwell);
  }
  return out + avoidedText(ExclusionBands(drive.avoid)) + publishedText(published);
}

std::string costText(double cost, double preparation) {
  if (preparation > 0.0) {
    return fmt::format("not measured: preparing its steps takes about {}",
                       durationText(preparation));
  }
  return std::isnan(cost) ? "not measured: it stops within the first steps"
                          : fmt::format("about {:.0f} ns", cost);
}

std::string inputText(const InputCheck& check) {
  const InputSignal& signal = check.signal;
  const std::string& unit = check.input.unit;
  switch (signal.kind) {
    case InputSignal::Kind::kHarmonic:
      return fmt::format("{:g} {} cos({:g} rad/s t {} {:g} rad)", signal.amplitude, unit,
                         signal.frequency, signal.phase < 0.0 ? "-" : "+", std::fabs(signal.phase));
    case InputSignal::Kind::kTable:
      return fmt::format("a table of {} values ({}), {}, from t = {:g} s to {:g} s",
                         signal.values.size(), unit,
                         signal.hold ? "zero-order hold" : "linear interpolation",
                         static_cast<double>(signal.instants.front()) / 1e9,
                         static_cast<double>(signal.instants.back()) / 1e9);
    case InputSignal::Kind::kControlled:
      return fmt::format("given by a controller ({})", unit);
    case InputSignal::Kind::kHeld:
    case InputSignal::Kind::kNone:
      break;
  }
  return fmt::format("{:g} {}", signal.value, unit);
}

std::string checkedControllerText(const Scene& scene, const ControllerSpec& controller,
                                  const Published& published) {
  const std::string jitter =
      controller.jitter == 0
          ? ""
          : fmt::format(", jitter up to {:g} s", static_cast<double>(controller.jitter) / 1e9);
  std::string out = fmt::format(
      "  {}: {} at {:g} Hz, {}{}\n    measures {}, acts on {}\n", controller.name, controller.type,
      controller.rate,
      controller.delay == 0
          ? "without delay"
          : fmt::format("delay {:g} s", static_cast<double>(controller.delay) / 1e9),
      jitter, fmt::join(controller.measured, ", "), fmt::join(controller.acted_on, ", "));
  out += avoidedText(ExclusionBands(avoidedBands(scene, controller)));
  for (const ResonancePassageCheck& passage : controller.weak_passages) {
    out += fmt::format(
        "    {} {}\n",
        passage.tried ? "attempts, with too little torque, the band" : "REFUSES the band",
        describe(passage));
  }
  return out + publishedText(published);
}

std::string checkedSystemText(const SystemCheck& system) {
  const auto unit = [](const CoordinateInfo& c) { return fmt::format("{} ({})", c.name, c.unit); };
  std::string out = fmt::format(
      "  {}: {}, {}\n    coordinates   {}: {} states\n", system.name, system.model->name,
      system.model->summary, joined(system.coordinates, unit, ", "), 2 * system.coordinates.size());
  if (system.drive) {
    out += fmt::format("    shaft         driven by {}\n", *system.drive);
  } else if (system.speed) {
    out += fmt::format("    shaft         {:g} rad/s, constant\n", *system.speed);
  }
  if (system.shaft) {
    out += fmt::format("    its length    {:.6g} m, mass {:.6g} kg, with its discs {:.6g} kg\n",
                       system.shaft->length, system.shaft->mass, system.shaft->rotor_mass);
  }
  out += joined(system.warnings, [](const auto& it) { return "    warning       " + it + "\n"; });
  if (system.starts_at_rest) {
    out += fmt::format("    start         at its equilibrium{}\n",
                       system.sag ? ", sag " + text(*system.sag) : "");
  }
  for (const InputCheck& input : system.inputs) {
    out += fmt::format("    input         {}: {}\n", input.input.name, inputText(input));
  }
  if (!system.note.empty()) {
    out += fmt::format("    set up        {}\n", system.note);
  }
  out += fmt::format("    integrator    {} ({}), {}\n", system.integrator, system.reason,
                     stepsText(system.integrator, system.substeps));
  out += joined(system.published.topics,
                [](const auto& topic) { return "    ROS           " + topicText(topic) + "\n"; });
  out += fmt::format("    LCM           {}\n", fmt::join(system.published.channels, ", "));
  if (!system.ensemble.empty()) {
    out += fmt::format("    ensemble      {}\n", system.ensemble);
  }
  return out + fmt::format("    a step costs  {}, memory {:.1f} kB, no extra thread\n",
                           costText(system.step_cost, system.preparation),
                           static_cast<double>(system.memory) / 1000.0);
}

void addPublished(const Published& published, Json& json) {
  json["topics"] = listJson(published.topics, [](const PublishedTopic& topic) -> Json {
    return {{"topic", topic.topic}, {"type", topic.type}};
  });
  json["channels"] = published.channels;
}

Json avoidedJson(const ExclusionBands& avoid) {
  return listJson(forwardBands(avoid), [](const SpeedBand& band) -> Json {
    return {{"from", band.from}, {"to", band.to}};
  });
}

Json driveJson(const DriveSpec& drive, const Published& published) {
  Json json{{"speed", drive.speed}, {"angle", drive.angle}, {"profile", Json::array()}};
  const std::vector<double> durations = changeDurations(drive);
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const SpeedMove& move = drive.profile[i];
    json["profile"].push_back({{"speed", move.speed},
                               {"max_acceleration", move.max_acceleration},
                               {"max_jerk", move.max_jerk > 0.0 ? Json(move.max_jerk) : Json()},
                               {"duration", durations[i]},
                               {"dwell", move.dwell}});
  }
  json["duration"] = profileDuration(drive);
  json["avoid"] = avoidedJson(ExclusionBands(drive.avoid));
  addPublished(published, json);
  return json;
}

Json inputJson(const InputCheck& check) {
  const InputSignal& signal = check.signal;
  Json json{{"unit", check.input.unit}};
  if (signal.kind == InputSignal::Kind::kHarmonic) {
    json.update({{"amplitude", signal.amplitude},
                 {"frequency", signal.frequency},
                 {"phase", signal.phase}});
  } else if (signal.kind == InputSignal::Kind::kTable) {
    json.update({{"instants", signal.instants.size()},
                 {"from", static_cast<double>(signal.instants.front()) / 1e9},
                 {"to", static_cast<double>(signal.instants.back()) / 1e9},
                 {"hold", signal.hold}});
  } else if (signal.kind == InputSignal::Kind::kControlled) {
    json["controlled"] = true;
  } else {
    json["value"] = signal.value;
  }
  return json;
}

Json checkedControllerJson(const Scene& scene, const ControllerSpec& controller,
                           const Published& published) {
  Json json{{"type", controller.type},
            {"rate", controller.rate},
            {"delay", static_cast<double>(controller.delay) / 1e9},
            {"jitter", static_cast<double>(controller.jitter) / 1e9},
            {"measures", controller.measured},
            {"acts_on", controller.acted_on},
            {"avoid", avoidedJson(ExclusionBands(avoidedBands(scene, controller)))},
            {"weak_passages",
             listJson(controller.weak_passages, [](const ResonancePassageCheck& passage) -> Json {
               return {{"from", passage.band.from}, {"to", passage.band.to},
                       {"speed", passage.speed},    {"needed", passage.needed},
                       {"given", passage.given},    {"refused", !passage.tried}};
             })}};
  addPublished(published, json);
  return json;
}

Json systemJson(const SystemCheck& system) {
  Json json{
      {"model", system.model->name},
      {"coordinates", listJson(system.coordinates, [](const CoordinateInfo& c) { return c.name; })},
      {"states", 2 * system.coordinates.size()},
      {"drive", system.drive},
      {"speed", system.speed}};
  if (system.shaft) {
    json["shaft"] = {{"length", system.shaft->length},
                     {"mass", system.shaft->mass},
                     {"rotor_mass", system.shaft->rotor_mass}};
  }
  json["warnings"] = system.warnings;
  json["starts_at_equilibrium"] = system.starts_at_rest;
  json["sag"] = whirl_twin::json(system.sag);
  for (const InputCheck& input : system.inputs) {
    json["inputs"][input.input.name] = inputJson(input);
  }
  if (!system.note.empty()) {
    json["note"] = system.note;
  }
  json["integrator"] = system.integrator;
  json["reason"] = system.reason;
  json["accuracy"] = {{"tolerance", system.tolerance},
                      {"horizon", system.horizon},
                      {"error", system.accuracy.error},
                      {"rate_error", system.accuracy.rate_error},
                      {"reference_error", system.accuracy.reference_error},
                      {"kept", system.accuracy.kept},
                      {"kept_until", system.accuracy.kept_until},
                      {"known_until", system.accuracy.known_until}};
  json["substeps"] = system.substeps;
  addPublished(system.published, json);
  if (!system.ensemble.empty()) {
    json["ensemble"] = system.ensemble;
  }
  json["ns_per_step"] = system.step_cost;
  json["memory_bytes"] = system.memory;
  return json;
}

}  // namespace

std::string text(const SceneCheck& check) {
  const Scene& scene = check.scene;
  std::string out = fmt::format(
      "{}: scene '{}' is valid\n  step {:g} s ({:g} Hz), from t = {:g} s, gravity {:g} m/s^2\n",
      scene.source, printable(scene.name), scene.stepSeconds(), 1.0 / scene.stepSeconds(),
      static_cast<double>(scene.time) / 1.0e9, scene.gravity);
  out += scene.drives.empty() ? "" : "drives\n";
  out += joined(scene.drives, [&](const DriveSpec& drive) {
    return driveText(drive, check.drives.at(drive.name));
  });
  out += "systems\n" + joined(check.systems, checkedSystemText);
  out += scene.controllers.empty() ? "" : "controllers\n";
  out += joined(scene.controllers, [&](const ControllerSpec& controller) {
    return checkedControllerText(scene, controller, check.controllers.at(controller.name));
  });
  double preparation = 0.0;
  for (const SystemCheck& system : check.systems) {
    preparation += system.preparation;
  }
  out += fmt::format("all systems\n  a step costs {}", costText(check.step_cost, preparation));
  if (!std::isnan(check.step_cost)) {
    const double factor = static_cast<double>(scene.step) / check.step_cost;
    out +=
        fmt::format(": {} times faster than real time",
                    factor < 100.0 ? fmt::format("{:.3g}", factor) : fmt::format("{:.0f}", factor));
  }
  return out + fmt::format(
                   "\n  memory {:.1f} kB, and {} bytes for each step in flight\n  live, three "
                   "threads beside those of ROS: one steps everything, one publishes, one answers "
                   "services\n",
                   static_cast<double>(check.memory) / 1000.0, check.record);
}

Json json(const SceneCheck& check) {
  Json json{
      {"scene", check.scene.name},         {"file", check.scene.source},
      {"step", check.scene.stepSeconds()}, {"time", static_cast<double>(check.scene.time) / 1.0e9},
      {"gravity", check.scene.gravity},    {"drives", Json::object()}};
  for (const DriveSpec& drive : check.scene.drives) {
    json["drives"][drive.name] = driveJson(drive, check.drives.at(drive.name));
  }
  for (const SystemCheck& system : check.systems) {
    json["systems"][system.name] = systemJson(system);
  }
  for (const ControllerSpec& controller : check.scene.controllers) {
    json["controllers"][controller.name] =
        checkedControllerJson(check.scene, controller, check.controllers.at(controller.name));
  }
  json["ns_per_step"] = check.step_cost;
  json["real_time_factor"] = static_cast<double>(check.scene.step) / check.step_cost;
  json["memory_bytes"] = check.memory;
  json["threads"] = 3;  // of the live node, however many systems there are
  json["record_bytes"] = check.record;
  return json;
}

}  // namespace whirl_twin
