#include "reports/scene_check.h"
#include "scene/drive_reader.h"
#include "scene/weak_passage.h"

namespace whirl_twin {

namespace {

void addPublished(const Published& published, Json& json) {
  json["topics"] = Json::array();
  for (const PublishedTopic& topic : published.topics) {
    json["topics"].push_back({{"topic", topic.topic}, {"type", topic.type}});
  }
  json["channels"] = published.channels;
}

Json avoidedJson(const ExclusionBands& avoid) {
  Json json = Json::array();
  for (const SpeedBand& band : avoid.bands()) {
    if (band.from > 0.0) {  // the others are these the other way round
      json.push_back({{"from", band.from}, {"to", band.to}});
    }
  }
  return json;
}

Json driveJson(const DriveSpec& drive, const Published& published) {
  Json json;
  json["speed"] = drive.speed;
  json["angle"] = drive.angle;
  json["profile"] = Json::array();
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
  Json json;
  json["unit"] = check.input.unit;
  if (signal.kind == InputSignal::Kind::kHarmonic) {
    json["amplitude"] = signal.amplitude;
    json["frequency"] = signal.frequency;
    json["phase"] = signal.phase;
  } else if (signal.kind == InputSignal::Kind::kTable) {
    json["instants"] = signal.instants.size();
    json["from"] = static_cast<double>(signal.instants.front()) / 1e9;
    json["to"] = static_cast<double>(signal.instants.back()) / 1e9;
    json["hold"] = signal.hold;
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
            {"acts_on", controller.acted_on}};
  json["avoid"] = avoidedJson(ExclusionBands(avoidedBands(scene, controller)));
  json["weak_passages"] = Json::array();
  for (const WeakPassage& passage : controller.weak_passages) {
    json["weak_passages"].push_back({{"from", passage.band.from},
                                     {"to", passage.band.to},
                                     {"speed", passage.speed},
                                     {"needed", passage.needed},
                                     {"given", passage.given},
                                     {"refused", !passage.tried}});
  }
  addPublished(published, json);
  return json;
}

Json systemJson(const SystemCheck& system) {
  Json json;
  json["model"] = system.model->name;
  json["coordinates"] = Json::array();
  for (const CoordinateInfo& c : system.coordinates) {
    json["coordinates"].push_back(c.name);
  }
  json["states"] = 2 * system.coordinates.size();
  json["drive"] = system.drive ? Json(*system.drive) : Json();
  json["speed"] = system.speed ? Json(*system.speed) : Json();
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

Json json(const SceneCheck& check) {
  Json json;
  json["scene"] = check.scene.name;
  json["file"] = check.scene.source;
  json["step"] = check.scene.stepSeconds();
  json["time"] = static_cast<double>(check.scene.time) / 1.0e9;
  json["gravity"] = check.scene.gravity;
  json["drives"] = Json::object();
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
