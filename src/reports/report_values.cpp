#include "reports/report_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

/// Rounding beside the largest of its row and of its column, which may be in other units.
bool isNoise(const Eigen::MatrixXd& m, Eigen::Index i, Eigen::Index j) {
  constexpr double kRounding = 1.0e-14;
  return std::fabs(m(i, j)) <= kRounding * std::sqrt(m.row(i).cwiseAbs().maxCoeff()) *
                                   std::sqrt(m.col(j).cwiseAbs().maxCoeff());
}

/// Of films alone: they have no highest speed.
bool areFilms(const DataSpeeds& tables) {
  return std::isinf(tables.to);
}

}  // namespace

ChartAxis tightAxis(const std::string& quantity, const ShownUnit& unit) {
  ChartAxis axis{unit.label(quantity), false, true};
  axis.unit = unit.size;
  return axis;
}

ChartAxis tightAxis(const std::string& quantity, const ShownUnit& unit, const ShownUnit& beside) {
  ChartAxis axis = tightAxis(quantity, unit);
  axis.second = SecondScale{beside.name, unit.size / beside.size};
  return axis;
}

ChartAxis lagAxis(const std::string& quantity, const ShownUnit& angle) {
  ChartAxis axis{angle.label(quantity)};
  axis.unit = angle.size / kDegree;
  axis.degrees = angle.size == kDegree;
  axis.inverted = true;
  return axis;
}

Json complexJson(const std::complex<double>& z) {
  return {z.real(), z.imag()};
}

Json textOrNull(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json arrayJson(const std::vector<double>& x) {
  return listJson(x, [](double value) { return value + 0.0; });
}

Json arrayJson(const Eigen::VectorXd& x) {
  return arrayJson(std::vector<double>(x.data(), x.data() + x.size()));
}

Json matrixJson(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    rows.push_back(arrayJson(Eigen::VectorXd(m.row(i))));
  }
  return rows;
}

std::string matrixText(const char* title, const Eigen::MatrixXd& m) {
  if (m.isZero(0.0)) {
    return fmt::format("    {:<15} 0\n", title);
  }
  std::string out;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    out += fmt::format("    {:<15}", i == 0 ? title : "");
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      out += fmt::format(" {:>13.6g}", isNoise(m, i, j) ? 0.0 : m(i, j) + 0.0);
    }
    out += "\n";
  }
  return out;
}

std::string defined(double x, const char* undefined) {
  return std::isnan(x) ? std::string(undefined) : fmt::format("{:.6g}", x);
}

std::string verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAsymptoticallyStable:
      return "asymptotically stable";
    case Verdict::kMarginal:
      return "marginal: neither decays nor grows";
    case Verdict::kRepeatedImaginary:
      return "repeated imaginary roots: may grow with time";
    case Verdict::kUnstable:
      return "unstable";
    case Verdict::kUncertain:
      break;
  }
  return "uncertain: too near the stability boundary for the numerical precision";
}

std::string routhText(const RouthResult& routh) {
  return fmt::format("    roots           {} right, {} on the imaginary axis, {} left\n",
                     routh.right, routh.imaginary, routh.left) +
         (routh.first_column.empty()
              ? std::string()
              : fmt::format("    first column    {:.6g}\n", fmt::join(routh.first_column, "  ")));
}

std::string marginsText(double decay_rate, double damping_ratio, double log_decrement) {
  return fmt::format("    decay rate      {:.6g} 1/s\n", decay_rate) +
         fmt::format("    damping ratio   {}\n", defined(damping_ratio, "none: no motion")) +
         fmt::format("    log decrement   {}\n", defined(log_decrement, "none: no vibration"));
}

std::vector<std::string> separationConditions() {
  return {"AF = Nc / (N2 - N1), Nc the peak, N1 and N2 where the response is 0.707 of it",
          "AF < 2.5: critically damped, no margin is required",
          "N above Nc: (N - Nc)/N at least 17 (1 - 1/(AF - 1.5)) %, 16 % at most",
          "N below Nc: (Nc - N)/N at least 10 + 17 (1 - 1/(AF - 1.5)) %, 26 % at most",
          "API 617 and RP 684; check the clause against the edition in force"};
}

std::string beyondMark(const DataSpeeds& tables, double speed) {
  return tables.covers(speed) ? "" : "  " + beyondName(tables);
}

std::string beyondName(const DataSpeeds& tables) {
  return areFilms(tables) ? "outside the film range" : "outside the tables";
}

std::string beyondText(const DataSpeeds& tables) {
  if (areFilms(tables)) {
    return fmt::format(
        "{}, which carry their loads at eccentricities below 0.95 from {:.5g} rad/s ({:.5g} rpm) "
        "on: below, the journals touch and the coefficients are extrapolated",
        beyondName(tables), tables.from, tables.from / kRpm);
  }
  return fmt::format(
      "outside the tables of bearings and pedestals, which cover {:.5g} to {:.5g} rad/s ({:.5g} to "
      "{:.5g} rpm): extrapolated with the nearest row",
      tables.from, tables.to, tables.from / kRpm, tables.to / kRpm);
}

std::string beyondLine(const DataSpeeds& tables, double from, double to) {
  if (tables.covers(from) && tables.covers(to)) {
    return "";
  }
  return from == to ? fmt::format("  {}\n", beyondText(tables))
                    : fmt::format("  in part {}\n", beyondText(tables));
}

Json tableSpeedsJson(const DataSpeeds& tables) {
  return tables.everywhere() ? Json() : Json{tables.from, tables.to};
}

Json beyondJson(const DataSpeeds& tables, const std::vector<double>& speeds) {
  return listJson(speeds, [&](double speed) { return !tables.covers(speed); });
}

void shadeBeyond(const DataSpeeds& tables, double from, double to, bool named, Chart& chart) {
  const auto shade = [&](double low, double high) {
    if (low < high) {
      chart.bands.push_back({named ? beyondName(tables) : "", low, high, paler(ink::kBlack, 0.85)});
      named = false;
    }
  };
  shade(from, std::min(to, tables.from));
  shade(std::max(from, tables.to), to);
}

}  // namespace whirl_twin
