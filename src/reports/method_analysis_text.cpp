#include <fmt/format.h>

#include "reports/matrix_text.h"
#include "reports/method_analysis.h"

namespace whirl_twin {

namespace {

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
    out += fmt::format("    exact {:.8g}; no lower bound: {}\n", b.exact[0], b.refusal);
  }
  return out + "  undamped mode shapes, in columns\n" + smallMatrixText("shapes", b.shapes);
}

std::string responseText(const SteadyResponse& r, const SystemAnalysis& a) {
  std::string out = fmt::format("  steady response to the load at {:g} rad/s\n", r.frequency);
  if (!r.refusal.empty()) {
    return out + fmt::format("    none: {}\n", r.refusal);
  }
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    out += fmt::format("    {:<15} {:.6g} {}, {:.4g} rad behind cos\n", a.coordinates[i].name,
                       r.amplitude[place], a.coordinates[i].unit, r.lag[place]);
  }
  return out;
}

}  // namespace

std::string text(const MethodAnalysis& m, const SystemAnalysis& a) {
  std::string out;
  if (m.conservative_form) {
    out += stiffnessText(m);
  }
  if (m.bounds) {
    out += boundsText(*m.bounds);
  }
  for (const SteadyResponse& r : m.responses) {
    out += responseText(r, a);
  }
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

}  // namespace whirl_twin
