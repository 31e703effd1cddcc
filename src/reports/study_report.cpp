#include "reports/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "reports/asked_cost.h"

namespace whirl_twin {

namespace {

/// Wide enough for of(one) of each.
template <class All, class Of>
std::size_t widthOf(const All& all, const Of& of) {
  std::size_t width = 0;
  for (const auto& one : all) {
    width = std::max(width, of(one).size());
  }
  return width;
}

std::string variationPath(const Variation& variation) {
  return variation.path;
}
std::string measureName(const Measure& measure) {
  return measure.name;
}

std::string estimateText(const Estimate& estimate) {
  return std::isfinite(estimate.value) ? fmt::format("{:10.4g} [{:9.4g}, {:9.4g}]", estimate.value,
                                                     estimate.low, estimate.high)
                                       : fmt::format("{:>10} {:22}", "-", "");
}

/// Of a measure; "undefined" or "infinite" where it is no number.
std::string inFull(double value) {
  return std::isnan(value)   ? "undefined"
         : std::isinf(value) ? (value > 0.0 ? "infinite" : "minus infinite")
                             : fmt::format("{}", value);
}

/// In a column of a table.
std::string studyCell(double value) {
  return std::isfinite(value) ? fmt::format(" {:11.5g}", value) : fmt::format(" {:>11}", "-");
}

/// "[1.2, 1.4]"; "-": the points are too few to bound it there.
std::string intervalText(const std::array<double, 2>& interval) {
  const auto bound = [](double x) { return std::isfinite(x) ? fmt::format("{:.5g}", x) : "-"; };
  return fmt::format("[{}, {}]", bound(interval[0]), bound(interval[1]));
}

std::string yieldText(const Yield& yield) {
  return fmt::format("{} of {} pass, {:.4g} % [{:.4g}, {:.4g}]", yield.passed, yield.of,
                     100.0 * yield.part(), 100.0 * yield.low, 100.0 * yield.high);
}

std::string tableOf(
    const Study& study, const std::string& measure,
    const std::vector<std::pair<const char*, const std::vector<Estimate>*>>& columns,
    const std::string& note) {
  const std::size_t width = widthOf(study.vary, variationPath);
  std::string text = fmt::format("\n{}{}\n  {:{}}", measure, note, "", width);
  for (const auto& [name, estimates] : columns) {
    text += fmt::format("  {:<33}", name);
  }
  text += "\n";
  for (std::size_t j = 0; j < study.vary.size(); ++j) {
    text += fmt::format("  {:{}}", study.vary[j].path, width);
    for (const auto& [name, estimates] : columns) {
      text += "  " + estimateText((*estimates)[j]);
    }
    text += "\n";
  }
  return text;
}

/// A remark on the indices of a measure.
std::string noteOf(const std::vector<Estimate>& estimates, std::uint64_t left_out,
                   const char* what) {
  std::string note;
  if (!std::isfinite(estimates.front().value)) {
    note += ": does not vary, or is defined at too few points";
  }
  if (left_out > 0) {
    note += fmt::format("; without {} {} with points that failed or are undefined", left_out, what);
  }
  return note;
}

Json studyEstimateJson(const Estimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

Json yieldJson(const Yield& yield) {
  return {{"passed", yield.passed},
          {"of", yield.of},
          {"part", yield.part()},
          {"low", yield.low},
          {"high", yield.high}};
}

Json distributedJson(const Distributed& d) {
  Json json{{"count", d.count},       {"undefined", d.undefined},
            {"mean", d.mean},         {"standard_deviation", d.deviation},
            {"smallest", d.smallest}, {"largest", d.largest}};
  for (std::size_t k = 0; k < kPercentiles.size(); ++k) {
    json["percentiles"][fmt::format("{:g}", kPercentiles[k])] = d.percentiles[k];
    if (!d.intervals.empty()) {
      json["percentile_intervals"][fmt::format("{:g}", kPercentiles[k])] = {d.intervals[k][0],
                                                                            d.intervals[k][1]};
    }
  }
  return json;
}

Json valuesJson(const Study& study, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t j = 0; j < values.size(); ++j) {
    json[study.vary[j].path] = values[j];
  }
  return json;
}

/// "smallest", "largest": the end of its range that a number is at; "": neither.
std::string endOf(const Variation& variation, double value) {
  constexpr double kAt = 1.0e-6;  // of the range
  const double low = variation.distribution.smallest();
  const double high = variation.distribution.largest();
  const double near = kAt * (high - low);
  return value <= low + near ? "smallest" : value >= high - near ? "largest" : "";
}

/// In a column of a table.
std::string optimumCell(double value) {
  return std::isnan(value)   ? fmt::format(" {:>12}", "undefined")
         : std::isinf(value) ? fmt::format(" {:>12}", value > 0.0 ? "infinite" : "-infinite")
                             : fmt::format(" {:12.6g}", value);
}

/// In the order of the study.
std::vector<double> measuresAtStart(const Study& study, const Optimum& optimum) {
  return optimum.at_start.measures.empty()
             ? std::vector<double>(study.measures.size(), std::nan(""))
             : optimum.at_start.measures;
}

}  // namespace

std::string nameWithUnit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "-" ? name : fmt::format("{} ({})", name, unit);
}

