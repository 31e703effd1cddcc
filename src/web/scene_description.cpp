#include "web/scene_description.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "controllers/controller_registry.h"
#include "scene/parameter_paths.h"

namespace whirl_twin {

namespace {

const char* rangeName(Range range) {
  switch (range) {
    case Range::kPositive:
      return "positive";
    case Range::kNotNegative:
      return "not_negative";
    case Range::kCount:
      return "count";
    case Range::kAny:
      break;
  }
  return "any";
}

/// Unit, range and meaning of the number at a path: "damping", "discs[1].mass", "stiffness[0][1]".
Json numberDescription(const std::string& path, const std::vector<ParameterInfo>& parameters,
                       const std::vector<SettingInfo>& settings) {
  const auto entry = [](const std::string& unit, Range range, const std::string& meaning) -> Json {
    return {{"unit", unit}, {"range", rangeName(range)}, {"meaning", meaning}};
  };
  const std::string name = path.substr(0, path.find('['));
  for (const ParameterInfo& one : parameters) {
    if (one.name == path) {
      return entry(one.unit, one.range, one.meaning);
    }
  }
  for (const SettingInfo& one : settings) {
    if (one.name != name) {
      continue;
    }
    const std::string column = path.substr(path.find_last_of(".]") + 1);
    for (const ColumnInfo& each : one.columns) {
      if (each.name == column) {
        return entry(each.unit, each.range, one.meaning);
      }
    }
    return entry(one.unit, Range::kAny, one.meaning);
  }
  return entry("", Range::kAny, "");
}

Json numbersDescription(const state::ParameterChange& values,
                        const std::vector<ParameterInfo>& parameters,
                        const std::vector<SettingInfo>& settings) {
  Json all = Json::array();
  for (std::size_t i = 0; i < values.names.size(); ++i) {
    Json one = {{"name", parameterName(values.system, values.names[i])},
                {"path", values.names[i]},
                {"value", values.values[i]}};
    one.update(numberDescription(values.names[i], parameters, settings));
    all.push_back(std::move(one));
  }
  return all;
}

Json systemDescription(const BuiltSystem& system, const Scene& scene) {
  Json coordinates = Json::array();
  for (const CoordinateInfo& one : system.dynamics->coordinates()) {
    coordinates.push_back({{"name", one.name}, {"unit", one.unit}, {"meaning", one.meaning}});
  }
  Json inputs = Json::array();
  for (const InputInfo& one : system.dynamics->inputs()) {
    const auto given = system.spec.inputs.find(one.name);
    if (given != system.spec.inputs.end() && given->second.kind == InputSignal::Kind::kHeld) {
      inputs.push_back({{"name", one.name},
                        {"unit", one.unit},
                        {"meaning", one.meaning},
                        {"value", given->second.value}});
    }
  }
  const std::size_t drive = scene.driveOf(system.spec);
  return {{"name", system.spec.name},
          {"model", system.model->name},
          {"summary", system.model->summary},
          {"rotor", system.dynamics->isRotor()},
          {"drive", drive < scene.drives.size() ? Json(scene.drives[drive].name) : Json()},
          {"fixed", system.spec.ensemble.count > 0},
          {"coordinates", coordinates},
          {"inputs", inputs},
          {"parameters", numbersDescription(system.parameters(), system.model->parameters,
                                            system.model->settings)}};
}

Json driveDescription(const DriveSpec& drive, std::pair<double, double> range) {
  double acceleration = 0.0, jerk = 0.0;
  for (const SpeedMove& move : drive.profile) {
    acceleration = std::max(acceleration, move.max_acceleration);
    jerk = std::max(jerk, move.max_jerk);
  }
  const double fastest = std::max(std::fabs(range.first), std::fabs(range.second));
  if (acceleration == 0.0) {  // a scene without a profile: to the largest speed in ten seconds
    acceleration = 0.1 * std::max(1.0, fastest);
  }
  return {{"name", drive.name},      {"motor", drive.motor.has_value()},
          {"speed", drive.speed},    {"lowest", range.first},
          {"highest", range.second}, {"max_acceleration", acceleration},
          {"max_jerk", jerk}};
}

}  // namespace

std::string parameterName(const std::string& subject, const std::string& path) {
  return subject + "/" + path;
}

ParameterPlace parameterPlace(const std::string& name) {
  const std::size_t bar = name.find('/');
  return bar == std::string::npos ? ParameterPlace{name, ""}
                                  : ParameterPlace{name.substr(0, bar), name.substr(bar + 1)};
}

Json sceneDescription(const BuiltScene& built, bool read_only) {
  const Scene& scene = built.scene;
  const std::vector<Drive> moved = built.drives();
  Json systems = Json::array(), drives = Json::array(), controllers = Json::array();
  for (const SharedSystem& system : built.systems) {
    systems.push_back(systemDescription(*system, scene));
  }
  for (std::size_t i = 0; i < scene.drives.size(); ++i) {
    drives.push_back(driveDescription(scene.drives[i], moved[i].speedRange()));
  }
  for (const ControllerSpec& one : scene.controllers) {
    const ControllerInfo& info = *findController(one.type);
    controllers.push_back({{"name", one.name},
                           {"type", one.type},
                           {"parameters", numbersDescription(parametersOf(info, one),
                                                             info.parameters, info.settings)}});
  }
  return {{"name", scene.name},     {"step", scene.stepSeconds()},
          {"read_only", read_only}, {"systems", systems},
          {"drives", drives},       {"controllers", controllers}};
}

void addTwinChannels(WebChannels& channels, const BuiltScene& scene, const StepMessages& messages) {
  messages.announce([&](auto kind, const std::string& subject) {
    channels.add<typename decltype(kind)::State>(subject);
  });
  for (const SharedSystem& system : scene.systems) {
    channels.add<state::StabilityMargin>(system->spec.name, true);
    channels.addForPage(pictureTopic(system->spec.name), false);
  }
  for (const ControllerSpec& controller : scene.scene.controllers) {
    channels.add<state::ControllerMargins>(controller.name, true);
  }
  channels.add<state::LoopStatistics>("", true);
  channels.add<state::MonitorStatus>("", true);
  channels.addAlerts();
  channels.addForPage(kSceneTopic, true);
  channels.addForPage(kServerTopic, true);
}

void addParameters(Protocol& protocol, const Json& description) {
  for (const char* group : {"systems", "controllers"}) {
    for (const Json& one : description[group]) {
      for (const Json& parameter : one["parameters"]) {
        protocol.setParameter(
            {parameter["name"].get<std::string>(), parameter["value"].get<double>()});
      }
    }
  }
}

}  // namespace whirl_twin
