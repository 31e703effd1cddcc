#include "reports/unbalance_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr double kTakesPart = 0.1;   // in a combination, of its largest, to be named
constexpr double kMuchBeyond = 2.0;  // the residual over what the probes' noise makes
constexpr double kSameSpeed = 0.01;  // of a speed

/// Does a force act at the station as an unbalance would?
bool actsAt(const ShaftForce& force, const Station& station) {
  const Eigen::VectorXcd unit = station.along_x.cast<std::complex<double>>() -
                                std::complex<double>(0.0, 1.0) * station.along_y;
  const double both = unit.squaredNorm() * force.amplitude.squaredNorm();
  return force.inertial && force.harmonic == 1 && both > 0.0 &&
         std::norm(unit.dot(force.amplitude)) > (1.0 - 1.0e-9) * both;
}

std::vector<BalancingPlane> planesOf(const RotorSystem& system,
                                     const std::vector<std::string>& wanted) {
  std::vector<BalancingPlane> planes;
  for (const std::string& name : wanted) {
    planes.push_back({name, system.stations[system.stationNamed("--planes", name)]});
  }
  if (!planes.empty()) {
    return planes;
  }
  std::vector<BalancingPlane> all;
  for (const Station& station : system.stations) {
    all.push_back({station.name, station});
    if (std::any_of(system.rotor.forces.begin(), system.rotor.forces.end(),
                    [&](const ShaftForce& force) { return actsAt(force, station); })) {
      planes.push_back(all.back());
    }
  }
  return planes.empty() ? all : planes;
}

/// The members of a combination that is not identifiable; of planes and run-outs each, relative to
/// the largest of their kind.
std::string partners(const UnbalanceReport& report, const UnidentifiableCombination& combination) {
  std::vector<std::string> names;
  const auto collect = [&](const std::vector<std::complex<double>>& parts,
                           const std::vector<std::string>& of, const char* what) {
    double largest = 0.0;
    for (const std::complex<double>& part : parts) {
      largest = std::max(largest, std::abs(part));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (largest > 0.0 && std::abs(parts[i]) > kTakesPart * largest) {
        names.push_back(fmt::format("{} {}", what, of[i]));
      }
    }
  };
  collect(combination.planes, report.planes, "the unbalance at");
  collect(combination.run_outs, report.probes, "the run-out under");
  return fmt::format("{}", fmt::join(names, ", "));
}

void addUnbalanceNotes(UnbalanceReport& report) {
  const UnbalanceEstimate& found = report.estimate;
  if (!found.unidentifiable.empty()) {
    const bool one_speed =
        found.highest_speed - found.lowest_speed < kSameSpeed * found.highest_speed;
    report.notes.push_back(fmt::format(
        "{} unknowns are not identifiable from the log: {}", found.unidentifiable.size(),
        one_speed ? "at one speed run-out and unbalance have the same effect. Add a second speed, "
                    "preferably a slow one, or use known run-outs (--known-run-out)"
                  : "some planes have linearly dependent effects at these speeds. Use fewer planes "
                    "(--planes), or a range with another critical speed"));
    std::vector<std::string> said;
    for (const UnidentifiableCombination& combination : found.unidentifiable) {
      const std::string who = partners(report, combination);
      if (std::find(said.begin(), said.end(), who) == said.end()) {
        said.push_back(who);
        report.notes.push_back("not identifiable separately: " + who);
      }
    }
  }
  if (found.beyond_noise > kMuchBeyond) {
    report.notes.push_back(fmt::format(
        "the residual is {:.3g} times the probes' noise: ambient vibration or a model error; the "
        "standard deviations assume a correct model (`twin fit`, `twin modes`)",
        found.beyond_noise));
  }
  if (found.highest_speed > report.system->rotor.highest_speed) {
    report.notes.push_back(
        fmt::format("the reduced-order rotor of the model is valid up to {:g} rad/s (--to)",
                    report.system->rotor.highest_speed));
  }
}

/// [deg], from the phase mark.
double angleOf(const UnbalanceReport& report, std::complex<double> unbalance) {
  return std::arg(unbalance * std::polar(1.0, -report.phase_mark)) / kDegree + 0.0;
}

/// [deg], of the angle of a phasor.
double angleDeviation(const PhasorEstimate& estimate) {
  return std::atan2(estimate.deviation, std::abs(estimate.value)) / kDegree;
}

Json massJson(const UnbalanceReport& report, const PhasorEstimate& estimate, double sign) {
  const bool known = estimate.identifiable;
  return {{"mass_radius", known ? Json(std::abs(estimate.value)) : Json()},
          {"angle", known ? Json(angleOf(report, sign * estimate.value)) : Json()},
          {"mass_radius_deviation", known ? Json(estimate.deviation) : Json()},
          {"angle_deviation", known ? Json(angleDeviation(estimate)) : Json()}};
}

std::string massLine(const UnbalanceReport& report, std::size_t plane, double sign) {
  const PhasorEstimate& estimate = report.estimate.planes[plane];
  const std::string name = printable(report.planes[plane]);
  return estimate.identifiable
             ? fmt::format("  {:<18} {:>14.6g} +- {:<9.2g} {:>11.3f} +- {:.2g}\n", name,
                           std::abs(estimate.value), estimate.deviation,
                           angleOf(report, sign * estimate.value), angleDeviation(estimate))
             : fmt::format("  {:<18} {:>14}\n", name, "unidentifiable");
}

}  // namespace

