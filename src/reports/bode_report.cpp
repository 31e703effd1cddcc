#include "reports/bode_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "scene/table_reader.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMinVectors = 8;

/// Words of letters, and the unit among them.
struct HeadingWords {
  std::vector<std::string> words, lower;

  explicit HeadingWords(const std::string& heading) {
    std::string word;
    for (const char c : heading + " ") {
      const auto byte = static_cast<unsigned char>(c);
      if (std::isalnum(byte) != 0 || byte >= 0x80) {
        word += c;
      } else if (!word.empty()) {
        words.push_back(word);
        std::transform(word.begin(), word.end(), word.begin(), [](unsigned char letter) {
          return static_cast<char>(std::tolower(letter));
        });
        lower.push_back(word);
        word.clear();
      }
    }
  }
  bool has(const std::vector<std::string>& any) const {
    return std::any_of(lower.begin(), lower.end(), [&](const std::string& word) {
      return std::find(any.begin(), any.end(), word) != any.end();
    });
  }
  /// The word that is a unit of this kind; "": none.
  std::string unit(const std::string& wanted) const {
    for (const std::string& word : words) {
      const std::string letters = unitIn(word);
      if (!letters.empty() && unitScale(letters, wanted) != 0.0) {
        return letters;
      }
    }
    return "";
  }
};

struct ProbeColumns {
  std::string name;
  std::size_t amplitude = 0, phase = 0;
  std::string unit;
  double scale = 1.0;  // from the table to `unit`, from 0 to the peak
  double to_lag = kDegree;
};

struct VectorColumns {
  std::size_t speed = 0;
  double to_speed = 1.0;
  std::vector<ProbeColumns> probes;
  std::vector<std::string> remarks;
};

ProbeColumns amplitudeColumn(std::size_t place, const HeadingWords& words,
                             std::vector<std::string>& remarks) {
  ProbeColumns probe;
  probe.amplitude = place;
  for (std::size_t i = 0; i < words.lower.size(); ++i) {
    const std::vector<std::string> known = {"amplitude", "amp", "magnitude", "1x",
                                            "pp",        "pk",  "p",         "peak",
                                            "to",        "rms", "0",         "displacement"};
    if (std::find(known.begin(), known.end(), words.lower[i]) == known.end() &&
        unitIn(words.words[i]).empty()) {
      probe.name += (probe.name.empty() ? "" : " ") + words.words[i];
    }
  }
  const std::string unit = words.unit("m");
  if (!unit.empty()) {
    probe.unit = "m";
    probe.scale = unitScale(unit, "m");
  }
  const auto peaks = std::count_if(words.lower.begin(), words.lower.end(), [](const auto& word) {
    return word == "pk" || word == "p" || word == "peak";
  });
  if (words.has({"pp", "pkpk"}) || peaks > 1) {
    probe.scale *= 0.5;
  } else if (words.has({"rms"})) {
    probe.scale *= std::sqrt(2.0);
  } else {
    remarks.push_back(fmt::format(
        "column {}: amplitudes from 0 to the peak, as its heading has neither pp nor rms",
        place + 1));
  }
  return probe;
}

VectorColumns vectorColumns(const NumberTable& table) {
  VectorColumns found;
  std::optional<std::size_t> speed;
  std::vector<std::size_t> phases;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const std::string& heading = table.columns()[i].heading;
    const HeadingWords words(heading + " " + table.columns()[i].unit);
    if (!speed && (words.has({"speed", "rpm", "omega", "n"}))) {
      speed = i;
      const std::string unit = words.unit("rad/s");
      const bool rad = words.has({"rad"}) && words.has({"s", "sec"});
      found.to_speed = rad ? 1.0 : unitScale(unit.empty() ? "rpm" : unit, "rad/s");
    } else if (words.has({"phase", "lag", "lead", "angle"})) {
      ProbeColumns* const probe =
          phases.size() < found.probes.size() ? &found.probes[phases.size()] : nullptr;
      if (probe != nullptr) {
        probe->phase = i;
        probe->to_lag =
            (words.has({"lead"}) ? -1.0 : 1.0) * (words.has({"rad", "radian"}) ? 1.0 : kDegree);
      }
      phases.push_back(i);
    } else if (words.has({"amplitude", "amp", "magnitude", "1x", "displacement", "pp", "pk"})) {
      found.probes.push_back(amplitudeColumn(i, words, found.remarks));
    }
  }
  if (!speed || found.probes.empty() || phases.size() != found.probes.size()) {
    std::vector<std::string> headings;
    for (const TableColumn& column : table.columns()) {
      headings.push_back(column.heading);
    }
    throw InputError(fmt::format(
        "must have columns of the speed, and of the amplitude and the phase lag of each probe, "
        "such "
        "as speed_rpm,amplitude_um_pp,phase_lag_deg; found {} of the amplitude and {} of the phase "
        "in: {}{}",
        found.probes.size(), phases.size(),
        printable(fmt::format("{}", fmt::join(headings, ", ")), 300), table.how()));
  }
  found.speed = *speed;
  return found;
}

