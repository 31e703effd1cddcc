#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "reports/modes_report.h"
#include "reports/report_values.h"

namespace whirl_twin {

namespace {

/// "86.7 +- 0.12": a value with half of an interval that holds 95 %.
std::string interval(double value, double half) {
  return fmt::format("{:.5g} +- {:.2g}", value, half);
}

const char* sense(const AmbientMode& mode) {
  return mode.frequency > 0.0 ? "forward" : "backward";
}

/// Minor by major semi-axis, negative of an orbit against the rotation; 0 in a plane.
double kappa(const Orbit& orbit) {
  return orbit.direction() == Whirl::kStraight
             ? 0.0
             : (std::abs(orbit.forward) - std::abs(orbit.backward)) / orbit.major();
}

/// Of the station that moves most.
double kappa(const WhirlMode& mode) {
  const auto widest =
      std::max_element(mode.orbits.begin(), mode.orbits.end(),
                       [](const Orbit& a, const Orbit& b) { return a.major() < b.major(); });
  return kappa(*widest);
}

Json modelJson(const ModesReport& report, std::size_t place) {
  const WhirlMode& mode = report.model[place];
  Json json{{"mode", place + 1},
            {"frequency", mode.dampedFrequency()},
            {"decay_rate", -mode.eigenvalue.real() + 0.0},
            {"damping_ratio", mode.dampingRatio()},
            {"log_decrement", mode.logDecrement()},
            {"whirl", name(mode.whirl)},
            {"is_whirl", isWhirl(mode)}};
  json["shape"] = Json::array();
  for (std::size_t s = 0; s < mode.orbits.size(); ++s) {
    const Orbit& orbit = mode.orbits[s];
    json["shape"].push_back({{"station", report.system->stations[s].name},
                             {"major", orbit.major()},
                             {"minor", orbit.minor()},
                             {"inclination", orbit.inclination()},
                             {"kappa", kappa(orbit)},
                             {"whirl", name(orbit.direction())}});
  }
  return json;
}

Json measuredJson(const ModesReport& report, const ComparedMode& one) {
  const AmbientMode& mode = one.mode;
  const double factor = report.record->interval;
  const auto estimate = [&](double value, double deviation) -> Json {
    return {{"value", value},
            {"standard_deviation", deviation},
            {"interval", {value - factor * deviation, value + factor * deviation}}};
  };
  const double frequency = std::fabs(mode.frequency);
  const double decrement_deviation =
      mode.logDecrement() * mode.decay_deviation / std::fabs(mode.decay_rate);
  Json json{{"whirl", sense(mode)},
            {"frequency", estimate(frequency, mode.frequency_deviation)},
            {"decay_rate", estimate(mode.decay_rate, mode.decay_deviation)},
            {"damping_ratio", estimate(mode.dampingRatio(), mode.decay_deviation / mode.size())},
            {"log_decrement", estimate(mode.logDecrement(), decrement_deviation)},
            {"other_sense", one.other_sense},
            {"power", mode.power},
            {"order", mode.order > 0 ? Json(mode.order) : Json()},
            {"shape", Json::array()},
            {"model", Json()}};
  for (std::size_t s = 0; s < report.stations.size(); ++s) {
    const auto k = static_cast<Eigen::Index>(s);
    json["shape"].push_back({{"station", report.stations[s]},
                             {"amplitude", std::abs(mode.shape[k])},
                             {"phase", std::arg(mode.shape[k])},
                             {"deviation", mode.shape_deviation[k]}});
  }
  if (one.model) {
    const WhirlMode& model = report.model[*one.model];
    const double apart = model.dampedFrequency() - frequency;
    const double decay_apart = -model.eigenvalue.real() - mode.decay_rate;
    json["model"] = modelJson(report, *one.model);
    json["model"].update({{"assurance", one.assurance},
                          {"frequency_difference", apart},
                          {"decay_rate_difference", decay_apart},
                          {"agrees", std::fabs(apart) <= factor * mode.frequency_deviation &&
                                         std::fabs(decay_apart) <= factor * mode.decay_deviation}});
  }
  return json;
}

std::string modelLine(const ModesReport& report, std::size_t place, const ShownUnits& u) {
  const WhirlMode& mode = report.model[place];
  return fmt::format("  {:>3}  {:<9} {:>10.5g} {:>10.4g} {:>10.4g} {:>10.4g} {:>8.3f}\n", place + 1,
                     name(mode.whirl), u.frequency.in(mode.dampedFrequency()),
                     -mode.eigenvalue.real() + 0.0, mode.dampingRatio(), mode.logDecrement(),
                     kappa(mode));
}

std::string modelText(const ModesReport& report, const ShownUnits& u) {
  std::string out = fmt::format("  mode  whirl{:>15}  decay 1/s      ratio   log dec.    kappa\n",
                                u.frequency.name);
  for (std::size_t k = 0; k < report.model.size(); ++k) {
    if (!isWhirl(report.model[k]) && (k == 0 || isWhirl(report.model[k - 1]))) {
      out += "  no whirl, with a damping ratio above 0.7:\n";
    }
    out += modelLine(report, k, u);
  }
  return report.model.empty()
             ? "  no oscillating mode\n"
             : out +
                   "  kappa: minor / major semi-axis of the largest orbit, negative for backward "
                   "whirl;\n  of every station with --json and --csv\n";
}

std::string measuredText(const ModesReport& report, const ComparedMode& one, const ShownUnits& u) {
  const AmbientMode& mode = one.mode;
  const double factor = report.record->interval;
  const double decrement = mode.logDecrement();
  std::string out = fmt::format(
      "  {:<9} {:>18} {:>20} {:>20}\n", sense(mode),
      interval(u.frequency.in(std::fabs(mode.frequency)),
               u.frequency.in(factor * mode.frequency_deviation)),
      interval(mode.decay_rate, factor * mode.decay_deviation),
      interval(decrement, factor * std::fabs(decrement / mode.decay_rate) * mode.decay_deviation));
  if (one.model) {
    const WhirlMode& model = report.model[*one.model];
    out +=
        fmt::format("    model {:<3} {:>12.5g} ({:+.2g} %) {:>13.4g} {:>19.4g}   shapes {:.3f}\n",
                    *one.model + 1, u.frequency.in(model.dampedFrequency()),
                    100.0 * (model.dampedFrequency() / std::fabs(mode.frequency) - 1.0),
                    -model.eigenvalue.real() + 0.0, model.logDecrement(), one.assurance);
  } else {
    out += "    no mode of the model\n";
  }
  if (report.stations.size() > 1) {
    out += "    shape  ";
    for (std::size_t s = 0; s < report.stations.size(); ++s) {
      const auto k = static_cast<Eigen::Index>(s);
      out += fmt::format(" {} {:.3g} at {:.0f} deg +- {:.2g},", report.stations[s],
                         std::abs(mode.shape[k]), std::arg(mode.shape[k]) / kDegree + 0.0,
                         factor * mode.shape_deviation[k]);
    }
    out.back() = '\n';
  }
  if (one.other_sense > 0.0) {
    out += fmt::format("    an ellipse: {:.2g} of it in the other direction\n", one.other_sense);
  }
  return out;
}

}  // namespace

Json json(const ModesReport& report) {
  Json json{{"speed", report.speed},
            {"beyond_tables", !report.system->tables().covers(report.speed)}};
  if (report.log.empty()) {
    json["modes"] = Json::array();
    for (std::size_t k = 0; k < report.model.size(); ++k) {
      json["modes"].push_back(modelJson(report, k));
    }
    return json;
  }
  json["log"] = report.log;
  json["stations"] = report.stations;
  report.counts.addTo(json, report.counts.samples);
  json["duration"] = report.record ? report.record->duration : 0.0;
  json["limit"] = report.record ? Json(report.record->limit) : Json();
  json["vibration"] = report.record ? Json(report.record->vibration) : Json();
  json["orders"] = report.record ? Json(report.record->orders) : Json();
  json["modes"] =
      listJson(report.modes, [&](const ComparedMode& one) { return measuredJson(report, one); });
  json["not_seen"] = listJson(report.not_seen, [&](std::size_t k) { return modelJson(report, k); });
  json["notes"] = report.notes;
  return json;
}

CsvTables tables(const ModesReport& report) {
  CsvTable table{"",
                 {"mode", "whirl", "frequency", "decay_rate", "damping_ratio", "log_decrement"}};
  if (report.log.empty()) {
    table.rows = json(report)["modes"];
    CsvTable shapes{
        "shapes",
        {"mode", "station", "position", "major", "minor", "inclination", "kappa", "whirl"}};
    for (const Json& mode : table.rows) {
      for (std::size_t s = 0; s < report.system->stations.size(); ++s) {
        Json row = mode["shape"][s];
        row["mode"] = mode["mode"];
        row["position"] = report.system->stations[s].position;
        shapes.rows.push_back(row);
      }
    }
    return {table, shapes};
  }
  for (const char* column : {"frequency_deviation", "decay_rate_deviation", "model_frequency",
                             "model_decay_rate", "assurance"}) {
    table.columns.emplace_back(column);
  }
  for (const ComparedMode& one : report.modes) {
    const Json measured = measuredJson(report, one);
    Json row{{"whirl", measured["whirl"]}};
    for (const char* key : {"frequency", "decay_rate", "damping_ratio", "log_decrement"}) {
      row[key] = measured[key]["value"];
    }
    row["frequency_deviation"] = measured["frequency"]["standard_deviation"];
    row["decay_rate_deviation"] = measured["decay_rate"]["standard_deviation"];
    if (one.model) {
      row["mode"] = measured["model"]["mode"];
      row["model_frequency"] = measured["model"]["frequency"];
      row["model_decay_rate"] = measured["model"]["decay_rate"];
      row["assurance"] = measured["model"]["assurance"];
    }
    table.rows.push_back(row);
  }
  return {table};
}

std::string text(const ModesReport& report, const ShownUnits& u) {
  std::string out = report.system->title();
  const std::string beyond = beyondLine(report.system->tables(), report.speed, report.speed);
  if (report.log.empty()) {
    return out + fmt::format(": at {:g} {}\n", u.speed.in(report.speed), u.speed.name) + beyond +
           modelText(report, u);
  }
  if (report.record) {
    const AmbientRecord& record = *report.record;
    out += fmt::format(
        ": {:.4g} s at {:.5g} {}, frequencies up to {:.4g} {}\n"
        "  {:.3g} m rms synchronous motion removed, {:.3g} m rms remaining\n"
        "  measured{:>16}            decay 1/s             log dec.    (95 %)\n",
        record.duration, u.speed.in(report.speed), u.speed.name, u.frequency.in(record.limit),
        u.frequency.name, record.orders, record.vibration, u.frequency.name);
  } else {
    out += fmt::format(": {}\n", report.log);
  }
  out +=
      joined(report.modes, [&](const ComparedMode& one) { return measuredText(report, one, u); });
  if (!report.not_seen.empty()) {
    out += "  of the model, not measured:\n";
    out += joined(report.not_seen, [&](std::size_t k) { return modelLine(report, k, u); });
  }
  return out + joined(report.notes, [](const auto& note) { return "  " + note + "\n"; }) + beyond;
}

}  // namespace whirl_twin
