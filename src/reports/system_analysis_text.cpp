#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/stability_margins.h"
#include "reports/report_values.h"
#include "reports/system_analysis.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxCriticalParameters = 10;  // numbers that stability is lost by
constexpr const char* kPrime[] = {"", "'", "''"};
constexpr const char* kPer[] = {"", "/s", "/s^2"};

/// "22 coordinates, at most node_3_y'' = -9.8 m/s^2, ...": the largest of each unit.
std::string largestValues(const SystemAnalysis& a, const Eigen::VectorXd& x, int derivative) {
  if (x.isZero(0.0)) {
    return fmt::format("0 in all {} coordinates", a.coordinates.size());
  }
  std::vector<std::size_t> largest;  // of each unit
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    const auto size = [&](std::size_t k) { return std::fabs(x[static_cast<Eigen::Index>(k)]); };
    const auto alike = std::find_if(largest.begin(), largest.end(), [&](std::size_t k) {
      return a.coordinates[k].unit == a.coordinates[i].unit;
    });
    if (alike == largest.end()) {
      largest.push_back(i);
    } else if (size(i) > size(*alike)) {
      *alike = i;
    }
  }
  std::string out;
  for (const std::size_t i : largest) {
    out += fmt::format("{}{}{} = {:.6g} {}{}", out.empty() ? "largest " : ", ",
                       a.coordinates[i].name, kPrime[derivative], x[static_cast<Eigen::Index>(i)],
                       a.coordinates[i].unit, kPer[derivative]);
  }
  return out;
}

/// "x = 0 m, y = 1e-05 m": values of the coordinates, or of their `derivative`-th time derivative;
/// of many the largest.
std::string values(const SystemAnalysis& a, const Eigen::VectorXd& x, int derivative) {
  if (a.coordinates.size() > kFewCoordinates) {
    return largestValues(a, x, derivative);
  }
  std::string out;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const CoordinateInfo& c = a.coordinates[static_cast<std::size_t>(i)];
    out += fmt::format("{}{}{} = {:.6g} {}{}", i == 0 ? "" : ", ", c.name, kPrime[derivative], x[i],
                       c.unit, kPer[derivative]);
  }
  return out;
}

std::string startText(const SystemAnalysis& a, const ShownUnits& u) {
  std::string out = fmt::format("  at t = {:g} s", a.moment.time);
  if (a.speed) {
    out += fmt::format(", shaft at {:g} {} ({:.4g} {})", u.speed.in(*a.speed), u.speed.name,
                       u.besideSpeed().in(*a.speed), u.besideSpeed().name);
  }
  out += fmt::format("\n{}    position        {}\n",
                     a.speed ? beyondLine(a.tables, *a.speed, *a.speed) : std::string(),
                     values(a, a.q, 0));
  out += fmt::format("    velocity        {}\n", values(a, a.v, 1));
  out += fmt::format("    acceleration    {}\n", values(a, a.acceleration, 2));
  out += fmt::format("    energy          kinetic {:.6g} J, potential {:.6g} J, Jacobi {:.6g} J\n",
                     a.energies.kinetic, a.energies.potential, a.energies.jacobi);
  return out + fmt::format("    power           dissipated {:.6g} W, supplied {:.6g} W\n",
                           a.energies.dissipated_power, a.energies.input_power);
}

/// Which coordinates only turn or slide along, and what they keep.
std::string cyclicText(const SystemAnalysis& a) {
  const auto& conserved = a.cyclic.conserved;
  const auto& driven = a.cyclic.driven;
  if (a.dynamics->linear()) {
    const std::size_t count = conserved.size() + driven.size();
    return count == 0
               ? ""
               : fmt::format("  rigid-body modes: {}, left out of the stability below\n", count);
  }
  std::string out;
  for (const Eigen::Index i : conserved) {
    const CoordinateInfo& c = a.coordinates[static_cast<std::size_t>(i)];
    out += fmt::format("  cyclic: {}, its momentum {:.9g} {} is conserved\n", c.name, a.momenta[i],
                       c.isAngle() ? "N m s" : "N s");
  }
  const auto name_of = [&](Eigen::Index i) {
    return a.coordinates[static_cast<std::size_t>(i)].name;
  };
  return driven.empty()
             ? out
             : out + "  cyclic, driven or damped: " + joined(driven, name_of, ", ") + "\n";
}