std::string text(const Study& study, const Answers& answers) {
  std::string text = fmt::format(
      "{}: {} points, {} by {}", study.source, answers.points,
      study.vary.size() == 1 ? "one parameter" : fmt::format("{} parameters", study.vary.size()),
      name(study.design.kind));
  text += answers.failures > 0 ? fmt::format(", {} failed\n\n", answers.failures) : "\n\n";
  const std::size_t width = std::max<std::size_t>(7, widthOf(study.measures, measureName));
  text += fmt::format("{:{}} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11}\n", "measure", width,
                      "mean", "std. dev.", "minimum", "5 %", "median", "95 %", "maximum");
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    const Distributed& d = answers.measures[k];
    text += fmt::format("{:{}}", study.measures[k].name, width);
    for (const double value : {d.mean, d.deviation, d.smallest, d.percentiles[1], d.percentiles[3],
                               d.percentiles[5], d.largest}) {
      text += studyCell(value);
    }
    text += d.undefined > 0 ? fmt::format("  undefined at {}\n", d.undefined) : "\n";
    if (!d.intervals.empty()) {
      text += fmt::format("{:{}} 95 % intervals: 5 % {}, median {}, 95 % {}\n", "", width,
                          intervalText(d.intervals[1]), intervalText(d.intervals[3]),
                          intervalText(d.intervals[5]));
    }
  }
  if (answers.yield) {
    text += "\n";
    for (std::size_t k = 0; k < study.requirements.size(); ++k) {
      text += fmt::format("{}: {}\n", whirl_twin::text(study.requirements[k], study),
                          yieldText(answers.requirements[k]));
    }
    if (study.requirements.size() > 1) {
      text += fmt::format("all: {}\n", yieldText(*answers.yield));
    }
  }
  for (std::size_t k = 0; k < answers.sobol.size(); ++k) {
    const SobolIndices& s = answers.sobol[k];
    text += tableOf(study, study.measures[k].name, {{"first order", &s.first}, {"total", &s.total}},
                    noteOf(s.first, s.left_out, "rows"));
  }
  for (std::size_t k = 0; k < answers.morris.size(); ++k) {
    const MorrisEffects& m = answers.morris[k];
    text += tableOf(study, study.measures[k].name,
                    {{"mean magnitude of effects", &m.mean_magnitude},
                     {"mean", &m.mean},
                     {"standard deviation", &m.deviation}},
                    noteOf(m.mean, m.left_out, "trajectories"));
  }
  return text;
}

