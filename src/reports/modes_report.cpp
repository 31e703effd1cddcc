#include "reports/modes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/banded_rotor.h"
#include "analysis/stability.h"
#include "messages/input_error.h"
#include "reports/report_values.h"
#include "reports/rotor_outline.h"

namespace whirl_twin {

namespace {

constexpr double kBeyondFirst = 3.0;  // of the first
constexpr double kOfNyquist = 0.8;    // up to which probes resolve a mode
constexpr double kMinTurn = 1.0e-4;   // rad from sample to sample, of the frequencies searched
constexpr double kWellKnown = 0.25;   // deviation of a decay rate, of it

/// Whirls first, then what is damped too much to be one.
std::vector<WhirlMode> whirlsFirst(std::vector<WhirlMode> modes) {
  std::stable_partition(modes.begin(), modes.end(), isWhirl);
  return modes;
}

/// Highest frequency of the search: that of the model's first modes, within the range of the
/// samples.
double limitOf(const std::vector<WhirlMode>& model, double speed, double period) {
  double limit = 3.0 * speed;
  if (!model.empty()) {
    const auto whirls =
        static_cast<std::size_t>(std::count_if(model.begin(), model.end(), isWhirl));
    const std::size_t last = std::clamp<std::size_t>(whirls, 1, kModesOfInterest) - 1;
    limit = std::max(kBeyondLastMode * model[last].dampedFrequency(),
                     kBeyondFirst * model.front().dampedFrequency());
  }
  return std::clamp(limit, kMinTurn / period, kOfNyquist * 0.5 * kTwoPi / period);
}

/// One mode of the measured ones for each sense of the model's: the stronger stays.
std::vector<ComparedMode> compared(const std::vector<AmbientMode>& measured,
                                   const std::vector<SeenMode>& seen) {
  std::vector<ComparedMode> all;
  for (const AmbientMode& mode : measured) {
    all.push_back({mode, std::nullopt, 0.0, 0.0});
  }
  for (const ModePair& pair : pairModes(measured, seen)) {
    all[pair.measured].model = pair.modelled;
    all[pair.measured].assurance = pair.assurance;
  }
  std::vector<ComparedMode> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ComparedMode& one = all[i];
    const auto other = std::find_if(all.begin(), all.end(), [&](const ComparedMode& candidate) {
      return &candidate != &one && candidate.model && candidate.model == one.model;
    });
    if (other != all.end()) {
      const double apart =
          std::fabs(std::fabs(one.mode.frequency) - std::fabs(other->mode.frequency));
      const double deviation =
          std::hypot(one.mode.frequency_deviation, other->mode.frequency_deviation);
      const bool one_mode = apart < 3.0 * deviation + 0.005 * std::fabs(one.mode.frequency);
      if (one_mode && one.mode.power < other->mode.power) {
        continue;
      }
      if (one_mode) {
        one.other_sense = std::sqrt(other->mode.power / one.mode.power);
      }
    }
    kept.push_back(one);
  }
  return kept;
}

void addModesNotes(ModesReport& report) {
  std::vector<std::string>& notes = report.notes;
  if (std::string pulses = report.counts.pulseNote(); !pulses.empty()) {
    notes.push_back(std::move(pulses));
  }
  if (!report.record) {
    notes.push_back(fmt::format(
        "the record is too short at {:.5g} rad/s: no modes in {} samples with a known angle at a "
        "speed within 1 % of it. A decay rate s is known to sqrt(s/T) after T seconds at best",
        report.speed, report.counts.samples));
    return;
  }
  const AmbientRecord& record = *report.record;
  for (const ComparedMode& one : report.modes) {
    const AmbientMode& mode = one.mode;
    if (mode.decay_deviation > kWellKnown * std::fabs(mode.decay_rate)) {
      notes.push_back(
          fmt::format("the decay rate at {:.5g} rad/s has a relative error of {:.2g}; 10 % needs a "
                      "record {:.2g} times as long",
                      std::fabs(mode.frequency), mode.decay_deviation / std::fabs(mode.decay_rate),
                      std::pow(10.0 * mode.decay_deviation / mode.decay_rate, 2.0)));
    }
    if (mode.order > 0) {
      notes.push_back(
          fmt::format("{:.5g} rad/s is at {} times the speed: the synchronous motion removed there "
                      "falsifies its frequency and decay rate",
                      std::fabs(mode.frequency), mode.order));
    }
  }
  if (record.modes.empty()) {
    notes.push_back(
        "no pole persists over the model orders: the excitation is too weak or the record too "
        "short");
  }
  if (std::find(report.one_probe.begin(), report.one_probe.end(), true) != report.one_probe.end()) {
    notes.push_back(
        "one probe cannot separate forward from backward whirl: directions are those of the "
        "stations with two");
  }
  if (record.speed > report.system->rotor.highest_speed) {
    notes.push_back(fmt::format("the reduced-order rotor of the model is valid up to {:g} rad/s",
                                report.system->rotor.highest_speed));
  }
}

constexpr double kHeight = 0.9;  // of the largest orbit, the rotor behind it
constexpr double kPale = 0.6;

Chart shapeChart(const ModesReport& r, std::size_t place, const ShownUnits& u) {
  const WhirlMode& mode = r.model[place];
  OrbitChart drawn = orbitChart(mode.orbits, r.system->stations, "of the largest orbit",
                                DrawnInstant::kWidestHighest);
  Chart& chart = drawn.chart;
  if (r.system->shaft && drawn.along_shaft) {
    const std::vector<Series> outline =
        rotorOutline(*r.system->shaft, kHeight / largestRadius(*r.system->shaft), kPale);
    chart.series.insert(chart.series.begin(), outline.begin(), outline.end());
    chart.x.label = "along the shaft (m)";
    for (Series& series : chart.series) {
      series.name.clear();  // one legend, in words, for all
    }
  }
  if (!drawn.along_shaft) {
    chart.series.back().name = "at one instant";  // a mode has no phase
    if (chart.series.size() == 2) {
      chart.series.front().pen =
          Pen{mode.whirl == Whirl::kBackward ? ink::kVermilion : ink::kBlue, 2.2};
    }
  }
  const double frequency = mode.dampedFrequency();
  chart.title = fmt::format("{}: {}, {} ({}), log. decrement {:.3g}", place + 1, name(mode.whirl),
                            u.frequency.shortText(frequency),
                            u.frequency.beside().shortText(frequency), mode.logDecrement());
  return chart;
}

}  // namespace

