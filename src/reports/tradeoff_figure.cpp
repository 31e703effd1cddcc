// The work-precision plot, and error over step.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "integration/step_methods.h"
#include "reports/tradeoff_report.h"

namespace whirl_twin {

namespace {

/// Rounding is drawn here where an error is zero.
constexpr double kErrorDrawnForZero = 1.0e-16;

/// Each method has one, whichever others there are: the twelfth is the first again.
Pen methodPen(const std::string& integrator) {
  static constexpr std::array kInks{ink::kBlue,   ink::kVermilion, ink::kGreen, ink::kPurple,
                                    ink::kOrange, ink::kSkyBlue,   ink::kBrown, ink::kGrey,
                                    ink::kOlive,  ink::kNavy,      ink::kBlack};
  const auto& methods = stepMethods();
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const StepMethod& m) { return m.name == integrator; });
  return {kInks[static_cast<std::size_t>(method - methods.begin()) % kInks.size()], 1.8};
}

}  // namespace

Figure figure(const TradeoffReport& report) {
  Chart work, order;
  work.title = "work-precision diagram";
  work.x = {"CPU time per simulated second (s)", true, false};
  work.y = {"largest relative position error", true, false};
  order.title = "error over the method's step";
  order.x = {"step of the method (s)", true, false};
  order.y = work.y;
  for (const TradeoffRow& row : report.rows) {
    if (work.series.empty() || work.series.back().name != row.setting.integrator) {
      for (Chart* chart : {&work, &order}) {
        Series series;
        series.name = chart == &work ? row.setting.integrator : "";  // of both, once
        series.pen = methodPen(row.setting.integrator);
        series.marks = Marks::kDots;
        chart->series.push_back(series);
      }
    }
    if (row.stable) {
      const double error = std::max(row.error.position, kErrorDrawnForZero);
      work.series.back().x.push_back(row.cpuPerSecond());
      work.series.back().y.push_back(error);
      order.series.back().x.push_back(row.methodStep());
      order.series.back().y.push_back(error);
    }
  }
  if (report.recommended) {
    const TradeoffRow& row = report.rows[*report.recommended];
    Series ring{
        "recommended", {row.cpuPerSecond()}, {std::max(row.error.position, kErrorDrawnForZero)}};
    ring.pen = Pen{ink::kBlack, 2.0};
    ring.line = false;
    ring.marks = Marks::kRings;
    work.series.push_back(ring);
  }
  for (Chart* chart : {&work, &order}) {
    chart->horizontal = {{report.tolerance, fmt::format("tolerance {:g}", report.tolerance)},
                         {report.reference_error, "reference"}};
  }
  Figure figure;
  figure.title = fmt::format("{}: {} ({}), {:g} s", report.scene, report.system, report.model,
                             report.compared);
  figure.charts = {work, order};
  figure.width = 940;
  figure.chart_height = 480;
  return figure;
}

}  // namespace whirl_twin
