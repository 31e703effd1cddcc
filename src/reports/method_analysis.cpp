#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "algebra/dense.h"
#include "analysis/approximate_frequencies.h"
#include "analysis/frequency_response.h"
#include "analysis/natural_modes.h"
#include "analysis/routh_table.h"
#include "analysis/validity.h"
#include "messages/input_error.h"
#include "reports/report_values.h"
#include "reports/system_analysis.h"

namespace whirl_twin {

namespace {

std::string stiffnessForm(Definiteness form) {
  switch (form) {
    case Definiteness::kPositiveDefinite:
      return "positive definite";
    case Definiteness::kPositiveSemidefinite:
      return "positive semidefinite";
    case Definiteness::kIndefinite:
      break;
  }
  return "indefinite";
}

/// Nothing where the second shape is linearly dependent.
std::optional<double> ritzFrequency(const Linearization& l, const Eigen::MatrixXd& shapes) {
  try {
    return ritzModes(l.mass, l.stiffness, shapes).assumed.frequencies[0];
  } catch (const InputError&) {
    return std::nullopt;
  }
}

FrequencyBounds frequencyBounds(const Linearization& l, bool definite) {
  FrequencyBounds b;
  const NaturalModes modes = naturalModes(l.mass, l.stiffness);
  b.exact = modes.frequencies;
  b.shapes = modes.shapes;
  for (Eigen::Index i = 0; i < b.shapes.cols(); ++i) {
    Eigen::Index largest = 0;
    b.shapes.col(i).cwiseAbs().maxCoeff(&largest);
    b.shapes.col(i) /= b.shapes(largest, i);
  }
  if (!definite) {
    try {
      static_cast<void>(dunkerleyBound(l.mass, l.stiffness));
    } catch (const RunFailure& error) {
      b.inputError = error.what();
    }
    return b;
  }
  b.dunkerley = dunkerleyBound(l.mass, l.stiffness).frequency;
  // Its own inertia as a load, each coordinate pushed the way it goes in the lowest mode.
  const Eigen::VectorXd push = b.shapes.col(0).cwiseSign();
  const Eigen::VectorXd deflection = staticDeflection(l.stiffness, l.mass * push);
  b.rayleigh = rayleighFrequency(l.mass, l.stiffness, deflection);
  if (b.exact.size() > 2) {
    Eigen::MatrixXd shapes(deflection.size(), 2);
    shapes.col(0) = deflection;
    shapes.col(1) = staticDeflection(l.stiffness, l.mass * deflection);
    b.ritz = ritzFrequency(l, shapes);
  }
  const auto iterated = matrixIteration(l.mass, l.stiffness, 1, deflection);
  if (!iterated.empty() && iterated.front().converged) {
    b.iterations = iterated.front().history.size();
    b.iterated = iterated.front().frequency;
  }
  return b;
}

/// The frequencies [rad/s] of the loads that the scene gives the system.
std::vector<double> loadFrequencies(const SystemSpec& spec) {
  constexpr char kEnding[] = "_frequency";
  constexpr std::size_t kLength = sizeof kEnding - 1;
  std::vector<double> all;
  const auto add = [&](double frequency) {
    if (frequency > 0.0 && std::find(all.begin(), all.end(), frequency) == all.end()) {
      all.push_back(frequency);
    }
  };
  for (const auto& [parameter, value] : spec.parameters) {
    if (parameter.size() > kLength &&
        parameter.compare(parameter.size() - kLength, kLength, kEnding) == 0) {
      add(value);
    }
  }
  for (const auto& [setting, rows] : spec.settings.tables) {
    for (const TableRow& row : rows) {
      const auto found = row.numbers.find("frequency");
      add(found == row.numbers.end() ? 0.0 : found->second);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The load's phasors [n x frequencies], F = Re(phasor e^(i W t)), fitted to the force on the
/// system held at the operating point.
Eigen::MatrixXcd loadPhasors(const Dynamics& dynamics, const SystemAnalysis& a,
                             const std::vector<double>& frequencies) {
  const auto count = static_cast<Eigen::Index>(frequencies.size());
  const Eigen::Index samples = 4 * (2 * count + 1);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(a.about.size());
  Eigen::MatrixXd basis(samples, 2 * count + 1);
  Eigen::MatrixXd force(samples, a.about.size());
  for (Eigen::Index i = 0; i < samples; ++i) {
    // Times that share no period with the loads.
    const double t = 2.4 * std::sqrt(static_cast<double>(i) + 0.5) / frequencies.front();
    basis(i, 0) = 1.0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const double phase = frequencies[static_cast<std::size_t>(k)] * t;
      basis(i, 2 * k + 1) = std::cos(phase);
      basis(i, 2 * k + 2) = -std::sin(phase);
    }
    force.row(i) = dynamics.residualForce(a.about, rest, {t, 0.0, 0.0, 0.0});
  }
  const Eigen::MatrixXd fitted = PivotedQr(basis).solve(force);
  Eigen::MatrixXcd phasors(a.about.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    phasors.col(k).real() = fitted.row(2 * k + 1);
    phasors.col(k).imag() = fitted.row(2 * k + 2);
  }
  return phasors;
}

std::vector<SteadyResponse> steadyResponses(const BuiltSystem& system, const SystemAnalysis& a) {
  const std::vector<double> frequencies = loadFrequencies(system.spec);
  std::vector<SteadyResponse> all;
  if (frequencies.empty() || !a.at_equilibrium || a.speed) {
    return all;
  }
  const Eigen::MatrixXcd phasors = loadPhasors(*system.dynamics, a, frequencies);
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    SteadyResponse response;
    response.frequency = frequencies[k];
    const Eigen::VectorXcd force = phasors.col(static_cast<Eigen::Index>(k));
    if (force.norm() <= 1.0e-12 * phasors.norm()) {
      continue;  // a frequency whose amplitude is zero
    }
    try {
      const Eigen::VectorXcd x = steadyResponse(a.linearization, force, frequencies[k]);
      response.amplitude = x.cwiseAbs();
      response.lag = -x.array().arg();
    } catch (const RunFailure& error) {
      response.inputError = error.what();
    }
    all.push_back(response);
  }
  return all;
}

/// A matrix of few coordinates; of many there is --json.
std::string smallMatrixText(const char* title, const Eigen::MatrixXd& m) {
  return m.rows() <= kFewCoordinates ? matrixText(title, m)
                                     : fmt::format("    {:<15} --json\n", title);
}

std::string stiffnessText(const MethodAnalysis& m) {
  if (m.flexibility) {
    return fmt::format("  stiffness is {}; influence coefficients\n", m.stiffness_form) +
           smallMatrixText("flexibility", *m.flexibility);
  }
  if (m.rigid_body_modes.cols() == 0) {
    return fmt::format("  stiffness is {}\n", m.stiffness_form);
  }
  return fmt::format("  stiffness is {}: rigid-body modes, in columns\n", m.stiffness_form) +
         smallMatrixText("modes", m.rigid_body_modes);
}

std::string boundsText(const FrequencyBounds& b) {
  std::string out = "  lowest natural frequency, rad/s\n";
  if (b.dunkerley) {
    out +=
        fmt::format("    Dunkerley {:.8g} <= exact {:.8g} <= {}Rayleigh {:.8g}\n", *b.dunkerley,
                    b.exact[0], b.ritz ? fmt::format("Ritz {:.8g} <= ", *b.ritz) : "", *b.rayleigh);
    out +=
        "    Rayleigh: the deflection under its own inertia; Ritz: that and its own deflection\n";
    out += fmt::format("    matrix iteration from that deflection: {:.8g} after {} steps\n",
                       b.iterated, b.iterations);
  } else {
    out += fmt::format("    exact {:.8g}; no lower bound: {}\n", b.exact[0], b.inputError);
  }
  return out + "  undamped mode shapes, in columns\n" + smallMatrixText("shapes", b.shapes);
}

std::string responseText(const SteadyResponse& r, const SystemAnalysis& a) {
  std::string out = fmt::format("  steady response to the load at {:g} rad/s\n", r.frequency);
  if (!r.inputError.empty()) {
    return out + fmt::format("    none: {}\n", r.inputError);
  }
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    out += fmt::format("    {:<15} {:.6g} {}, {:.4g} rad behind cos\n", a.coordinates[i].name,
                       r.amplitude[place], a.coordinates[i].unit, r.lag[place]);
  }
  return out;
}

Json boundsJson(const FrequencyBounds& b) {
  Json json{{"exact", b.exact[0]}, {"dunkerley_lower", b.dunkerley}};
  if (!b.dunkerley) {
    json["dunkerley_refusal"] = b.inputError;
  }
  json["rayleigh_upper"] = b.rayleigh;
  json["ritz_upper"] = b.ritz;
  if (b.iterations > 0) {
    json["matrix_iteration"] = {{"frequency", b.iterated}, {"steps", b.iterations}};
  }
  return json;
}

Json responseJson(const SteadyResponse& r, const SystemAnalysis& a) {
  Json json;
  json["frequency"] = r.frequency;
  if (!r.inputError.empty()) {
    json["refusal"] = r.inputError;
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

MethodAnalysis analyzeMethods(const BuiltSystem& system, const SystemAnalysis& a) {
  const Dynamics& dynamics = *system.dynamics;
  MethodAnalysis m;
  const Linearization& l = a.linearization;
  const auto degree = static_cast<int>(a.reduced_stability.polynomial.size()) - 1;
  if (degree >= kMinConditionDegree && degree <= kMaxConditionDegree) {
    m.routh_conditions = routhConditions(a.reduced_stability.polynomial);
  }
  m.reactions = dynamics.reactions(a.q, a.v, a.acceleration, a.moment);
  m.conditions = validity(dynamics, a.q, a.v, a.moment);
  m.responses = steadyResponses(system, a);
  m.virtual_work = dynamics.residualForce(a.q, Eigen::VectorXd::Zero(a.q.size()), a.moment);
  m.conservative_form = a.at_equilibrium && !a.speed && l.gyroscopic.isZero(0.0) &&
                        l.circulatory.isZero(0.0) && a.about_v.isZero(0.0);
  if (!m.conservative_form) {
    return m;
  }
  const Definiteness form = definiteness(l.stiffness, "stiffness");
  m.stiffness_form = stiffnessForm(form);
  if (form == Definiteness::kIndefinite) {
    return m;
  }
  const bool definite = form == Definiteness::kPositiveDefinite;
  if (definite) {
    m.flexibility = influenceCoefficients(l.stiffness);
  } else {
    m.rigid_body_modes = rigidBodyModes(l.stiffness);
  }
  m.bounds = frequencyBounds(l, definite);
  return m;
}

std::string text(const MethodAnalysis& m, const SystemAnalysis& a) {
  std::string out;
  if (m.conservative_form) {
    out += stiffnessText(m);
  }
  if (m.bounds) {
    out += boundsText(*m.bounds);
  }
  out += joined(m.responses, [&](const SteadyResponse& r) { return responseText(r, a); });
  if (!m.routh_conditions.empty()) {
    out += "  Routh's conditions for decay\n";
    for (const RouthCondition& c : m.routh_conditions) {
      out += fmt::format("    {:<15} {:.6g} > {:.6g}{}\n", c.name, c.left, c.right,
                         c.holds ? "" : "  violated");
    }
  }
  if (m.virtual_work.size() > kFewCoordinates) {
    out += "  generalized forces, at rest in that position: --json\n";
  } else if (m.virtual_work.size() > 0) {
    out += "  generalized forces, at rest in that position\n";
    for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
      out += fmt::format("    {:<15} {:.6g} {}\n", a.coordinates[i].name,
                         m.virtual_work[static_cast<Eigen::Index>(i)] + 0.0,
                         a.coordinates[i].isAngle() ? "N m" : "N");
    }
  }
  if (!m.reactions.empty()) {
    out += fmt::format("  reactions at t = {:g} s\n", a.moment.time);
    for (const Reaction& r : m.reactions) {
      out += fmt::format("    {:<15} {:.6g} {}\n", r.name, r.value, r.unit);
    }
  }
  if (!m.conditions.empty()) {
    out += fmt::format("  conditions of the equations at t = {:g} s\n", a.moment.time);
    for (const Condition& c : m.conditions) {
      out += fmt::format("    {:<15} {:.6g} {} > 0; else {}\n", c.name, c.margin, c.unit, c.broken);
    }
  }
  return out;
}

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
