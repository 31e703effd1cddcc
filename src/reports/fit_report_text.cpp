#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "messages/names.h"
#include "reports/fit_report.h"

namespace whirl_twin {

namespace {

constexpr double kStrong = 0.9;      // a correlation worth a word
constexpr double kPersistent = 0.8;  // of residuals that are far from white
constexpr std::size_t kMostPairs = 6;

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
  pairs.resize(std::min(pairs.size(), kMostPairs));
  std::string out;
  for (const Pair& pair : pairs) {
    out += fmt::format("  {} and {}: correlation {:.4f}\n",
                       fit.unknowns[static_cast<std::size_t>(pair.a)].name,
                       fit.unknowns[static_cast<std::size_t>(pair.b)].name, pair.correlation);
  }
  return out.empty() ? "" : "strongly correlated\n" + out;
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
      if (!run.train || study.validate_only) {  // others stand among what was found
        out += fmt::format("      {} {:.4g} {}\n", printable(own.name, 60), value, own.unit);
      }
    }
    for (const std::string& remark : run.data.remarks) {
      out += "      " + printable(remark, 200) + "\n";
    }
  }
  if (persistent) {
    out +=
        "The residual is not white: the model does not describe all of the motion, and the values "
        "are less\ncertain than their standard deviations.\n";
  }
  return out;
}

}  // namespace

std::string checkText(const FitStudy& study) {
  std::string out;
  for (const StudyRun& run : study.runs) {
    out += fmt::format("{}: {} rows, {:.6g} s\n", printable(run.file), run.data.time.size(),
                       run.data.duration());
    for (const std::string& remark : run.data.remarks) {
      out += "  " + printable(remark, 200) + "\n";
    }
    out += run.data.remarks.empty() ? "  no anomalies\n" : "";
  }
  return out;
}

std::string directionText(const ShootingFit& fit, const UntoldDirection& direction) {
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

std::string text(const FitStudy& study, const ShootingFit& fit) {
  std::string out = fittedParameterText(fit);
  if (!fit.information.untold.empty()) {
    out += "Not identifiable from the runs (these parameters keep their start values)\n";
    for (const UntoldDirection& direction : fit.information.untold) {
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

}  // namespace whirl_twin
