#include "requests/field_balancing.h"

#include <fmt/format.h>

#include <cmath>

#include "algebra/constants.h"
#include "messages/names.h"
#include "messages/units.h"
#include "reports/report_values.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

/// [deg]
double degrees(double angle) {
  return std::remainder(angle, kTwoPi) / kDegree + 0.0;
}

struct FieldBalancing {
  const BalancingJob& job;
  Influence influence;
  BalanceCorrection needed;   // the masses that cancel the unbalance
  BalanceCorrection applied;  // those within the limits
  std::optional<CorrectionSpread> spread;

  explicit FieldBalancing(const BalancingJob& of)
      : job(of),
        influence(of.trials.empty() ? Influence{of.known, {}, std::nullopt}
                                    : influenceOfPlanes(of.initial, of.trials, of.reflection)),
        needed(balance(influence.coefficients, of.initial, of.weights)),
        applied(balanceWithin(influence.coefficients, of.initial, of.weights, of.limits)),
        spread(correctionSpread(influence, of.weights, needed, of.deviation)) {}

  Eigen::Index planes() const { return needed.mass_radius.size(); }
  const std::string& plane(Eigen::Index k) const { return job.planes[static_cast<std::size_t>(k)]; }
  bool limited() const { return applied.mass_radius != needed.mass_radius; }
  double angle(const Complex& mass) const {
    return degrees(std::arg(mass) * (job.against ? -1 : 1));
  }
  double phase(const Complex& reading) const {
    return degrees(job.lead ? std::arg(reading) : -std::arg(reading));
  }
  const char* phaseName() const { return job.lead ? "lead" : "lag"; }
  double shownMass(double si) const { return si * unitScale("kg m", job.shown_mass_unit); }
  double shownAmplitude(double si) const {
    return job.unit.empty() ? si : si * unitScale(job.unit, job.shown_unit);
  }

  /// Half-width of the 95 % interval of a component [kg m]; NaN where it is unknown, as of masses
  /// that a limit changes.
  double uncertainty(Eigen::Index k) const {
    return spread ? spread->within95 * spread->deviation[k] : kNaN;
  }
  /// [deg], of the angle.
  double angleUncertainty(Eigen::Index k) const {
    return spread ? spread->within95 *
                        std::atan2(spread->deviation[k], std::abs(needed.mass_radius[k])) / kDegree
                  : kNaN;
  }
  std::vector<PartOfMass> parts(Eigen::Index k) const {
    const std::vector<double>& places = job.places[static_cast<std::size_t>(k)];
    return places.empty() || applied.mass_radius[k] == 0.0
               ? std::vector<PartOfMass>{}
               : partsAtPlaces(applied.mass_radius[k], places);
  }
};

// --- Tolerance -----------------------------------------------------------------------------------

/// Of one plane.
struct PlaneTolerance {
  double permitted = 0.0, unbalance = 0.0, remaining = 0.0;  // [kg m]
  double grade = 0.0;                                        // [mm/s]
  std::string now, after;
};

std::string verdict(double unbalance, double uncertainty, double permitted) {
  return unbalance + uncertainty <= permitted  ? "within"
         : unbalance - uncertainty > permitted ? "exceeded"
                                               : "uncertain";
}

PlaneTolerance toleranceOf(const FieldBalancing& of, Eigen::Index k) {
  const BalanceTolerance& t = *of.job.tolerance;
  PlaneTolerance plane;
  plane.permitted = t.permitted(k);
  plane.unbalance = std::abs(of.needed.mass_radius[k]);
  plane.grade = t.shares[k] > 0.0 ? t.grade * plane.unbalance / plane.permitted : kNaN;
  plane.remaining = std::abs(of.needed.mass_radius[k] - of.applied.mass_radius[k]);
  const double uncertainty = of.uncertainty(k);
  plane.now = verdict(plane.unbalance, of.spread ? uncertainty : 0.0, plane.permitted);
  plane.after = verdict(plane.remaining, uncertainty, plane.permitted);
  return plane;
}

// --- JSON ----------------------------------------------------------------------------------------

Json number(double x) {
  return std::isnan(x) ? Json() : Json(x);
}

Json interval(double value, double half_width) {
  return std::isnan(half_width) ? Json() : Json{value - half_width, value + half_width};
}