ModesReport modesReport(const RotorSystem& system, double speed) {
  ModesReport report;
  report.system = &system;
  report.speed = speed;
  const FullOrderModel full = fullOrderModel(system);
  const auto all = static_cast<std::size_t>(full.rotor.dof());
  if (full.rotor.dof() > kMaxCompleteCoordinates) {
    const BandedLinearization matrices = BandedRotor(full.rotor).matrices(speed);
    std::size_t whirls = 0;
    for (std::size_t count = kLowestModes; count <= all && whirls < kLowestModes; count *= 2) {
      const auto lowest = lowestWhirlModes(matrices, full.stations, count);
      report.model = lowest ? lowest->modes : std::vector<WhirlMode>();
      whirls = static_cast<std::size_t>(
          std::count_if(report.model.begin(), report.model.end(), isWhirl));
    }
  }
  if (report.model.empty()) {
    report.model = whirlModes(full.rotor, full.stations, speed).modes;
  }
  report.model = whirlsFirst(std::move(report.model));
  return report;
}

ModesReport modesReport(const RotorSystem& system, const RotorRecord& record,
                        std::optional<double> speed, std::optional<double> limit) {
  ModesReport report;
  report.system = &system;
  report.speed = speed.value_or(record.steadySpeed());
  report.model = whirlsFirst(whirlModes(system.rotor, system.stations, report.speed).modes);
  report.log = record.log();
  report.notes = record.notes();
  std::vector<std::size_t> places;
  std::vector<double> directions;
  for (const RecordedProbe& probe : record.probes()) {
    places.push_back(probe.station);
    directions.push_back(probe.direction);
  }
  const std::vector<MeasuredStation> stations = measuredStations(places, directions);
  for (const MeasuredStation& station : stations) {
    report.stations.push_back(system.stations[station.station].name);
    report.one_probe.push_back(!station.whole());
  }
  const double highest = kOfNyquist * 0.5 * kTwoPi / record.period();
  const double lowest = kMinTurn / record.period();
  if (limit && !(*limit >= lowest && *limit <= highest)) {
    throw InputError(
        fmt::format("--to: must be a frequency from {:.4g} to {:.4g} rad/s, {:g} of half the "
                    "sampling rate, found {:g}",
                    lowest, highest, kOfNyquist, *limit));
  }
  AmbientModes ambient(static_cast<Eigen::Index>(stations.size()), record.period(), report.speed,
                       limit.value_or(limitOf(report.model, report.speed, record.period())));
  StationSample sample;
  sample.z.resize(static_cast<Eigen::Index>(stations.size()));
  report.counts = record.read([&](const ProbeReading& reading) {
    sample.index = reading.index;
    sample.time = reading.time;
    sample.turns = reading.turns;
    sample.remainder = reading.remainder;
    sample.speed = reading.speed;
    for (std::size_t s = 0; s < stations.size(); ++s) {
      const MeasuredStation& at = stations[s];
      const auto value = [&](std::size_t k) {
        return reading.values[static_cast<Eigen::Index>(at.probe[k])];
      };
      sample.z[static_cast<Eigen::Index>(s)] =
          at.whole() ? at.z(value(0), value(1)) : at.z(value(0), 0.0);
    }
    ambient.take(sample);
  });
  report.record = ambient.record();
  if (report.record) {
    report.speed = report.record->speed;
    report.model = whirlsFirst(whirlModes(system.rotor, system.stations, report.speed).modes);
    std::vector<SeenMode> seen;
    for (const WhirlMode& mode : report.model) {
      seen.push_back(seenMode(mode, stations));
    }
    report.modes = compared(report.record->modes, seen);
    for (std::size_t k = 0; k < report.model.size(); ++k) {
      const bool found = std::any_of(report.modes.begin(), report.modes.end(),
                                     [&](const ComparedMode& one) { return one.model == k; });
      if (!found && isWhirl(report.model[k]) &&
          report.model[k].dampedFrequency() <= report.record->limit) {
        report.not_seen.push_back(k);
      }
    }
  }
  addModesNotes(report);
  return report;
}

Figure figure(const ModesReport& r, std::size_t count, const ShownUnits& u) {
  Figure figure;
  figure.title =
      fmt::format("{}: whirl modes at {} (blue forward, orange backward){}", r.system->title(),
                  u.speedText(r.speed), beyondMark(r.system->tables(), r.speed));
  for (std::size_t k = 0; k < std::min(count, r.model.size()); ++k) {
    figure.charts.push_back(shapeChart(r, k, u));
  }
  const bool along = r.system->shaft.has_value();
  figure.columns = figure.charts.size() > 1 ? 2 : 1;
  figure.width = 1040;
  figure.chart_height = along ? 290 : 420;
  return figure;
}

}  // namespace whirl_twin
