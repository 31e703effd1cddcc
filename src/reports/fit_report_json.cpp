#include <cmath>

#include "reports/fit_report.h"

namespace whirl_twin {

CsvTables tables(const ShootingFit& fit) {
  CsvTable table{"", {"parameter", "value", "standard_deviation", "unit", "at_bound"}};
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    table.rows.push_back({{"parameter", fit.unknowns[i].name},
                          {"value", fit.theta[k]},
                          {"standard_deviation", fit.information.deviation[k]},
                          {"unit", fit.unknowns[i].unit},
                          {"at_bound", static_cast<bool>(fit.at_bound[i])}});
  }
  return {table};
}

Json checkJson(const FitStudy& study) {
  Json json;
  json["runs"] = Json::object();
  for (const StudyRun& run : study.runs) {
    Json& one = json["runs"][run.file];
    one["rows"] = run.data.time.size();
    one["duration"] = run.data.duration();
    one["remarks"] = run.data.remarks;
  }
  return json;
}

Json json(const FitStudy& study, const ShootingFit& fit) {
  Json json;
  json["scene"] = study.scene_path;
  json["system"] = study.system;
  json["parameters"] = Json::object();
  const auto n = static_cast<Eigen::Index>(fit.unknowns.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& u = fit.unknowns[static_cast<std::size_t>(i)];
    Json& one = json["parameters"][u.name];
    one["value"] = fit.theta[i];
    one["standard_deviation"] = fit.information.deviation[i];
    one["unit"] = u.unit;
    one["at_bound"] = static_cast<bool>(fit.at_bound[static_cast<std::size_t>(i)]);
  }
  json["correlations"] = Json::array();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::isfinite(fit.information.correlation(i, j))) {
        json["correlations"].push_back({fit.unknowns[static_cast<std::size_t>(j)].name,
                                        fit.unknowns[static_cast<std::size_t>(i)].name,
                                        fit.information.correlation(i, j)});
      }
    }
  }
  json["runs"] = Json::object();
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    const StudyRun& run = study.runs[r];
    Json& one = json["runs"][run.file];
    one["use"] = run.train ? "train" : "validate";
    for (std::size_t c = 0; c < run.measured.size(); ++c) {
      one["rms"][run.measured[c].name] = fit.runs[r].rms[c];
      one["persistence"][run.measured[c].name] = fit.runs[r].persistence[c];
    }
    for (const auto& [own, value] : fit.runs[r].own) {
      one["own"][own.name] = value;
    }
    one["remarks"] = run.data.remarks;
  }
  json["undetermined"] = Json::array();
  json["directions"] = Json::array();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(fit.information.deviation[i]) && !fit.information.untold.empty()) {
      json["undetermined"].push_back(fit.unknowns[static_cast<std::size_t>(i)].name);
    }
  }
  for (const UntoldDirection& direction : fit.information.untold) {
    json["directions"].push_back(directionText(fit, direction));
  }
  json["iterations"] = fit.iterations;
  json["converged"] = fit.converged;
  return json;
}

}  // namespace whirl_twin
