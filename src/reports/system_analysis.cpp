#include "reports/system_analysis.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "algebra/dense.h"
#include "analysis/critical_speeds.h"
#include "analysis/instability_speed.h"
#include "analysis/separation_margin.h"
#include "messages/refusal.h"
#include "scene/driven_dynamics.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

namespace {

Eigen::VectorXd vector(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
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
  if (!a.at_equilibrium && isJudgedOnlyAtRest(*a.dynamics)) {
    return "no equilibrium was found at this speed";
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
  if (a.at_equilibrium || !isJudgedOnlyAtRest(dynamics)) {
    a.instability_speed = instabilitySpeed(dynamics, a.about, shaft.speed);
  } else {
    a.stability = a.reduced_stability = unjudged();
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
  const bool holds =
      a.at_equilibrium && (!isJudgedOnlyAtRest(dynamics) || a.reduced_stability.bounded());
  if (holds && (search == ParameterSearch::kOfAll || isQuickToSearch(system))) {
    a.parameter_margins = parameterMargins(system, {a.about, a.about_v}, shaft.speed);
    a.decrement_amplitude = decrementAmplitude(dynamics, {a.about, a.about_v}, shaft.speed);
  }
  if (holds) {
    a.spread_margin = spreadMargin(system, {a.about, a.about_v}, shaft.speed);
  }
  return a;
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

}  // namespace whirl_twin