/// ", phi' = 6 rad/s" of a steady motion; "" at rest.
std::string steadyRates(const SystemAnalysis& a, const Eigen::VectorXd& v) {
  std::string out;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const CoordinateInfo& c = a.coordinates[static_cast<std::size_t>(i)];
    out += v[i] == 0.0 ? "" : fmt::format(", {}' = {:.6g} {}/s", c.name, v[i], c.unit);
  }
  return out;
}

std::string dryFrictionText(const SystemAnalysis& a) {
  std::string out;
  for (const DryHold& hold : a.dry_friction) {
    const std::string level = hold.unit == "-" ? fmt::format("coefficient {:.6g}", hold.level)
                                               : fmt::format("{:.6g} {}", hold.level, hold.unit);
    out += fmt::format("  dry friction {}: {}, {}\n", hold.place, level,
                       hold.held ? fmt::format("sticks at the start with {:.3g} % of it",
                                               100.0 * std::fabs(hold.share))
                       : hold.sliding == 0.0 ? std::string("begins to slide at the start")
                                             : std::string("slides at the start"));
  }
  if (!out.empty()) {
    out += "    the linear verdict leaves out the friction of sticking contacts\n";
  }
  return out;
}

std::string equilibriaText(const SystemAnalysis& a, const ShownUnits& u) {
  const bool moving = a.cyclic.any() && !a.dynamics->linear();
  std::string out =
      a.speed  ? fmt::format("  equilibria at {:g} {}\n", u.speed.in(*a.speed), u.speed.name)
      : moving ? std::string("  steady motions\n")
               : std::string("  equilibria\n");
  for (const Equilibrium& e : a.equilibria) {
    out += fmt::format("    {}{}: {}\n", values(a, e.q, 0), steadyRates(a, e.v),
                       verdictText(e.stability.routh.verdict));
  }
  if (!a.equilibria.empty()) {
    return out;
  }
  return out + (a.dynamics->linear()
                    ? "    none: a constant load acts along a coordinate without stiffness\n"
                    : "    none found\n");
}

/// Else there is no motion that modes and stability could be those of.
bool isJudged(const SystemAnalysis& a) {
  return a.at_equilibrium || a.dynamics->linear();
}

std::string modesText(const SystemAnalysis& a, const ShownUnits& u) {
  const ShownUnit beside = u.besideFrequency();
  const Stability& s = a.reduced_stability;
  const std::size_t count = s.natural_frequencies.size();
  if (!isJudged(a)) {
    return "";
  }
  const bool few = a.coordinates.size() <= kFewCoordinates;
  const std::size_t shown = few || s.omitted > 0 ? count : std::min(count, kLowestModes);
  std::string out = fmt::format("  modes {:>15} {:>11}   damping ratio   log decrement\n",
                                u.frequency.name, beside.name);
  for (std::size_t i = 0; i < shown; ++i) {
    out +=
        fmt::format("    {:<6} {:>12.6g} {:>11.6g} {:>15.6g} {:>15}\n", i + 1,
                    u.frequency.in(s.natural_frequencies[i]), beside.in(s.natural_frequencies[i]),
                    s.damping_ratios[i], defined(logDecrement(s.damping_ratios[i]), "-"));
  }
  if (shown < count) {
    out += fmt::format("    and {} more (--json)\n", count - shown);
  }
  if (s.omitted > 0) {
    out += fmt::format("    {} eigenvalues of higher modes are omitted (--modes N or all)\n",
                       s.omitted);
  }
  if (!few) {
    return out;
  }
  out += "  eigenvalues, 1/s\n";
  return out + joined(a.stability.eigenvalues, [](const auto& root) {
           return fmt::format("    {:>14.6g} {:+.6g}i\n", root.real(), root.imag());
         });
}

/// Up to which amplitude the decrement is that of small motions.
std::string decrementText(const SystemAnalysis& a) {
  if (!a.decrement_amplitude) {
    return "";
  }
  const LinearDampingLimit& of = *a.decrement_amplitude;
  if (std::isinf(of.amplitude)) {
    return "      valid for any amplitude\n";
  }
  const auto moving =
      std::find_if(a.coordinates.begin(), a.coordinates.end(),
                   [&](const CoordinateInfo& c) { return c.name == of.coordinate; });
  return fmt::format("      valid for amplitudes up to {:.4g} {} of {}\n", of.amplitude,
                     moving == a.coordinates.end() ? "m" : moving->unit, of.coordinate);
}

