#include "reports/matrix_json.h"
#include "reports/method_analysis.h"

namespace whirl_twin {

namespace {

Json boundsJson(const FrequencyBounds& b) {
  Json json;
  json["exact"] = b.exact[0];
  json["dunkerley_lower"] = b.dunkerley ? Json(*b.dunkerley) : Json();
  if (!b.dunkerley) {
    json["dunkerley_refusal"] = b.refusal;
  }
  json["rayleigh_upper"] = b.rayleigh ? Json(*b.rayleigh) : Json();
  json["ritz_upper"] = b.ritz ? Json(*b.ritz) : Json();
  if (b.iterations > 0) {
    json["matrix_iteration"] = {{"frequency", b.iterated}, {"steps", b.iterations}};
  }
  return json;
}

Json responseJson(const SteadyResponse& r, const SystemAnalysis& a) {
  Json json;
  json["frequency"] = r.frequency;
  if (!r.refusal.empty()) {
    json["refusal"] = r.refusal;
    return json;
  }
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    json["amplitude"][a.coordinates[i].name] = r.amplitude[place];
    json["lag"][a.coordinates[i].name] = r.lag[place];
  }
  return json;
}

}  // namespace

Json json(const MethodAnalysis& m, const SystemAnalysis& a) {
  Json json = Json::object();
  if (m.conservative_form) {
    json["stiffness_form"] = m.stiffness_form;
    json["influence_coefficients"] = m.flexibility ? matrixJson(*m.flexibility) : Json();
    json["rigid_body_modes"] = matrixJson(m.rigid_body_modes.transpose());
  }
  if (m.bounds) {
    json["undamped_natural_frequencies"] = arrayJson(m.bounds->exact);
    json["mode_shapes"] = matrixJson(m.bounds->shapes.transpose());
    json["lowest_frequency"] = boundsJson(*m.bounds);
  }
  for (const SteadyResponse& r : m.responses) {
    json["steady_response"].push_back(responseJson(r, a));
  }
  for (const RouthCondition& c : m.routh_conditions) {
    json["routh_conditions"].push_back(
        {{"condition", c.name}, {"left", c.left}, {"right", c.right}, {"holds", c.holds}});
  }
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    json["virtual_work"][a.coordinates[i].name] =
        m.virtual_work[static_cast<Eigen::Index>(i)] + 0.0;
  }
  for (const Reaction& r : m.reactions) {
    json["reactions"][r.name] = {{"value", r.value}, {"unit", r.unit}};
  }
  for (const Condition& c : m.conditions) {
    json["conditions"][c.name] = {{"margin", c.margin}, {"unit", c.unit}, {"broken", c.broken}};
  }
  return json;
}

}  // namespace whirl_twin