Json planeJson(const FieldBalancing& of, Eigen::Index k) {
  const Complex mass = of.applied.mass_radius[k];
  const bool known = of.spread && !of.limited();
  const double size = known ? of.uncertainty(k) : kNaN;
  const double turn = known ? of.angleUncertainty(k) : kNaN;
  Json json = {{"mass_radius", std::abs(mass)},
               {"angle", of.angle(mass)},
               {"mass_radius_deviation", known ? Json(of.spread->deviation[k]) : Json()},
               {"angle_deviation", known ? Json(turn / of.spread->within95) : Json()},
               {"mass_radius_interval", interval(std::abs(mass), size)},
               {"angle_interval", interval(of.angle(mass), turn)}};
  if (std::isfinite(of.job.limits[k])) {
    json["limit"] = of.job.limits[k];
  }
  for (const PartOfMass& part : of.parts(k)) {
    json["parts"].push_back(
        {{"mass_radius", part.mass_radius}, {"angle", of.angle(std::polar(1.0, part.angle))}});
  }
  return json;
}

Json toleranceJson(const FieldBalancing& of) {
  const BalanceTolerance& t = *of.job.tolerance;
  Json json = {{"grade", t.grade}, {"mass", t.mass}, {"speed", t.speed}};
  for (Eigen::Index k = 0; k < of.planes(); ++k) {
    const PlaneTolerance plane = toleranceOf(of, k);
    json["planes"][of.plane(k)] = {
        {"permitted", plane.permitted}, {"unbalance", plane.unbalance},
        {"grade", number(plane.grade)}, {"verdict", plane.now},
        {"remaining", plane.remaining}, {"uncertainty", number(of.uncertainty(k))},
        {"verdict_after", plane.after}};
  }
  return json;
}

Json jsonOf(const FieldBalancing& of) {
  Json json;
  for (Eigen::Index k = 0; k < of.planes(); ++k) {
    json["correction"][of.plane(k)] = planeJson(of, k);
    if (!of.job.left_in.isZero(0.0)) {
      const Complex rest = of.applied.mass_radius[k] - of.job.left_in[k];
      json["correction_with_trial_masses"][of.plane(k)] = {{"mass_radius", std::abs(rest)},
                                                           {"angle", of.angle(rest)}};
    }
  }
  for (std::size_t i = 0; i < of.job.probes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Complex left = of.applied.residual[row];
    json["residual"][of.job.probes[i]] = {{"amplitude", std::abs(left)},
                                          {"phase_lag", degrees(-std::arg(left))}};
    Json coefficients = Json::array();
    for (const Complex& one : of.influence.coefficients.row(row)) {
      coefficients.push_back({std::abs(one), of.phase(one)});
    }
    json["influence"].push_back(coefficients);
  }
  json["residual_rms"] = of.applied.rms;
  json["amplitude_unit"] = textOrNull(of.job.unit);  // null: that of the readings
  json["condition"] = of.needed.condition;
  if (of.job.tolerance) {
    json["tolerance"] = toleranceJson(of);
  }
  return json;
}

/// The correction masses, or their parts at the places; the residual vibration at the probes.
CsvTables tablesOf(const FieldBalancing& of) {
  CsvTable planes{"", {"plane", "mass_radius", "angle"}, {}};
  for (Eigen::Index k = 0; k < of.planes(); ++k) {
    std::vector<PartOfMass> parts = of.parts(k);
    if (parts.empty()) {
      const Complex mass = of.applied.mass_radius[k];
      parts.push_back({std::arg(mass), std::abs(mass)});
    }
    for (const PartOfMass& part : parts) {
      planes.rows.push_back({{"plane", of.plane(k)},
                             {"mass_radius", part.mass_radius},
                             {"angle", of.angle(std::polar(1.0, part.angle))}});
    }
  }
  CsvTable probes{"vibration", {"probe", "before", "after"}, {}};
  for (std::size_t i = 0; i < of.job.probes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    probes.rows.push_back({{"probe", of.job.probes[i]},
                           {"before", std::abs(of.job.initial[k])},
                           {"after", std::abs(of.applied.residual[k])}});
  }
  return {planes, probes};
}

// --- Text ----------------------------------------------------------------------------------------

std::string massLine(const FieldBalancing& of, Eigen::Index k, const Complex& mass) {
  return fmt::format("  {:<18} {:>18.6g} {:>12.4f}", printable(of.plane(k)),
                     of.shownMass(std::abs(mass)), of.angle(mass));
}

