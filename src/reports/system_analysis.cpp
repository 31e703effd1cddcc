#include "reports/system_analysis.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/critical_speeds.h"
#include "analysis/instability_speed.h"
#include "analysis/separation_margin.h"
#include "messages/input_error.h"
#include "reports/report_values.h"
#include "scene/driven_dynamics.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

namespace {

Eigen::VectorXd vector(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Steady speeds of a rotor that a motor turns, by the linear rotor at constant speed; empty where
/// there is no motor, or that rotor is not linear.
std::vector<SteadySpeed> steadySpeedsOf(const BuiltSystem& system) {
  const std::optional<RotorOnMotor> driven = rotorOnMotor(system);
  return driven && driven->held->linear() && driven->held->hasShaft()
             ? sommerfeldSpeeds(driven->held->linearRotor(), driven->motor,
                                highestSpeed(driven->motor))
             : std::vector<SteadySpeed>{};
}

/// Into `judged` the verdict on the operating point, if there is one.
void linearize(const Dynamics& dynamics, double speed, SystemAnalysis& a,
               std::optional<Stability>& judged) {
  if (const auto point = operatingPoint(dynamics, a.q, a.v, speed)) {
    a.at_equilibrium = true;
    a.about = point->q;
    a.about_v = point->v;
    a.linearization = linearizationAbout(dynamics, a.about, a.about_v, speed);
    a.periodic = point->periodic;
    judged = point->stability;
    a.sag = largestSag(dynamics, a.about);
  } else {
    a.about = a.q;
    a.about_v = a.v;
    a.linearization = dynamics.linearization(a.q, a.v, a.acceleration, a.moment);
  }
}

std::string doubtAbout(const SystemAnalysis& a) {
  if (a.reduced_stability.routh.verdict != Verdict::kUncertain) {
    return "";
  }
  if (!a.at_equilibrium && !a.dynamics->linear()) {
    return a.dynamics->hasShaft() ? "no equilibrium was found at this speed"
                                  : "no equilibrium or steady motion was found";
  }
  if (a.dynamics->linear() && a.equilibria.empty()) {
    return "there is no equilibrium: a constant load acts along a coordinate without stiffness";
  }
  return a.reduced_stability.omitted > 0
             ? "not proved that all omitted modes are stable"
             : "too near the stability boundary for the numerical precision";
}

/// The generalized force of the inputs at the scene's start.
Eigen::VectorXd inputForce(const BuiltScene& scene, const BuiltSystem& system) {
  const Inputs signals = scene.inputsOf(system);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(system.dynamics->dof());
  const std::vector<InputInfo> inputs = system.dynamics->inputs();
  for (std::size_t i = 0; i < signals.count(); ++i) {
    force += signals.value(i, 0.0) * inputs[i].direction;
  }
  return force;
}

SystemAnalysis analyzeSystem(const BuiltScene& scene, const BuiltSystem& system,
                             ParameterSearch search, std::size_t modes) {
  const std::shared_ptr<const Dynamics> driven = judgedDynamics(system.dynamics, system.spec);
  const Dynamics& dynamics = *driven;
  const ShaftMotion shaft = scene.driveOf(system).at(0.0);
  SystemAnalysis a;
  a.name = system.spec.name;
  a.model = system.model;
  a.dynamics = system.dynamics.get();
  a.coordinates = dynamics.coordinates();
  a.moment = {scene.startSeconds(), shaft.angle, shaft.speed, shaft.acceleration};
  if (system.model->has_shaft) {
    a.speed = shaft.speed;
  }
  a.q = vector(system.spec.q);
  a.v = vector(system.spec.v);
  a.acceleration = system.dynamics->acceleration(a.q, a.v, a.moment);
  if (!system.spec.inputs.empty()) {
    a.acceleration +=
        Ldlt(dynamics.massMatrix(a.q, a.v, a.moment)).solve(inputForce(scene, system));
  }
  a.dry_friction = system.dynamics->dryHolds(
      a.q, a.v,
      system.spec.inputs.empty() ? Eigen::VectorXd::Zero(a.q.size()) : inputForce(scene, system),
      a.moment);
  a.energies = dynamics.energies(a.q, a.v, a.moment);
  a.momenta = dynamics.momenta(a.q, a.v, a.moment);
  a.cyclic = cyclicCoordinates(dynamics, shaft.speed);
  a.equilibria = equilibria(dynamics, shaft.speed, a.q, a.v);
  std::optional<Stability> judged;
  linearize(dynamics, shaft.speed, a, judged);
  a.stability = dynamics.linear() ? stabilityWithRigidBodyModes(a.linearization, a.cyclic, modes)
                                  : stability(a.linearization, 0, modes);
  a.reduced_stability =
      a.cyclic.any() ? reducedStability(a.linearization, a.cyclic, modes) : a.stability;
  const TimeDependence time = timeDependence(dynamics, shaft.speed);
  a.of_mean_loads = time.varies && !time.period && !dynamics.linear();
  if (time.period || (time.varies && dynamics.linear())) {
    a.stability = a.reduced_stability = judged ? *judged : unjudged();
  }
  for (const double coefficient : a.stability.polynomial) {
    if (std::fabs(coefficient) == std::numeric_limits<double>::max()) {  // it has been capped
      throw std::overflow_error("a coefficient of the characteristic polynomial");
    }
  }
  a.sheet = rotorSheet(system, shaft.speed);
  if (a.at_equilibrium || dynamics.linear()) {
    a.instability_speed = instabilitySpeed(dynamics, a.about, shaft.speed);
  } else {
    a.stability = a.reduced_stability = unjudged();
  }
  if (dynamics.linear() && a.equilibria.empty()) {
    a.stability.routh.verdict = a.reduced_stability.routh.verdict = Verdict::kUncertain;
  }
  a.uncertain_because = doubtAbout(a);
  const CriticalSpeedSearch critical_speeds = searchCriticalSpeeds(*heldDynamics(system));
  a.critical_speeds_beyond = critical_speeds.beyond;
  a.highest_speed = critical_speeds.highest_speed;
  a.tables = tableSpeeds(system);
  a.critical_speeds_to = critical_speeds.searched_to;
  for (const CriticalSpeed& critical : critical_speeds.found) {
    a.critical_speeds.push_back(criticalSpeedMargin(shaft.speed, critical.speed,
                                                    critical.forward ? "forward" : "backward",
                                                    critical.amplification_factor));
  }
  a.cross_coupling = crossCouplingMarginOf(dynamics, shaft.speed);
  a.steady_speeds = steadySpeedsOf(system);
  // An equilibrium that is unstable has no stability to lose.
  const bool holds = a.at_equilibrium && (dynamics.linear() || a.reduced_stability.bounded());
  if (holds && (search == ParameterSearch::kOfAll || isQuickToSearch(system))) {
    a.parameter_margins = parameterMargins(system, {a.about, a.about_v}, shaft.speed);
    a.decrement_amplitude = linearDampingLimit(dynamics, {a.about, a.about_v}, shaft.speed);
  }
  if (holds) {
    a.spread_margin = robustStabilityMargin(system, {a.about, a.about_v}, shaft.speed);
  }
  return a;
}

/// {coordinate: value, ..., coordinate_rate: value, ...}; v may be empty.
Json stateJson(const SystemAnalysis& a, const Eigen::VectorXd& q, const Eigen::VectorXd& v = {}) {
  Json json;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    json[a.coordinates[static_cast<std::size_t>(i)].name] = q[i];
  }
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    json[a.coordinates[static_cast<std::size_t>(i)].name + "_rate"] = v[i];
  }
  return json;
}