std::string stabilityText(const SystemAnalysis& a, const ShownUnits& u) {
  const Stability& s = a.reduced_stability;
  if (!isJudged(a)) {
    return fmt::format("  stability: uncertain: {}\n", a.uncertain_because);
  }
  std::string out = a.uncertain_because.empty()
                        ? fmt::format("  stability: {}\n", verdictText(s.routh.verdict))
                        : fmt::format("  stability: uncertain: {}\n", a.uncertain_because);
  if (a.of_mean_loads) {
    out += "    of the motion under mean loads: alternating loads are left out\n";
  }
  if (a.periodic) {
    out += fmt::format("    of the periodic motion about the operating point, period {:.6g} s\n",
                       a.periodic->period);
    for (const std::complex<double>& multiplier : a.periodic->multipliers) {
      out += fmt::format("    multiplier      {:.9g} {:+.9g}i, modulus {:.9g}\n", multiplier.real(),
                         multiplier.imag(), std::abs(multiplier));
    }
    return out + marginsText(s.decay_rate, s.damping_ratio, s.log_decrement);
  }
  out += s.eigenvalues.empty() ? std::string("    polynomial      none: no mode remains\n")
         : s.polynomial.empty()
             ? fmt::format("    polynomial      left out beyond {} coordinates\n",
                           kMaxExactCoordinates)
             : fmt::format("    polynomial      {:.6g}\n", fmt::join(s.polynomial, "  "));
  if (s.omitted > 0) {
    out += s.routh.verdict == Verdict::kUncertain
               ? "    omitted         not proved to be stable: --modes all computes each\n"
               : "    omitted         not included in the values below\n";
  }
  out += routhText(s.routh);
  out += marginsText(s.decay_rate, s.damping_ratio, s.log_decrement);
  out += decrementText(a);
  if (a.speed) {
    out += fmt::format("    unstable above  {}\n",
                       a.instability_speed
                           ? fmt::format("{:.6g} {}{}", u.speed.in(*a.instability_speed),
                                         u.speed.name, beyondMark(a.tables, *a.instability_speed))
                           : std::string("no speed found"));
  }
  return out;
}

std::string criticalSpeedsText(const SystemAnalysis& a, const ShownUnits& u) {
  const ShownUnit beside = u.besideSpeed();
  std::string beyond =
      a.critical_speeds_beyond == 0
          ? ""
          : fmt::format(
                "    {} more left out: the reduced-order rotor is valid only up to {:g} {}\n",
                a.critical_speeds_beyond, u.speed.in(a.highest_speed), u.speed.name);
  if (std::isfinite(a.critical_speeds_to)) {
    beyond += fmt::format("    searched up to {:.6g} {}\n", u.speed.in(a.critical_speeds_to),
                          u.speed.name);
  }
  if (a.critical_speeds.empty()) {
    return a.dynamics->isRotor() ? "  critical speeds: none\n" + beyond : "";
  }
  std::string out = fmt::format(
      "  critical speeds seen from {:g} {}\n"
      "{:>16} {:>11}  direction   amplification      margin    required\n",
      u.speed.in(*a.speed), u.speed.name, u.speed.name, beside.name);
  for (const auto& c : a.critical_speeds) {
    const bool too_near = c.separation_margin < c.required_separation_margin;
    out += fmt::format(
        "    {:>12.6g} {:>11.6g}  {:<9} {:>15} {:>9} % {:>9.4g} %{}{}\n", u.speed.in(c.speed),
        beside.in(c.speed), c.direction,
        std::isinf(c.amplification_factor) ? "undamped" : defined(c.amplification_factor, "-"),
        defined(c.separation_margin, "-"), c.required_separation_margin,
        too_near ? "  too near" : "", beyondMark(a.tables, c.speed));
  }
  out += joined(separationConditions(), [](const auto& one) { return "      " + one + "\n"; });
  if (std::any_of(a.critical_speeds.begin(), a.critical_speeds.end(),
                  [&](const auto& c) { return !a.tables.covers(c.speed); })) {
    out += "    some " + beyondText(a.tables) + "\n";
  }
  return out + beyond;
}

std::string crossCouplingText(const SystemAnalysis& a, const ShownUnits& u) {
  if (!a.cross_coupling) {
    return "";
  }
  return fmt::format(
      "  cross-coupling margin at {}: {}\n", a.cross_coupling->station,
      a.cross_coupling->stiffness
          ? fmt::format("{:.6g} {}", u.stiffness.in(*a.cross_coupling->stiffness), u.stiffness.name)
          : std::string("none found, all forward modes stay stable"));
}

/// "10 N s/m"; "0.5" of a number without a unit.
std::string quantity(double value, const std::string& unit) {
  return fmt::format("{:.6g}{}", value, unit == "-" ? "" : " " + unit);
}

