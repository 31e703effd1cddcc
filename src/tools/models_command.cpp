#include <fmt/format.h>

#include "models/model_registry.h"
#include "reports/model_text.h"
#include "tools/commands.h"
#include "tools/listing.h"

namespace whirl_twin {

namespace {

constexpr const char* kModelsDescription =
    "Lists the models a scene can name: their coordinates, inputs, parameters with units, ranges\n"
    "and defaults, and the integrators they can step with.";

constexpr const char* kModelsFooter =
    "Examples:\n"
    "  twin models\n"
    "  twin models jeffcott_rotor\n"
    "  twin models pendulum spinning_pendulum\n"
    "  twin models --json";

/// A shaft's speed is a parameter of a system that has no drive.
ParameterInfo shaftSpeed() {
  return {"speed",      "rad/s", Range::kAny, "of the shaft, constant, unless it has a drive",
          std::nullopt, ""};
}

std::string listedModelText(const ModelInfo& model) {
  std::string out = fmt::format("{}: {}\n", model.name, model.summary);
  for (const ModelVariant& v : model.variants) {
    out += fmt::format("  {}{}{}\n", v.when.empty() ? "" : "with " + v.when + ": ",
                       v.linear ? "linear" : "nonlinear",
                       model.has_shaft ? ", on a turning shaft" : "");
    for (const CoordinateInfo& c : v.coordinates) {
      out += fmt::format("  coordinate  {0} ({1}), rate {0}_rate ({1}/s){2}{3}\n", c.name, c.unit,
                         c.meaning.empty() ? "" : ": ", c.meaning);
    }
    if (v.coordinates.empty()) {
      out += fmt::format("  coordinate  {}\n", model.coordinates_meaning);
    }
    for (const InputInfo& input : v.inputs) {
      out += fmt::format("  input       {:<18} {:<9} {}\n", input.name, input.unit, input.meaning);
    }
  }
  for (const ParameterInfo& p : model.parameters) {
    out += parameterText(p);
  }
  if (model.has_shaft) {
    out += parameterText(shaftSpeed(), "or a drive");
  }
  for (const SettingInfo& s : model.settings) {
    out += settingText(s);
  }
  return out +
         fmt::format("  integrators {}\n", fmt::join(integratorsOf(model.variants.front()), ", "));
}

/// One form of a model; if the number of coordinates depends on the scene, their meaning is text.
Json variantJson(const ModelVariant& v, const std::string& coordinates_meaning) {
  Json json;
  json["linear"] = v.linear;
  json["rotor"] = v.rotor;
  json["coordinates"] = Json::object();
  if (v.coordinates.empty()) {
    json["coordinates_meaning"] = coordinates_meaning;
  }
  for (const CoordinateInfo& c : v.coordinates) {
    json["coordinates"][c.name] = {{"unit", c.unit}, {"meaning", c.meaning}};
  }
  json["inputs"] = Json::object();
  for (const InputInfo& input : v.inputs) {
    json["inputs"][input.name] = {{"unit", input.unit}, {"meaning", input.meaning}};
  }
  json["integrators"] = integratorsOf(v);
  return json;
}

Json listedModelJson(const ModelInfo& model) {
  Json json = variantJson(model.variants.front(), model.coordinates_meaning);
  json["summary"] = model.summary;
  json["shaft"] = model.has_shaft;
  for (std::size_t i = 1; i < model.variants.size(); ++i) {
    json["variants"][model.variants[i].when] =
        variantJson(model.variants[i], model.coordinates_meaning);
  }
  for (const ParameterInfo& p : model.parameters) {
    json["parameters"][p.name] = parameterJson(p);
  }
  if (model.has_shaft) {
    Json speed = parameterJson(shaftSpeed());
    speed["required"] = false;
    json["parameters"]["speed"] = speed;
  }
  for (const SettingInfo& s : model.settings) {
    json["settings"][s.name] = settingJson(s);
  }
  return json;
}

std::vector<ListedThing> listedModels() {
  std::vector<ListedThing> things;
  for (const ModelInfo& model : models()) {
    things.push_back({model.name, listedModelText(model), listedModelJson(model)});
  }
  return things;
}

}  // namespace

void addModelsCommand(const ProgramCommand& twin, int& status) {
  addListing(twin, status, {"model", kModelsDescription, kModelsFooter, listedModels});
}

}  // namespace whirl_twin