Json json(const Study& study, const Answers& answers) {
  Json json;
  json["study"] = study.source;
  json["design"] = name(study.design.kind);
  json["points"] = answers.points;
  json["failed"] = answers.failures;
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    Json& measure = json["measures"][study.measures[k].name];
    measure = distributedJson(answers.measures[k]);
    if (!answers.sobol.empty()) {
      const SobolIndices& s = answers.sobol[k];
      measure["rows_left_out"] = s.left_out;
      for (std::size_t j = 0; j < study.vary.size(); ++j) {
        measure["sobol"][study.vary[j].path] = {{"first", studyEstimateJson(s.first[j])},
                                                {"total", studyEstimateJson(s.total[j])}};
      }
    }
    if (!answers.morris.empty()) {
      const MorrisEffects& m = answers.morris[k];
      measure["trajectories_left_out"] = m.left_out;
      for (std::size_t j = 0; j < study.vary.size(); ++j) {
        measure["morris"][study.vary[j].path] = {
            {"mean", studyEstimateJson(m.mean[j])},
            {"mean_magnitude", studyEstimateJson(m.mean_magnitude[j])},
            {"standard_deviation", studyEstimateJson(m.deviation[j])}};
      }
    }
  }
  json["requirements"] = Json::array();
  for (std::size_t k = 0; k < study.requirements.size(); ++k) {
    Json entry{{"requirement", whirl_twin::text(study.requirements[k], study)}};
    entry.update(yieldJson(answers.requirements[k]));
    json["requirements"].push_back(entry);
  }
  json["yield"] = answers.yield ? yieldJson(*answers.yield) : Json();
  return json;
}

std::string text(const Study& study, const StudyPoint& point) {
  std::string text = fmt::format("point {} of {}\n", point.point, study.points());
  for (std::size_t j = 0; j < point.values.size(); ++j) {
    const std::string& unit = study.vary[j].unit;
    text += fmt::format("  {} = {}{}\n", study.vary[j].path, point.values[j],
                        unit.empty() || unit == "-" ? "" : " " + unit);
  }
  if (!point.outcome.failure.empty()) {
    return text + fmt::format("failed: {}\n", point.outcome.failure);
  }
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    text += fmt::format("{} = {}\n", study.measures[k].name, inFull(point.outcome.measures[k]));
  }
  return text;
}

Json json(const Study& study, const StudyPoint& point) {
  Json json{{"point", point.point}, {"vary", valuesJson(study, point.values)}};
  json["failure"] = point.outcome.failure.empty() ? Json() : Json(point.outcome.failure);
  json["measures"] = Json::object();
  for (std::size_t k = 0; k < point.outcome.measures.size(); ++k) {
    json["measures"][study.measures[k].name] = point.outcome.measures[k];
  }
  return json;
}

StudyStatus statusOf(const Study& study, const ResultFolder& folder) {
  StudyStatus status;
  const std::vector<bool> finished = folder.finished();
  for (std::uint64_t block = 0; block < finished.size(); ++block) {
    status.done += finished[block] ? study.sizeOf(block) : 0;
  }
  const ResultFolder::Pace pace = folder.pace();
  status.rate = pace.seconds > 0.0 ? static_cast<double>(pace.blocks - 1) *
                                         static_cast<double>(study.block) / pace.seconds
                                   : kNaN;
  status.left = static_cast<double>(study.points() - status.done) / status.rate;
  return status;
}

std::string text(const Study& study, const StudyStatus& status) {
  const double part = static_cast<double>(status.done) / static_cast<double>(study.points());
  std::string text =
      fmt::format("{} of {} points, {:.1f} %", status.done, study.points(), 100.0 * part);
  if (std::isfinite(status.rate)) {
    text += fmt::format(", {:.3g} per second", status.rate);
    if (status.done < study.points()) {
      text += fmt::format(", {} remaining at this rate", durationText(status.left));
    }
  }
  return text + "\n";
}

Json json(const Study& study, const StudyStatus& status) {
  return {{"done", status.done},
          {"points", study.points()},
          {"rate", status.rate},
          {"seconds_left", status.left}};
}