UnbalanceReport unbalanceReport(const RotorSystem& system, const RotorRecord& record,
                                const UnbalanceRequest& request) {
  UnbalanceReport report;
  report.system = &system;
  report.log = record.log();
  report.phase_mark = system.dynamics->phaseMark();
  const std::vector<BalancingPlane> planes = planesOf(system, request.planes);
  for (const BalancingPlane& plane : planes) {
    report.planes.push_back(plane.name);
  }
  std::vector<RotorProbe> probes;
  for (const RecordedProbe& probe : record.probes()) {
    const Station& station = system.stations[probe.station];
    report.probes.push_back(probe.name);
    probes.push_back(
        {probe.name,
         std::cos(probe.direction) * station.along_x + std::sin(probe.direction) * station.along_y,
         probe.deviation, probe.delay, probe.bandwidth, request.run_out_known, probe.run_out});
  }
  UnbalanceFit fit(system.rotor, planes, probes);
  std::int64_t used = 0;
  ProbeReading outside;
  report.counts = record.read([&](const ProbeReading& reading) {
    if (reading.speed >= request.from && reading.speed <= request.to) {
      ++used;
      fit.take(reading);
      return;
    }
    outside = reading;  // the rotor continues, and this is not used
    outside.values.setConstant(std::nan(""));
    fit.take(outside);
  });
  if (used == 0) {
    throw InputError(fmt::format(
        "{}: expected samples with a known angle of the shaft from {:g} to {:g} rad/s, found none "
        "among {} samples",
        record.log(), request.from, request.to, report.counts.samples + report.counts.no_angle));
  }
  report.estimate = fit.estimate();
  report.notes = record.notes();
  if (const std::string pulses = report.counts.pulseNote(); !pulses.empty()) {
    report.notes.push_back(pulses);
  }
  addUnbalanceNotes(report);
  return report;
}

Json json(const UnbalanceReport& report) {
  const UnbalanceEstimate& found = report.estimate;
  Json json;
  json["system"] = report.system->name;
  json["log"] = report.log;
  for (std::size_t i = 0; i < report.planes.size(); ++i) {
    json["unbalance"][report.planes[i]] = massJson(report, found.planes[i], 1.0);
    json["correction"][report.planes[i]] = massJson(report, found.planes[i], -1.0);
  }
  for (std::size_t i = 0; i < report.probes.size(); ++i) {
    const PhasorEstimate& one = found.run_outs[i];
    json["run_out"][report.probes[i]] =
        one.identifiable ? Json({{"amplitude", std::abs(one.value)},
                                 {"phase_lag", -std::arg(one.value) / kDegree + 0.0},
                                 {"deviation", one.deviation}})
                         : Json();
  }
  json["rank_deficiency"] = found.unidentifiable.size();
  json["undetermined"] = listJson(
      found.unidentifiable,
      [&](const UnidentifiableCombination& combination) { return partners(report, combination); });
  json["lowest_speed"] = found.lowest_speed;
  json["highest_speed"] = found.highest_speed;
  json["duration"] = found.duration;
  report.counts.addTo(json, found.samples);
  json["synchronous_rms"] = found.synchronous;
  json["residual_rms"] = found.noise;
  json["residual_beyond_noise"] = found.beyond_noise > 0.0 ? Json(found.beyond_noise) : Json();
  json["notes"] = report.notes;
  return json;
}

CsvTables tables(const UnbalanceReport& report) {
  const Json all = json(report);
  const auto rows = [](const char* key, const Json& by_name) {
    Json list = Json::array();
    for (const auto& [name, one] : by_name.items()) {
      Json row{{key, name}};
      row.update(one.is_null() ? Json::object() : one);
      list.push_back(row);
    }
    return list;
  };
  return {
      {"",
       {"plane", "mass_radius", "angle", "mass_radius_deviation", "angle_deviation"},
       rows("plane", all["correction"])},
      {"run_out", {"probe", "amplitude", "phase_lag", "deviation"}, rows("probe", all["run_out"])}};
}

std::string text(const UnbalanceReport& report) {
  const UnbalanceEstimate& found = report.estimate;
  std::string out = fmt::format(
      "{}: {:.4g} s from {:.4g} to {:.4g} rad/s, {} probes\n"
      "  {:.3g} m rms synchronous, {:.3g} m rms residual (of each probe)\n"
      "unbalance            mass x radius, kg m            angle, deg   (standard deviations)\n",
      report.system->title(), found.duration, found.lowest_speed, found.highest_speed,
      report.probes.size(), found.synchronous, found.noise);
  for (std::size_t i = 0; i < report.planes.size(); ++i) {
    out += massLine(report, i, 1.0);
  }
  out += "add\n";
  for (std::size_t i = 0; i < report.planes.size(); ++i) {
    out += massLine(report, i, -1.0);
  }
  out += "run-out                 amplitude, m             phase lag, deg\n";
  for (std::size_t i = 0; i < report.probes.size(); ++i) {
    const PhasorEstimate& one = found.run_outs[i];
    const std::string name = printable(report.probes[i]);
    out += one.identifiable ? fmt::format("  {:<18} {:>14.4g} +- {:<9.2g} {:>11.2f}\n", name,
                                          std::abs(one.value), one.deviation,
                                          -std::arg(one.value) / kDegree + 0.0)
                            : fmt::format("  {:<18} {:>14}\n", name, "unidentifiable");
  }
  return out + joined(report.notes, [](const std::string& note) { return note + "\n"; });
}

}  // namespace whirl_twin