Json routhJson(const RouthResult& routh) {
  return {{"verdict", name(routh.verdict)},
          {"right", routh.right},
          {"imaginary", routh.imaginary},
          {"left", routh.left},
          {"first_column", routh.first_column}};
}

/// The motion of the shape, its momenta conserved.
Json reducedJson(const SystemAnalysis& a) {
  const auto name_of = [&](Eigen::Index i) {
    return a.coordinates[static_cast<std::size_t>(i)].name;
  };
  Json json;
  if (a.dynamics->linear()) {
    json["rigid_body_modes"] = a.cyclic.conserved.size() + a.cyclic.driven.size();
  } else {
    json["cyclic"] = listJson(a.cyclic.conserved, name_of);
    json["driven"] = listJson(a.cyclic.driven, name_of);
    for (const Eigen::Index i : a.cyclic.conserved) {
      json["momenta"][name_of(i)] = a.momenta[i];
    }
  }
  json["natural_frequencies"] = arrayJson(a.reduced_stability.natural_frequencies);
  json["damping_ratios"] = arrayJson(a.reduced_stability.damping_ratios);
  json["characteristic_polynomial"] = arrayJson(a.reduced_stability.polynomial);
  json["routh"] = routhJson(a.reduced_stability.routh);
  return json;
}