double lagOf(const std::complex<double>& z) {  // deg, 0 to 360
  const double lag = -std::arg(z) / kDegree;
  return lag < 0.0 ? lag + 360.0 : lag;
}

/// A length in um, else a number.
std::string amount(double value, const std::string& unit) {
  return unit == "m" ? fmt::format("{:.4g} um", 1.0e6 * value) : fmt::format("{:.4g}", value);
}

}  // namespace

BodeReport bodeReport(const std::string& file, const TableSettings& settings) try {
  TableReader table(file, settings);
  const VectorColumns columns = vectorColumns(table);
  BodeReport report;
  report.file = file;
  std::vector<std::size_t> selected = {columns.speed};
  for (const ProbeColumns& probe : columns.probes) {
    selected.insert(selected.end(), {probe.amplitude, probe.phase});
    report.probes.push_back(
        {probe.name.empty() ? fmt::format("probe {}", report.probes.size() + 1) : probe.name,
         probe.unit,
         {},
         {}});
  }
  table.select(selected);
  for (std::vector<double> row; table.next(row);) {
    for (std::size_t p = 0; p < report.probes.size(); ++p) {
      const ProbeColumns& of = columns.probes[p];
      const SpeedVector one{
          columns.to_speed * row[0],
          std::polar(1.0, -of.to_lag * row[2 * p + 2]) * of.scale * row[2 * p + 1]};
      if (std::isfinite(one.speed) && one.speed > 0.0 && std::isfinite(one.vector.real()) &&
          std::isfinite(one.vector.imag())) {
        report.probes[p].vectors.push_back(one);
      }
    }
  }
  for (MeasuredVectors& probe : report.probes) {
    if (probe.vectors.size() < kMinVectors) {
      throw InputError(fmt::format("{}: must have {} vectors at speeds > 0, found {}", probe.probe,
                                   kMinVectors, probe.vectors.size()));
    }
    std::stable_sort(probe.vectors.begin(), probe.vectors.end(),
                     [](const auto& a, const auto& b) { return a.speed < b.speed; });
    probe.fit = fitResonances(probe.vectors);
  }
  report.remarks = table.remarks();
  report.remarks.insert(report.remarks.end(), columns.remarks.begin(), columns.remarks.end());
  return report;
} catch (const InputError& error) {
  throw InputError(file + ": " + error.what());
}

Json json(const BodeReport& report) {
  Json out = {{"file", report.file}, {"remarks", report.remarks}, {"probes", Json::object()}};
  for (const MeasuredVectors& probe : report.probes) {
    Json one = {{"vectors", probe.vectors.size()},
                {"unit", probe.unit},
                {"slow_roll",
                 {{"amplitude", std::abs(probe.fit.slow_roll)},
                  {"peak_to_peak", 2.0 * std::abs(probe.fit.slow_roll)},
                  {"phase_lag", lagOf(probe.fit.slow_roll)},
                  {"standard_deviation", probe.fit.slow_roll_deviation}}},
                {"residual_rms", probe.fit.rms},
                {"critical_speeds", Json::array()}};
    for (const FittedResonance& r : probe.fit.resonances) {
      one["critical_speeds"].push_back({{"speed", r.speed},
                                        {"speed_deviation", r.speed_deviation},
                                        {"damping_ratio", r.damping_ratio},
                                        {"damping_ratio_deviation", r.damping_ratio_deviation},
                                        {"amplification_factor", r.amplification_factor()}});
    }
    out["probes"][probe.probe] = one;
  }
  return out;
}

