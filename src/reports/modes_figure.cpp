// The shapes of whirl modes: orbits along the shaft, which stands behind them.
#include <fmt/format.h>

#include <algorithm>

#include "algebra/constants.h"
#include "reports/modes_report.h"
#include "reports/orbit_chart.h"
#include "reports/rotor_outline.h"
#include "reports/table_speeds.h"

namespace whirl_twin {

namespace {

constexpr double kHeight = 0.9;  // of the largest orbit, the rotor behind it
constexpr double kPale = 0.6;

Chart shapeChart(const ModesReport& r, std::size_t place) {
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
  chart.title = fmt::format("{}: {}, {:.4g} rad/s ({:.0f} rpm), log. decrement {:.3g}", place + 1,
                            name(mode.whirl), mode.dampedFrequency(), mode.dampedFrequency() / kRpm,
                            mode.logDecrement());
  return chart;
}

}  // namespace

Figure figure(const ModesReport& r, std::size_t count) {
  Figure figure;
  figure.title = fmt::format(
      "{}: whirl modes at {:.4g} rad/s, {:.0f} rpm (blue forward, red backward){}",
      r.system->title(), r.speed, r.speed / kRpm, beyondMark(r.system->tables(), r.speed));
  for (std::size_t k = 0; k < std::min(count, r.model.size()); ++k) {
    figure.charts.push_back(shapeChart(r, k));
  }
  const bool along = r.system->shaft.has_value();
  figure.columns = figure.charts.size() > 1 ? 2 : 1;
  figure.width = 1040;
  figure.chart_height = along ? 290 : 420;
  return figure;
}

}  // namespace whirl_twin