std::string lossText(const SystemAnalysis& a, const InstabilityPoint& loss) {
  switch (loss.kind) {
    case LossKind::kFlutter:
      return fmt::format("{} at {:.6g} rad/s", lossName(loss.kind, *a.dynamics), loss.frequency);
    case LossKind::kNoMotion:
      return "no such motion beyond";
    default:
      return "divergence";
  }
}

std::string parameterMarginsText(const SystemAnalysis& a) {
  if (!a.parameter_margins) {
    return a.at_equilibrium && a.reduced_stability.bounded()
               ? fmt::format(
                     "  instability points of the parameters: not computed for {} coordinates "
                     "(--parameters)\n",
                     a.coordinates.size())
               : "";
  }
  const std::vector<ParameterMargin>& margins = *a.parameter_margins;
  const MarginResolution resolution = marginResolution(*a.dynamics);
  if (margins.empty()) {
    return fmt::format(
        "  no parameter, changed alone up to {:g} times in increments of {:g} %, causes "
        "instability\n",
        resolution.reach, 100.0 * resolution.stride);
  }
  std::string out = fmt::format(
      "  instability points of single parameters, nearest first (up to {:g} times, increments of "
      "{:g} "
      "%)\n",
      resolution.reach, 100.0 * resolution.stride);
  std::size_t shown = 0;
  for (const ParameterMargin& margin : margins) {
    if (++shown > kMaxCriticalParameters) {
      return out +
             fmt::format("    and {} more (--json)\n", margins.size() - kMaxCriticalParameters);
    }
    out += fmt::format("    {:<24} {:>10}  at {:<18} now {:<18} {}\n", margin.parameter,
                       std::isnan(margin.change) ? std::string("from 0")
                                                 : fmt::format("{:+.4g} %", 100.0 * margin.change),
                       quantity(margin.loss.value, margin.unit),
                       quantity(margin.value, margin.unit), lossText(a, margin.loss));
  }
  return out;
}

std::string spreadMarginText(const SystemAnalysis& a) {
  if (!a.spread_margin) {
    return "";
  }
  const RobustStabilityMargin& margin = *a.spread_margin;
  return fmt::format(
      "  {} of {} samples within the spread are unstable, the lowest decay rate is {:.4g} 1/s{}\n",
      margin.beyond(0.0), margin.decay_rates.size(), margin.lowest_decay_rate,
      margin.stable_throughout ? "; robustly stable (Kharitonov)" : "");
}

std::string steadySpeedsText(const SystemAnalysis& a, const ShownUnits& u) {
  std::string out = a.steady_speeds.empty() ? "" : "  steady speeds with its motor\n";
  for (const SteadySpeed& steady : a.steady_speeds) {
    out += fmt::format("    {:.6g} {} ({:.4g} {}), torque {:.4g} N m: {}{}\n",
                       u.speed.in(steady.speed), u.speed.name, u.besideSpeed().in(steady.speed),
                       u.besideSpeed().name, steady.torque, steady.stable ? "stable" : "unstable",
                       beyondMark(a.tables, steady.speed));
  }
  return out;
}

}  // namespace

std::string text(const SystemAnalysis& a, const ShownUnits& u) {
  std::string out = fmt::format("{}: {}, {}\n", a.name, a.model->name, a.model->summary);
  out += startText(a, u) + (a.sheet ? text(*a.sheet) : "") + cyclicText(a) + dryFrictionText(a) +
         equilibriaText(a, u);
  out += fmt::format("  linearized about {}: {}{}\n",
                     a.at_equilibrium ? "the operating point" : "the initial state",
                     values(a, a.about, 0),
                     a.at_equilibrium ? steadyRates(a, a.about_v) : ", " + values(a, a.about_v, 1));
  out += a.sag ? fmt::format("  sag             {}\n", text(*a.sag, u)) : "";
  out += a.coordinates.size() <= kFewCoordinates
             ? matrixText("mass", a.linearization.mass) +
                   matrixText("damping", a.linearization.damping) +
                   matrixText("gyroscopic", a.linearization.gyroscopic) +
                   matrixText("stiffness", a.linearization.stiffness) +
                   matrixText("circulatory", a.linearization.circulatory)
             : "    its matrices    --json\n";
  return out + modesText(a, u) + stabilityText(a, u) + criticalSpeedsText(a, u) +
         crossCouplingText(a, u) + parameterMarginsText(a) + spreadMarginText(a) +
         steadySpeedsText(a, u);
}

}  // namespace whirl_twin