std::string text(const BodeReport& report) {
  std::string out = report.file + "\n";
  out += joined(report.remarks, [](const auto& remark) { return "  " + remark + "\n"; });
  for (const MeasuredVectors& probe : report.probes) {
    const ResonanceFit& fit = probe.fit;
    out +=
        fmt::format("{}: {} vectors, {:.4g} to {:.4g} rad/s\n", printable(probe.probe),
                    probe.vectors.size(), probe.vectors.front().speed, probe.vectors.back().speed);
    for (const FittedResonance& r : fit.resonances) {
      out += fmt::format(
          "  critical speed {:.5g} +- {:.2g} rad/s ({:.5g} rpm), damping ratio {:.4g} +- {:.2g}, "
          "amplification factor {:.3g}\n",
          r.speed, r.speed_deviation, r.speed * 60.0 / kTwoPi, r.damping_ratio,
          r.damping_ratio_deviation, r.amplification_factor());
    }
    out += fit.resonances.empty() ? "  no resonance within these speeds\n" : "";
    out +=
        fmt::format("  slow roll {} peak to peak at a lag of {:.4g} deg (+- {} of a component)\n",
                    amount(2.0 * std::abs(fit.slow_roll), probe.unit), lagOf(fit.slow_roll),
                    amount(2.0 * fit.slow_roll_deviation, probe.unit));
    out += fmt::format("  residual {} rms\n", amount(fit.rms, probe.unit));
  }
  return out;
}

CsvTables tables(const BodeReport& report) {
  CsvTable vectors{"",
                   {"probe", "speed", "amplitude", "phase_lag", "fit_amplitude", "fit_phase_lag"}};
  CsvTable criticals{"critical_speeds",
                     {"probe", "speed", "damping_ratio", "amplification_factor"}};
  for (const MeasuredVectors& probe : report.probes) {
    for (const SpeedVector& one : probe.vectors) {
      const std::complex<double> roll = probe.fit.slow_roll;
      vectors.rows.push_back({{"probe", probe.probe},
                              {"speed", one.speed},
                              {"amplitude", std::abs(one.vector - roll)},
                              {"phase_lag", lagOf(one.vector - roll)},
                              {"fit_amplitude", std::abs(probe.fit.at(one.speed) - roll)},
                              {"fit_phase_lag", lagOf(probe.fit.at(one.speed) - roll)}});
    }
    for (const FittedResonance& r : probe.fit.resonances) {
      criticals.rows.push_back({{"probe", probe.probe},
                                {"speed", r.speed},
                                {"damping_ratio", r.damping_ratio},
                                {"amplification_factor", r.amplification_factor()}});
    }
  }
  return {vectors, criticals};
}

Figure figure(const BodeReport& report) {
  Figure figure;
  figure.title = "1X without the slow roll";
  Chart amplitude, phase;
  amplitude.x = {"speed (rad/s)", false, true, SecondScale{"rpm", 60.0 / kTwoPi}};
  const bool length = report.probes.front().unit == "m";
  amplitude.y = {length ? "amplitude (um)" : "amplitude"};
  phase.x = {"speed (rad/s)", false, true};
  phase.y = {"phase lag (deg)"};
  phase.y.degrees = phase.y.inverted = true;
  for (const MeasuredVectors& probe : report.probes) {
    Series measured{probe.probe, {}, {}}, fitted{"fit", {}, {}}, lag{probe.probe, {}, {}};
    measured.line = lag.line = false;
    measured.marks = lag.marks = Marks::kDots;
    for (const SpeedVector& one : probe.vectors) {
      const std::complex<double> z = one.vector - probe.fit.slow_roll;
      for (Series* series : {&measured, &fitted, &lag}) {
        series->x.push_back(one.speed);
      }
      const double scale = length ? 1.0e6 : 1.0;
      measured.y.push_back(scale * std::abs(z));
      fitted.y.push_back(scale * std::abs(probe.fit.at(one.speed) - probe.fit.slow_roll));
      lag.y.push_back(lagOf(z));
    }
    amplitude.series.insert(amplitude.series.end(), {measured, fitted});
    phase.series.push_back(lag);
    for (const FittedResonance& r : probe.fit.resonances) {
      amplitude.vertical.push_back({r.speed, fmt::format("{:.4g}", r.speed)});
    }
  }
  figure.charts = {amplitude, phase};
  return figure;
}

}  // namespace whirl_twin
