#include <fmt/format.h>

#include "tools/system_analysis.h"
#include "tools/verdict_text.h"

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// "x = 0 m, y = 1e-05 m": values of the coordinates, or of their `derivative`-th time derivative.
std::string values(const ModelInfo& model, const Eigen::VectorXd& x, int derivative) {
  static constexpr const char* kPrime[] = {"", "'", "''"};
  static constexpr const char* kPer[] = {"", "/s", "/s^2"};
  std::string out;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    out += fmt::format("{}{}{} = {:.6g} {}{}", i == 0 ? "" : ", ", model.coordinates[i].name,
                       kPrime[derivative], x[static_cast<Eigen::Index>(i)],
                       model.coordinates[i].unit, kPer[derivative]);
  }
  return out;
}

std::string matrixText(const char* title, const Eigen::MatrixXd& m) {
  if (m.isZero(0.0)) {
    return fmt::format("    {:<15} 0\n", title);
  }
  std::string out;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    out += fmt::format("    {:<15}", i == 0 ? title : "");
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      out += fmt::format(" {:>13.6g}", m(i, j));
    }
    out += "\n";
  }
  return out;
}

std::string startText(const SystemAnalysis& a) {
  std::string out = fmt::format("  at the start, t = {:g} s", a.moment.time);
  if (a.speed) {
    out += fmt::format(", shaft at {:g} rad/s ({:.4g} rpm)", *a.speed, *a.speed * 30.0 / kPi);
  }
  out += fmt::format("\n    position        {}\n", values(*a.model, a.q, 0));
  out += fmt::format("    velocity        {}\n", values(*a.model, a.v, 1));
  out += fmt::format("    acceleration    {}\n", values(*a.model, a.acceleration, 2));
  out += fmt::format("    energy          kinetic {:.6g} J, potential {:.6g} J, Jacobi {:.6g} J\n",
                     a.energies.kinetic, a.energies.potential, a.energies.jacobi);
  return out + fmt::format("    power           dissipated {:.6g} W, put in {:.6g} W\n",
                           a.energies.dissipated_power, a.energies.input_power);
}

std::string equilibriaText(const SystemAnalysis& a) {
  std::string out = a.speed ? fmt::format("  equilibria at {:g} rad/s\n", *a.speed)
                            : std::string("  equilibria\n");
  for (const Equilibrium& e : a.equilibria) {
    out += fmt::format("    {}: {}\n", values(*a.model, e.q, 0),
                       verdictText(e.stability.routh.verdict));
  }
  return a.equilibria.empty() ? out + "    none found\n" : out;
}

std::string modesText(const SystemAnalysis& a) {
  const Stability& s = a.stability;
  std::string out = "  modes           rad/s          Hz   damping ratio\n";
  for (std::size_t i = 0; i < s.natural_frequencies.size(); ++i) {
    out += fmt::format("    {:<6} {:>12.6g} {:>11.6g} {:>15.6g}\n", i + 1, s.natural_frequencies[i],
                       s.natural_frequencies[i] / (2.0 * kPi), s.damping_ratios[i]);
  }
  out += "  eigenvalues, 1/s\n";
  for (const auto& root : s.eigenvalues) {
    out += fmt::format("    {:>14.6g} {:+.6g}i\n", root.real(), root.imag());
  }
  return out;
}

std::string stabilityText(const SystemAnalysis& a) {
  const Stability& s = a.stability;
  std::string out = fmt::format("  stability: {}\n", verdictText(s.routh.verdict));
  out += fmt::format("    polynomial      {:.6g}\n", fmt::join(s.polynomial, "  "));
  out += routhText(s.routh);
  out += marginsText(s.decay_rate, s.damping_ratio, s.log_decrement);
  if (a.speed) {
    out += fmt::format("    unstable above  {}\n",
                       a.instability_speed ? fmt::format("{:.6g} rad/s", *a.instability_speed)
                                           : std::string("no speed found"));
  }
  return out;
}

std::string criticalSpeedsText(const SystemAnalysis& a) {
  if (a.critical_speeds.empty()) {
    return a.model->rotor ? "  critical speeds: none\n" : "";
  }
  std::string out = fmt::format(
      "  critical speeds seen from {:g} rad/s\n"
      "           rad/s         rpm  direction   amplification      margin    required\n",
      *a.speed);
  for (const auto& c : a.critical_speeds) {
    const bool too_near = c.separation_margin < c.required_separation_margin;
    out += fmt::format("    {:>12.6g} {:>11.6g}  {:<9} {:>15} {:>9} % {:>9.4g} %{}\n", c.speed,
                       c.speed * 30.0 / kPi, c.direction, defined(c.amplification_factor, "-"),
                       defined(c.separation_margin, "-"), c.required_separation_margin,
                       too_near ? "  too near" : "");
  }
  return out;
}

}  // namespace

std::string text(const SystemAnalysis& a) {
  std::string out = fmt::format("{}: {}, {}\n", a.name, a.model->name, a.model->summary);
  out += startText(a) + equilibriaText(a);
  out += fmt::format("  linearized about {}: {}{}\n",
                     a.at_equilibrium ? "the operating point" : "the initial state",
                     values(*a.model, a.about, 0),
                     a.at_equilibrium ? "" : ", " + values(*a.model, a.about_v, 1));
  out += matrixText("mass", a.linearization.mass) + matrixText("damping", a.linearization.damping) +
         matrixText("gyroscopic", a.linearization.gyroscopic) +
         matrixText("stiffness", a.linearization.stiffness) +
         matrixText("circulatory", a.linearization.circulatory);
  return out + modesText(a) + stabilityText(a) + criticalSpeedsText(a);
}

}  // namespace whirl_twin
