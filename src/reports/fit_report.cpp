#include "reports/fit_report.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numeric>
#include <stdexcept>

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr double kStrong = 0.9;      // a correlation worth a word
constexpr double kPersistent = 0.8;  // of residuals that are far from white
constexpr std::size_t kMaxPairs = 6;
constexpr std::size_t kMaxRemark = 200;

/// "theta1, mass2 change together, by +1, -0.5 of their values: ..." of a direction that is not
/// identifiable from the runs.
std::string directionText(const ShootingFit& fit, const UnidentifiableDirection& direction) {
  std::vector<Eigen::Index> places(static_cast<std::size_t>(direction.parts.size()));
  std::iota(places.begin(), places.end(), 0);
  std::sort(places.begin(), places.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::fabs(direction.parts[a]) > std::fabs(direction.parts[b]);
  });
  std::vector<std::string> names, parts;
  for (const Eigen::Index i : places) {
    if (direction.takes_part[static_cast<std::size_t>(i)]) {
      names.push_back(fit.unknowns[static_cast<std::size_t>(i)].name);
      parts.push_back(fmt::format("{:+.2g}", direction.parts[i]));
    }
  }
  const std::string by =
      std::isfinite(direction.deviation) && direction.deviation < 1.0e6
          ? fmt::format("standard deviation {:.2g} times that", direction.deviation)
          : "without any effect";
  return names.size() == 1 ? fmt::format("{}: {}", names.front(), by)
                           : fmt::format("{} change together, by {} of their values: {}",
                                         fmt::join(names, ", "), fmt::join(parts, ", "), by);
}

std::string fittedParameterText(const ShootingFit& fit) {
  std::string out;
  if (fit.unknowns.empty()) {
    return "only the initial states of the windows were fitted\n";
  }
  out += fmt::format("{:<28} {:>16} {:>14}\n", "fitted", "value", "std. dev.");
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    const Unknown& u = fit.unknowns[i];
    const double deviation = fit.information.deviation[static_cast<Eigen::Index>(i)];
    const std::string name =
        u.unit.empty() || u.unit == "-" ? u.name : fmt::format("{} ({})", u.name, u.unit);
    out += fmt::format(
        "  {:<26} {:>16.8g} {:>14}{}\n", printable(name), fit.theta[static_cast<Eigen::Index>(i)],
        std::isfinite(deviation) ? fmt::format("{:.3g}", deviation) : std::string("unidentifiable"),
        fit.at_bound[i] ? "   at its bound" : "");
  }
  return out;
}

std::string correlationText(const ShootingFit& fit) {
  struct Pair {
    Eigen::Index a, b;
    double correlation;
  };
  std::vector<Pair> pairs;
  const Eigen::MatrixXd& c = fit.information.correlation;
  for (Eigen::Index i = 0; i < c.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::fabs(c(i, j)) > kStrong) {
        pairs.push_back({j, i, c(i, j)});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::fabs(a.correlation) > std::fabs(b.correlation);
  });
  pairs.resize(std::min(pairs.size(), kMaxPairs));
  std::string out;
  for (const Pair& pair : pairs) {
    out += fmt::format("  {} and {}: correlation {:.4f}\n",
                       fit.unknowns[static_cast<std::size_t>(pair.a)].name,
                       fit.unknowns[static_cast<std::size_t>(pair.b)].name, pair.correlation);
  }
  return out.empty() ? "" : "strongly correlated\n" + out;
}

std::string remarksText(const StudyRun& run, const std::string& indent) {
  return joined(run.data.remarks, [&](const std::string& remark) {
    return indent + printable(remark, kMaxRemark) + "\n";
  });
}

std::string runText(const FitStudy& study, const ShootingFit& fit) {
  std::string out = "runs                                       rms of the residual\n";
  bool persistent = false;
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    const StudyRun& run = study.runs[r];
    out +=
        fmt::format("  {:<28} {:<10}", printable(run.file, 28), run.train ? "train" : "validate");
    for (std::size_t c = 0; c < run.measured.size(); ++c) {
      const double rms = fit.runs[r].rms[c];
      out += fmt::format("  {} {}", run.measured[c].name,
                         std::isfinite(rms) ? fmt::format("{:.4g} {}", rms, run.measured[c].unit)
                                            : std::string("the motion stops before the end"));
      persistent = persistent || fit.runs[r].persistence[c] > kPersistent;
    }
    out += "\n";
    for (const auto& [own, value] : fit.runs[r].own) {
      if (!run.train || study.validate_only) {  // the others are fitted values above
        out += fmt::format("      {} {:.4g} {}\n", printable(own.name, 60), value, own.unit);
      }
    }
    out += remarksText(run, "      ");
  }
  if (persistent) {
    out +=
        "The residual is not white: the model does not describe all of the motion, and the values "
        "are less\ncertain than their standard deviations.\n";
  }
  return out;
}

/// The node at `bearings[0].kxx` below a map; made where there is none.
YAML::Node nodeAt(YAML::Node node, const std::string& path) {
  std::size_t from = 0;
  while (from < path.size()) {
    if (path[from] == '[') {
      const std::size_t end = path.find(']', from);
      node.reset(node[std::stoul(path.substr(from + 1, end - from - 1))]);
      from = end + 1;
    } else {
      from += path[from] == '.' ? 1 : 0;
      const std::size_t end = std::min(path.find_first_of(".[", from), path.size());
      node.reset(node[path.substr(from, end - from)]);
      from = end;
    }
  }
  return node;
}