std::string text(const Study& study, const Optimum& optimum) {
  const Optimization& asked = *study.optimization;
  std::string text = fmt::format(
      "{}: {} of {} over {} by {}: {} evaluations, {}{}\n", study.source,
      asked.maximize ? "maximum" : "minimum", study.measures[asked.measure].name,
      asked.over.size() == 1 ? "one parameter" : fmt::format("{} parameters", asked.over.size()),
      asked.method, optimum.evaluations,
      optimum.failures > 0 ? fmt::format("{} of which failed, ", optimum.failures) : "",
      optimum.ended);
  const bool found = !optimum.values.empty();
  if (!found) {
    text += "no point satisfies the requirements\n";
  }
  const auto label = [&](std::size_t j) {
    return nameWithUnit(study.vary[j].path, study.vary[j].unit);
  };
  const std::size_t width = std::max({std::size_t{7}, widthOf(asked.over, label),
                                      widthOf(study.measures, [](const Measure& measure) {
                                        return nameWithUnit(measure.name, measure.unit);
                                      })});
  text += fmt::format("\n{:{}} {:>12} {:>12} {:>12} {:>12}\n", "", width, "from", "to", "start",
                      found ? "best" : "");
  for (const std::size_t j : asked.over) {
    const Variation& v = study.vary[j];
    text += fmt::format("{:{}} {:12.6g} {:12.6g} {:12.6g}", label(j), width,
                        v.distribution.smallest(), v.distribution.largest(), optimum.start[j]);
    if (found) {
      const std::string end = endOf(v, optimum.values[j]);
      text += fmt::format(" {:12.6g}{}", optimum.values[j],
                          end.empty() ? "" : "  at the " + end + " of its range");
    }
    text += "\n";
  }
  text += "\n";
  const std::vector<double> start = measuresAtStart(study, optimum);
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    const Measure& measure = study.measures[k];
    text +=
        fmt::format("{:{}} {:>12} {:>12}", nameWithUnit(measure.name, measure.unit), width, "", "");
    text += optimumCell(start[k]) + (found ? optimumCell(optimum.measures[k]) : "") + "\n";
  }
  if (found && !study.requirements.empty()) {
    text += "\nrequirements met:";
    text += joined(study.requirements, [&](const Requirement& requirement) {
      return "  " + whirl_twin::text(requirement, study);
    });
    text += "\n";
  }
  return text;
}

Json json(const Study& study, const Optimum& optimum) {
  const Optimization& asked = *study.optimization;
  const bool found = !optimum.values.empty();
  Json json{{"study", study.source},
            {asked.maximize ? "maximize" : "minimize", study.measures[asked.measure].name},
            {"method", asked.method},
            {"evaluations", optimum.evaluations},
            {"failed", optimum.failures},
            {"converged", optimum.converged},
            {"ended", optimum.ended},
            {"found", found},
            {"numbers", Json::object()}};
  for (const std::size_t j : asked.over) {
    const Variation& v = study.vary[j];
    Json& number = json["numbers"][v.path];
    number = {{"from", v.distribution.smallest()},
              {"to", v.distribution.largest()},
              {"start", optimum.start[j]},
              {"unit", v.unit}};
    if (found) {
      number["best"] = optimum.values[j];
      number["at_end"] = endOf(v, optimum.values[j]);
    }
  }
  const std::vector<double> start = measuresAtStart(study, optimum);
  for (std::size_t k = 0; k < study.measures.size(); ++k) {
    Json& measure = json["measures"][study.measures[k].name];
    measure = {{"start", start[k]}, {"unit", study.measures[k].unit}};
    if (found) {
      measure["best"] = optimum.measures[k];
    }
  }
  json["requirements"] = listJson(study.requirements, [&](const Requirement& requirement) {
    return whirl_twin::text(requirement, study);
  });
  return json;
}

}  // namespace whirl_twin
