#include "reports/optimum_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/study_report.h"

namespace whirl_twin {

namespace {

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
  std::size_t width = 7;
  for (const std::size_t j : asked.over) {
    width = std::max(width, nameWithUnit(study.vary[j].path, study.vary[j].unit).size());
  }
  for (const Measure& measure : study.measures) {
    width = std::max(width, nameWithUnit(measure.name, measure.unit).size());
  }
  text += fmt::format("\n{:{}} {:>12} {:>12} {:>12} {:>12}\n", "", width, "from", "to", "start",
                      found ? "best" : "");
  for (const std::size_t j : asked.over) {
    const Variation& v = study.vary[j];
    text += fmt::format("{:{}} {:12.6g} {:12.6g} {:12.6g}", nameWithUnit(v.path, v.unit), width,
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
    for (const Requirement& requirement : study.requirements) {
      text += fmt::format("  {}", whirl_twin::text(requirement, study));
    }
    text += "\n";
  }
  return text;
}

Json json(const Study& study, const Optimum& optimum) {
  const Optimization& asked = *study.optimization;
  const bool found = !optimum.values.empty();
  Json json;
  json["study"] = study.source;
  json[asked.maximize ? "maximize" : "minimize"] = study.measures[asked.measure].name;
  json["method"] = asked.method;
  json["evaluations"] = optimum.evaluations;
  json["failed"] = optimum.failures;
  json["converged"] = optimum.converged;
  json["ended"] = optimum.ended;
  json["found"] = found;
  json["numbers"] = Json::object();
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
  json["requirements"] = Json::array();
  for (const Requirement& requirement : study.requirements) {
    json["requirements"].push_back(whirl_twin::text(requirement, study));
  }
  return json;
}

}  // namespace whirl_twin