std::string correctionText(const FieldBalancing& of) {
  const std::string title = fmt::format("mass x radius, {}", of.job.shown_mass_unit);
  const bool known = of.spread && !of.limited();
  std::string out = fmt::format(
      "{:<18} {:>20}   angle, deg{}\n", "add", title,
      known ? fmt::format("   (half-width of the 95 % interval: {}, deg)", of.job.shown_mass_unit)
            : "");
  for (Eigen::Index k = 0; k < of.planes(); ++k) {
    out += massLine(of, k, of.applied.mass_radius[k]);
    out += known ? fmt::format("   ({:.2g}, {:.2g})", of.shownMass(of.uncertainty(k)),
                               of.angleUncertainty(k))
                 : "";
    out += std::abs(of.needed.mass_radius[k]) > of.job.limits[k]
               ? fmt::format("   limited; {:.6g} would cancel the unbalance",
                             of.shownMass(std::abs(of.needed.mass_radius[k])))
               : "";
    out += "\n";
    for (const PartOfMass& part : of.parts(k)) {
      out += fmt::format("    {:<16} {:>18.6g} {:>12.4f}\n", "at the place",
                         of.shownMass(part.mass_radius), of.angle(std::polar(1.0, part.angle)));
    }
  }
  if (!of.job.left_in.isZero(0.0)) {
    out += "trial masses removed; or, with those that are left in:\n";
    for (Eigen::Index k = 0; k < of.planes(); ++k) {
      out += massLine(of, k, of.applied.mass_radius[k] - of.job.left_in[k]) + "\n";
    }
  }
  if (!of.spread) {
    out += "  no confidence intervals: give `deviation`, or more probes than planes\n";
  }
  return out;
}

/// Lines that are the key `influence` of a later job.
std::string influenceText(const FieldBalancing& of) {
  if (of.job.trials.empty()) {
    return "";
  }
  std::string out = fmt::format(
      "influence coefficients, phase {} in deg, for a later job without trial runs:\ninfluence:\n",
      of.phaseName());
  const std::string unit =
      of.job.unit.empty() ? "" : fmt::format(" {}/({})", of.job.shown_unit, of.job.shown_mass_unit);
  const double scale = of.job.unit.empty() ? 1.0 : of.shownAmplitude(1.0) / of.shownMass(1.0);
  for (Eigen::Index i = 0; i < of.influence.coefficients.rows(); ++i) {
    std::vector<std::string> row;
    for (const Complex& one : of.influence.coefficients.row(i)) {
      row.push_back(fmt::format("[{:.6g}{}, {:.4f}]", scale * std::abs(one), unit, of.phase(one)));
    }
    out += fmt::format("  - [{}]\n", fmt::join(row, ", "));
  }
  return out;
}

std::string toleranceText(const FieldBalancing& of) {
  if (!of.job.tolerance) {
    return "";
  }
  const BalanceTolerance& t = *of.job.tolerance;
  const std::string& unit = of.job.shown_mass_unit;
  std::string out = fmt::format(
      "tolerance of ISO 21940-11: G {:g} at {:.6g} rpm, {:g} kg ({})\n  {:<18} {:>12} {:>12} "
      "{:>10} "
      "{:>10}   after the correction\n",
      t.grade, t.speed / kRpm, t.mass, unit, "plane", "permitted", "unbalance", "grade", "");
  for (Eigen::Index k = 0; k < of.planes(); ++k) {
    const PlaneTolerance plane = toleranceOf(of, k);
    out += fmt::format(
        "  {:<18} {:>12.5g} {:>12.5g} {:>10.3g} {:>10}   {}\n", printable(of.plane(k)),
        of.shownMass(plane.permitted), of.shownMass(plane.unbalance), plane.grade, plane.now,
        !of.spread ? "uncertain: the errors are unknown"
                   : fmt::format("{:.3g} +- {:.2g}, {}", of.shownMass(plane.remaining),
                                 of.shownMass(of.uncertainty(k)), plane.after));
  }
  return out;
}

std::string textOf(const FieldBalancing& of) {
  const std::string vibration =
      of.job.unit.empty() ? "vibration" : "vibration, " + of.job.shown_unit;
  std::string out =
      correctionText(of) + fmt::format("{:<18} {:>18} {:>12}\n", vibration, "before", "after");
  for (std::size_t i = 0; i < of.job.probes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out += fmt::format("  {:<18} {:>16.6g} {:>12.6g}\n", printable(of.job.probes[i]),
                       of.shownAmplitude(std::abs(of.job.initial[k])),
                       of.shownAmplitude(std::abs(of.applied.residual[k])));
  }
  out += std::isfinite(of.needed.condition)
             ? fmt::format("planes: condition number {:.4g}\n", of.needed.condition)
             : "planes: linearly dependent or without effect: the smallest masses are given\n";
  return out + toleranceText(of) + influenceText(of);
}

}  // namespace

Document fieldBalancingDocument(const BalancingJob& job) {
  const FieldBalancing of(job);
  return {jsonOf(of), textOf(of), tablesOf(of), {}};
}

}  // namespace whirl_twin