void moveTables(const YAML::Node& scene, const std::filesystem::path& from,
                const std::filesystem::path& to) {
  for (const auto& system : scene["systems"]) {
    const YAML::Node inputs = system.second["inputs"];
    if (!inputs || !inputs.IsMap()) {
      continue;
    }
    for (const auto& input : inputs) {
      if (!input.second.IsMap() || !input.second["table"]) {
        continue;
      }
      const std::filesystem::path table = input.second["table"].as<std::string>();
      if (table.is_relative()) {
        YAML::Node place = input.second["table"];
        place = std::filesystem::absolute(from / table)
                    .lexically_normal()
                    .lexically_relative(std::filesystem::absolute(to).lexically_normal())
                    .string();
      }
    }
  }
}

/// Of one parameter with those before it, which have a spread if they are identifiable.
void addCorrelations(const ShootingFit& fit, std::size_t i, YAML::Node spread) {
  for (std::size_t j = 0; j < i; ++j) {
    const Unknown& other = fit.unknowns[j];
    const double r =
        fit.information.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    if (other.kind == Unknown::Kind::kParameter && spread[other.subject] && std::isfinite(r)) {
      YAML::Node pair(YAML::NodeType::Sequence);
      pair.SetStyle(YAML::EmitterStyle::Flow);
      pair.push_back(other.subject);
      pair.push_back(fit.unknowns[i].subject);
      pair.push_back(fmt::format("{:.12g}", std::clamp(r, -1.0, 1.0)));
      spread["correlations"].push_back(pair);
    }
  }
}

}  // namespace

std::string checkText(const FitStudy& study) {
  std::string out;
  for (const StudyRun& run : study.runs) {
    out += fmt::format("{}: {} rows, {:.6g} s\n", printable(run.file), run.data.time.size(),
                       run.data.duration());
    out += remarksText(run, "  ");
    out += run.data.remarks.empty() ? "  no anomalies\n" : "";
  }
  return out;
}

std::string text(const FitStudy& study, const ShootingFit& fit) {
  std::string out = fittedParameterText(fit);
  if (!fit.information.unidentifiable.empty()) {
    out += "Not identifiable from the runs (these parameters keep their start values)\n";
    for (const UnidentifiableDirection& direction : fit.information.unidentifiable) {
      out += "  " + directionText(fit, direction) + "\n";
    }
  }
  out += correlationText(fit);
  out += runText(study, fit);
  if (!fit.unknowns.empty() && fit.iterations > 0) {
    out += fmt::format("{} after {} iterations\n", fit.converged ? "converged" : "NOT CONVERGED",
                       fit.iterations);
  }
  return out;
}

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
  Json json{{"runs", Json::object()}};
  for (const StudyRun& run : study.runs) {
    json["runs"][run.file] = {{"rows", run.data.time.size()},
                              {"duration", run.data.duration()},
                              {"remarks", run.data.remarks}};
  }
  return json;
}

Json json(const FitStudy& study, const ShootingFit& fit) {
  Json json{{"scene", study.scene_path}, {"system", study.system}, {"parameters", Json::object()}};
  const auto n = static_cast<Eigen::Index>(fit.unknowns.size());
  const CsvTable parameters = tables(fit).front();
  for (Json row : parameters.rows) {
    const std::string name = row["parameter"];
    row.erase("parameter");
    json["parameters"][name] = row;
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
  json["directions"] = listJson(
      fit.information.unidentifiable,
      [&](const UnidentifiableDirection& direction) { return directionText(fit, direction); });
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(fit.information.deviation[i]) && !fit.information.unidentifiable.empty()) {
      json["undetermined"].push_back(fit.unknowns[static_cast<std::size_t>(i)].name);
    }
  }
  json["iterations"] = fit.iterations;
  json["converged"] = fit.converged;
  return json;
}

std::string fittedScene(const FitStudy& study, const ShootingFit& fit, const std::string& folder) {
  YAML::Node scene = YAML::LoadFile(study.scene_path);
  YAML::Node system = scene["systems"][study.system];
  YAML::Node parameters = system["parameters"];
  if (system["spread"]) {
    system["spread"].remove("correlations");  // replaced by those of the runs
  }
  std::string head =
      fmt::format("# {} of this scene was fitted to measured runs by `twin fit {}`.\n",
                  study.system, printable(std::filesystem::path(study.source).filename().string()));
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    const Unknown& u = fit.unknowns[i];
    const auto k = static_cast<Eigen::Index>(i);
    if (u.kind == Unknown::Kind::kParameter) {
      YAML::Node place = nodeAt(parameters, u.subject);
      place = fmt::format("{:.12g}", fit.theta[k]);
    }
    const double deviation = fit.information.deviation[k];
    if (u.kind == Unknown::Kind::kParameter && deviation > 0.0 && std::isfinite(deviation)) {
      YAML::Node spread(YAML::NodeType::Map);  // the monitor evaluates the system within it
      spread["standard_deviation"] = fmt::format("{:.3g}", deviation);
      system["spread"][u.subject] = spread;
      addCorrelations(fit, i, system["spread"]);
    }
    head += fmt::format("#   {:<24} {:>16.9g}  {}\n", u.name, fit.theta[k],
                        std::isfinite(deviation)
                            ? fmt::format("standard deviation {:.3g} {}", deviation, u.unit)
                            : std::string("not identifiable from the runs: unchanged"));
  }
  for (const UnidentifiableDirection& direction : fit.information.unidentifiable) {
    head += "# Not identifiable: " + printable(directionText(fit, direction), kMaxRemark) + "\n";
  }
  moveTables(scene, std::filesystem::path(study.scene_path).parent_path(), folder);
  YAML::Emitter out;
  out << scene;
  return head + out.c_str() + "\n";
}

}  // namespace whirl_twin