Json criticalSpeedsJson(const SystemAnalysis& a) {
  return listJson(a.critical_speeds, [&](const state::CriticalSpeedMargin& critical) -> Json {
    return {{"speed", critical.speed},
            {"direction", critical.direction},
            {"amplification_factor", critical.amplification_factor},
            {"separation_margin", critical.separation_margin},
            {"required_separation_margin", critical.required_separation_margin},
            {"beyond_tables", !a.tables.covers(critical.speed)}};
  });
}

/// Parameters that, changed alone, lead to an instability point; `change` is null from zero. Null
/// where they were not searched.
Json parameterMarginsJson(const SystemAnalysis& a) {
  if (!a.parameter_margins) {
    return {};
  }
  const MarginResolution resolution = marginResolution(*a.dynamics);
  return {{"resolution", resolution.stride},
          {"reach", resolution.reach},
          {"parameters", listJson(*a.parameter_margins, [&](const ParameterMargin& margin) -> Json {
             return {{"parameter", margin.parameter},
                     {"value", margin.value},
                     {"lost_at", margin.loss.value},
                     {"change", margin.change},
                     {"loss", lossName(margin.loss.kind, *a.dynamics)},
                     {"frequency", margin.loss.frequency}};
           })}};
}

Json spreadMarginJson(const RobustStabilityMargin& margin) {
  return {{"members", margin.decay_rates.size()},
          {"growing", margin.beyond(0.0)},
          {"lowest_decay_rate", margin.lowest_decay_rate},
          {"stable_throughout", margin.stable_throughout}};
}

Json equilibriumJson(const SystemAnalysis& a, const Equilibrium& e) {
  Json json{{"state", stateJson(a, e.q)},
            {"verdict", name(e.stability.routh.verdict)},
            {"decay_rate", e.stability.decay_rate}};
  for (const auto* places : {&a.cyclic.conserved, &a.cyclic.driven}) {
    for (const Eigen::Index i : *places) {
      json["steady_rates"][a.coordinates[static_cast<std::size_t>(i)].name] = e.v[i];
    }
  }
  return json;
}

}  // namespace

SystemAnalysis analyze(const BuiltScene& scene, std::size_t place, ParameterSearch search,
                       std::size_t modes) {
  const BuiltSystem& system = *scene.systems[place];
  try {
    return analyzeSystem(scene, system, search, modes);
  } catch (const std::exception& error) {  // an overflow: exact numbers refuse infinities
    throw RunFailure(
        fmt::format("{}: cannot be analysed, a value exceeds the range of a double: {}",
                    system.spec.name, error.what()));
  }
}

CsvTables tables(const SystemAnalysis& a) {
  CsvTable modes{"", {"mode", "natural_frequency", "damping_ratio"}};
  const Stability& s = a.reduced_stability;
  for (std::size_t i = 0; i < s.natural_frequencies.size(); ++i) {
    modes.rows.push_back({{"mode", i + 1},
                          {"natural_frequency", s.natural_frequencies[i]},
                          {"damping_ratio", s.damping_ratios[i]}});
  }
  CsvTables all{modes,
                {"eigenvalues",
                 {"re", "im"},
                 listJson(a.stability.eigenvalues,
                          [](const auto& z) -> Json {
                            return {{"re", z.real()}, {"im", z.imag()}};
                          })},
                {"critical_speeds",
                 {"speed", "direction", "amplification_factor", "separation_margin",
                  "required_separation_margin", "beyond_tables"},
                 criticalSpeedsJson(a)},
                {"parameters",
                 {"parameter", "value", "lost_at", "change", "loss", "frequency"},
                 a.parameter_margins ? parameterMarginsJson(a)["parameters"] : Json::array()}};
  if (a.sheet) {
    all.push_back(table(*a.sheet));
  }
  return all;
}

