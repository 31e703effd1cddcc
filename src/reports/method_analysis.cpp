#include "reports/method_analysis.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "algebra/dense.h"
#include "analysis/approximate_frequencies.h"
#include "analysis/frequency_response.h"
#include "analysis/natural_modes.h"
#include "analysis/routh_table.h"
#include "analysis/validity.h"
#include "messages/refusal.h"

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

/// Nothing where the second shape says nothing new.
std::optional<double> ritzFrequency(const Linearization& l, const Eigen::MatrixXd& shapes) {
  try {
    return ritzModes(l.mass, l.stiffness, shapes).assumed.frequencies[0];
  } catch (const Refusal&) {
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
      b.refusal = error.what();
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
    force.row(i) = dynamics.unbalancedForce(a.about, rest, {t, 0.0, 0.0, 0.0});
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
      response.refusal = error.what();
    }
    all.push_back(response);
  }
  return all;
}

}  // namespace

MethodAnalysis analyzeMethods(const BuiltSystem& system, const SystemAnalysis& a) {
  const Dynamics& dynamics = *system.dynamics;
  MethodAnalysis m;
  const Linearization& l = a.linearization;
  const auto degree = static_cast<int>(a.reduced_stability.polynomial.size()) - 1;
  if (degree >= kLeastConditionDegree && degree <= kMostConditionDegree) {
    m.routh_conditions = routhConditions(a.reduced_stability.polynomial);
  }
  m.reactions = dynamics.reactions(a.q, a.v, a.acceleration, a.moment);
  m.conditions = validity(dynamics, a.q, a.v, a.moment);
  m.responses = steadyResponses(system, a);
  m.virtual_work = dynamics.unbalancedForce(a.q, Eigen::VectorXd::Zero(a.q.size()), a.moment);
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

}  // namespace whirl_twin
