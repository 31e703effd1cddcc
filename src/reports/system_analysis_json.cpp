#include "reports/matrix_json.h"
#include "reports/system_analysis.h"
#include "reports/table_speeds.h"

namespace whirl_twin {

namespace {

/// {coordinate: value}.
Json byCoordinate(const SystemAnalysis& a, const Eigen::VectorXd& x) {
  Json json;
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    json[a.coordinates[i].name] = x[static_cast<Eigen::Index>(i)];
  }
  return json;
}

/// {coordinate: value, ..., coordinate_rate: value, ...}.
Json stateJson(const SystemAnalysis& a, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  Json json = byCoordinate(a, q);
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    json[a.coordinates[i].name + "_rate"] = v[static_cast<Eigen::Index>(i)];
  }
  return json;
}

Json linearizationJson(const SystemAnalysis& a) {
  Json json;
  json["about"] = stateJson(a, a.about, a.about_v);
  json["mass"] = matrixJson(a.linearization.mass);
  json["damping"] = matrixJson(a.linearization.damping);
  json["gyroscopic"] = matrixJson(a.linearization.gyroscopic);
  json["stiffness"] = matrixJson(a.linearization.stiffness);
  json["circulatory"] = matrixJson(a.linearization.circulatory);
  return json;
}

Json routhJson(const RouthResult& routh) {
  Json json;
  json["verdict"] = name(routh.verdict);
  json["right"] = routh.right;
  json["imaginary"] = routh.imaginary;
  json["left"] = routh.left;
  json["first_column"] = routh.first_column;
  return json;
}

/// The motion of the shape, its momenta conserved.
Json reducedJson(const SystemAnalysis& a) {
  const auto names = [&](const CyclicCoordinates::Places& places) {
    Json list = Json::array();
    for (const Eigen::Index i : places) {
      list.push_back(a.coordinates[static_cast<std::size_t>(i)].name);
    }
    return list;
  };
  const bool rigid_body = a.dynamics->linear();
  Json json;
  if (rigid_body) {
    json["rigid_body_modes"] = a.cyclic.conserved.size() + a.cyclic.driven.size();
  } else {
    json["cyclic"] = names(a.cyclic.conserved);
    json["driven"] = names(a.cyclic.driven);
    for (const Eigen::Index i : a.cyclic.conserved) {
      json["momenta"][a.coordinates[static_cast<std::size_t>(i)].name] = a.momenta[i];
    }
  }
  json["natural_frequencies"] = arrayJson(a.reduced_stability.natural_frequencies);
  json["damping_ratios"] = arrayJson(a.reduced_stability.damping_ratios);
  json["characteristic_polynomial"] = arrayJson(a.reduced_stability.polynomial);
  json["routh"] = routhJson(a.reduced_stability.routh);
  return json;
}

Json criticalSpeedJson(const state::CriticalSpeedMargin& critical) {
  Json json;
  json["speed"] = critical.speed;
  json["direction"] = critical.direction;
  json["amplification_factor"] = critical.amplification_factor;
  json["separation_margin"] = critical.separation_margin;
  json["required_separation_margin"] = critical.required_separation_margin;
  return json;
}

/// Null for what is not a rotor; null stiffness where no cross-coupling makes it grow.
Json crossCouplingJson(const SystemAnalysis& a) {
  if (!a.cross_coupling) {
    return {};
  }
  return {{"station", a.cross_coupling->station},
          {"stiffness", a.cross_coupling->stiffness ? Json(*a.cross_coupling->stiffness) : Json()}};
}

/// The numbers that, changed alone, lead to the loss of stability; `change` is null from zero. Null
/// where they were not looked for.
Json parameterMarginsJson(const SystemAnalysis& a) {
  if (!a.parameter_margins) {
    return {};
  }
  const MarginResolution resolution = marginResolution(*a.dynamics);
  Json json{{"resolution", resolution.stride}, {"reach", resolution.reach}};
  json["parameters"] = Json::array();
  for (const ParameterMargin& margin : *a.parameter_margins) {
    json["parameters"].push_back({{"parameter", margin.parameter},
                                  {"value", margin.value},
                                  {"lost_at", margin.loss.value},
                                  {"change", margin.change},
                                  {"loss", lossName(margin.loss.kind, *a.dynamics)},
                                  {"frequency", margin.loss.frequency}});
  }
  return json;
}

/// What a spread of its numbers does; null without one.
Json spreadMarginJson(const SystemAnalysis& a) {
  if (!a.spread_margin) {
    return {};
  }
  return {{"members", a.spread_margin->decay_rates.size()},
          {"growing", a.spread_margin->beyond(0.0)},
          {"lowest_decay_rate", a.spread_margin->lowest_decay_rate},
          {"stable_throughout", a.spread_margin->stable_throughout}};
}

/// The state at time 0 and the multipliers over a period.
Json periodicJson(const SystemAnalysis& a) {
  Json json{{"period", a.periodic->period},
            {"state", stateJson(a, a.periodic->q, a.periodic->v)},
            {"multipliers", Json::array()}};
  for (const std::complex<double>& multiplier : a.periodic->multipliers) {
    json["multipliers"].push_back({multiplier.real(), multiplier.imag()});
  }
  return json;
}

}  // namespace