Json json(const SystemAnalysis& a) {
  Json json{
      {"model", a.model->name},
      {"coordinates", listJson(a.coordinates, [](const CoordinateInfo& c) { return c.name; })},
      {"time", a.moment.time},
      {"speed", a.speed},
      {"table_speeds", tableSpeedsJson(a.tables)},  // null: every speed
      {"beyond_tables", a.speed && !a.tables.covers(*a.speed)},
      {"state", stateJson(a, a.q, a.v)},
      {"acceleration", stateJson(a, a.acceleration)},
      {"energy",
       {{"kinetic", a.energies.kinetic},
        {"potential", a.energies.potential},
        {"jacobi", a.energies.jacobi},
        {"dissipated_power", a.energies.dissipated_power},
        {"input_power", a.energies.input_power}}}};
  if (a.sheet) {
    json["rotor"] = whirl_twin::json(*a.sheet);
  }
  json["equilibria"] =
      listJson(a.equilibria, [&](const Equilibrium& e) { return equilibriumJson(a, e); });
  json["dry_friction"] = listJson(a.dry_friction, [](const DryHold& hold) -> Json {
    return {{"place", hold.place},     {"level", hold.level}, {"unit", hold.unit},
            {"sliding", hold.sliding}, {"held", hold.held},   {"share", hold.share}};
  });
  json["sag"] = whirl_twin::json(a.sag);
  json["linearization"] = {{"about", stateJson(a, a.about, a.about_v)},
                           {"mass", matrixJson(a.linearization.mass)},
                           {"damping", matrixJson(a.linearization.damping)},
                           {"gyroscopic", matrixJson(a.linearization.gyroscopic)},
                           {"stiffness", matrixJson(a.linearization.stiffness)},
                           {"circulatory", matrixJson(a.linearization.circulatory)}};
  json["judged_about"] = a.periodic         ? "periodic_motion"
                         : a.of_mean_loads  ? "mean_motion"
                         : a.at_equilibrium ? "equilibrium"
                                            : "initial_state";
  json["periodic_motion"] = nullptr;
  if (a.periodic) {  // the state at time 0 and the multipliers over a period
    json["periodic_motion"] = {{"period", a.periodic->period},
                               {"state", stateJson(a, a.periodic->q, a.periodic->v)},
                               {"multipliers", listJson(a.periodic->multipliers, complexJson)}};
  }
  json["eigenvalues"] = listJson(a.stability.eigenvalues, [](const auto& z) -> Json {
    return {z.real() + 0.0, z.imag() + 0.0};
  });
  json["omitted"] = a.stability.omitted;
  json["natural_frequencies"] = arrayJson(a.reduced_stability.natural_frequencies);
  json["damping_ratios"] = arrayJson(a.reduced_stability.damping_ratios);
  json["characteristic_polynomial"] = arrayJson(a.stability.polynomial);
  json["routh"] = routhJson(a.stability.routh);
  if (a.cyclic.any()) {
    json["reduced"] = reducedJson(a);
  }
  json["uncertain_because"] = textOrNull(a.uncertain_because);
  const auto amplitude = a.decrement_amplitude.value_or(LinearDampingLimit{});
  json["margins"] = {
      {"decay_rate", a.reduced_stability.decay_rate},
      {"damping_ratio", a.reduced_stability.damping_ratio},
      {"log_decrement", a.reduced_stability.log_decrement},
      // Infinite, and so null here, where it is valid for any.
      {"log_decrement_amplitude", a.decrement_amplitude ? Json(amplitude.amplitude) : Json()},
      {"log_decrement_coordinate", textOrNull(amplitude.coordinate)},
      {"instability_speed", a.instability_speed}};
  json["critical_speeds"] = criticalSpeedsJson(a);
  json["critical_speeds_beyond_reduction"] = a.critical_speeds_beyond;
  json["critical_speeds_searched_to"] = a.critical_speeds_to;  // infinite, and so null: all
  json["cross_coupling_margin"] = nullptr;                     // of what is not a rotor
  if (a.cross_coupling) {  // a null stiffness: no cross-coupling makes it unstable
    json["cross_coupling_margin"] = {{"station", a.cross_coupling->station},
                                     {"stiffness", a.cross_coupling->stiffness}};
  }
  json["parameter_margins"] = parameterMarginsJson(a);
  json["spread_margin"] = a.spread_margin ? spreadMarginJson(*a.spread_margin) : Json();
  json["steady_speeds"] = listJson(a.steady_speeds, [&](const SteadySpeed& steady) -> Json {
    return {{"speed", steady.speed},
            {"torque", steady.torque},
            {"stable", steady.stable},
            {"beyond_tables", !a.tables.covers(steady.speed)}};
  });
  return json;
}

}  // namespace whirl_twin