CsvTables tables(const SystemAnalysis& a) {
  CsvTable modes{"", {"mode", "natural_frequency", "damping_ratio"}};
  const Stability& s = a.reduced_stability;
  for (std::size_t i = 0; i < s.natural_frequencies.size(); ++i) {
    modes.rows.push_back({{"mode", i + 1},
                          {"natural_frequency", s.natural_frequencies[i]},
                          {"damping_ratio", s.damping_ratios[i]}});
  }
  CsvTable eigenvalues{"eigenvalues", {"re", "im"}};
  for (const auto& root : a.stability.eigenvalues) {
    eigenvalues.rows.push_back({{"re", root.real()}, {"im", root.imag()}});
  }
  CsvTable critical_speeds{"critical_speeds",
                           {"speed", "direction", "amplification_factor", "separation_margin",
                            "required_separation_margin", "beyond_tables"}};
  for (const auto& critical : a.critical_speeds) {
    critical_speeds.rows.push_back(criticalSpeedJson(critical));
    critical_speeds.rows.back()["beyond_tables"] = !a.tables.covers(critical.speed);
  }
  CsvTable parameters{"parameters",
                      {"parameter", "value", "lost_at", "change", "loss", "frequency"}};
  if (a.parameter_margins) {
    parameters.rows = parameterMarginsJson(a)["parameters"];
  }
  CsvTables all{modes, eigenvalues, critical_speeds, parameters};
  if (a.sheet) {
    all.push_back(table(*a.sheet));
  }
  return all;
}

Json json(const SystemAnalysis& a) {
  Json json;
  json["model"] = a.model->name;
  json["coordinates"] = Json::array();
  for (const CoordinateInfo& c : a.coordinates) {
    json["coordinates"].push_back(c.name);
  }
  json["time"] = a.moment.time;
  json["speed"] = a.speed ? Json(*a.speed) : Json();
  json["table_speeds"] = tableSpeedsJson(a.tables);  // null: every speed
  json["beyond_tables"] = a.speed && !a.tables.covers(*a.speed);
  json["state"] = stateJson(a, a.q, a.v);
  json["acceleration"] = byCoordinate(a, a.acceleration);
  json["energy"] = {{"kinetic", a.energies.kinetic},
                    {"potential", a.energies.potential},
                    {"jacobi", a.energies.jacobi},
                    {"dissipated_power", a.energies.dissipated_power},
                    {"input_power", a.energies.input_power}};
  if (a.sheet) {
    json["rotor"] = whirl_twin::json(*a.sheet);
  }
  json["equilibria"] = Json::array();
  for (const Equilibrium& e : a.equilibria) {
    Json entry{{"state", byCoordinate(a, e.q)},
               {"verdict", name(e.stability.routh.verdict)},
               {"decay_rate", e.stability.decay_rate}};
    for (const auto* places : {&a.cyclic.conserved, &a.cyclic.driven}) {
      for (const Eigen::Index i : *places) {
        entry["steady_rates"][a.coordinates[static_cast<std::size_t>(i)].name] = e.v[i];
      }
    }
    json["equilibria"].push_back(entry);
  }
  json["dry_friction"] = Json::array();
  for (const DryHold& hold : a.dry_friction) {
    json["dry_friction"].push_back({{"place", hold.place},
                                    {"level", hold.level},
                                    {"unit", hold.unit},
                                    {"sliding", hold.sliding},
                                    {"held", hold.held},
                                    {"share", hold.share}});
  }
  json["sag"] = whirl_twin::json(a.sag);
  json["linearization"] = linearizationJson(a);
  json["judged_about"] = a.periodic         ? "periodic_motion"
                         : a.of_mean_loads  ? "mean_motion"
                         : a.at_equilibrium ? "equilibrium"
                                            : "initial_state";
  json["periodic_motion"] = a.periodic ? periodicJson(a) : Json();
  json["eigenvalues"] = Json::array();
  for (const auto& root : a.stability.eigenvalues) {
    json["eigenvalues"].push_back({root.real() + 0.0, root.imag() + 0.0});
  }
  json["omitted"] = a.stability.omitted;
  json["natural_frequencies"] = arrayJson(a.reduced_stability.natural_frequencies);
  json["damping_ratios"] = arrayJson(a.reduced_stability.damping_ratios);
  json["characteristic_polynomial"] = arrayJson(a.stability.polynomial);
  json["routh"] = routhJson(a.stability.routh);
  if (a.cyclic.any()) {
    json["reduced"] = reducedJson(a);
  }
  json["uncertain_because"] = a.uncertain_because.empty() ? Json() : Json(a.uncertain_because);
  json["margins"] = {
      {"decay_rate", a.reduced_stability.decay_rate},
      {"damping_ratio", a.reduced_stability.damping_ratio},
      {"log_decrement", a.reduced_stability.log_decrement},
      // Infinite, and so null here, where it holds for any.
      {"log_decrement_amplitude",
       a.decrement_amplitude ? Json(a.decrement_amplitude->amplitude) : Json()},
      {"log_decrement_coordinate",
       a.decrement_amplitude ? Json(a.decrement_amplitude->coordinate) : Json()},
      {"instability_speed", a.instability_speed ? Json(*a.instability_speed) : Json()}};
  json["critical_speeds"] = Json::array();
  for (const auto& critical : a.critical_speeds) {
    json["critical_speeds"].push_back(criticalSpeedJson(critical));
    json["critical_speeds"].back()["beyond_tables"] = !a.tables.covers(critical.speed);
  }
  json["critical_speeds_beyond_reduction"] = a.critical_speeds_beyond;
  json["critical_speeds_searched_to"] = a.critical_speeds_to;  // infinite, and so null: all
  json["cross_coupling_margin"] = crossCouplingJson(a);
  json["parameter_margins"] = parameterMarginsJson(a);
  json["spread_margin"] = spreadMarginJson(a);
  json["steady_speeds"] = Json::array();
  for (const SteadySpeed& steady : a.steady_speeds) {
    json["steady_speeds"].push_back({{"speed", steady.speed},
                                     {"torque", steady.torque},
                                     {"stable", steady.stable},
                                     {"beyond_tables", !a.tables.covers(steady.speed)}});
  }
  return json;
}

}  // namespace whirl_twin
