#include "reports/ensemble_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "plots/ticks.h"

namespace whirl_twin {

namespace {

constexpr int kPercentilesHeight = 330;  // px
constexpr double kWide = 0.8;            // share of white in the outer percentiles
constexpr double kNarrow = 0.55;         // and in the inner ones

using Percentile = std::vector<double> state::EnsembleState::*;

Series curve(const std::string& name, const PlotHistory& history, Percentile percentile,
             std::size_t quantity) {
  Series series;
  series.name = name;
  for (const state::EnsembleState& s : history.ensemble) {
    series.x.push_back(s.at.time);
    series.y.push_back((s.*percentile)[quantity]);
  }
  return series;
}

/// Out along the lower percentile and back along the upper one.
Series area(const std::string& name, const PlotHistory& history, Percentile low, Percentile high,
            std::size_t quantity, double white) {
  Series series = curve(name, history, low, quantity);
  const Series back = curve("", history, high, quantity);
  series.x.insert(series.x.end(), back.x.rbegin(), back.x.rend());
  series.y.insert(series.y.end(), back.y.rbegin(), back.y.rend());
  series.fill = paler(ink::kBlue, white);
  series.line = false;
  return series;
}

/// [m]
std::vector<double> whirlAbout(const Eigen::Vector2d& rest, const PlotHistory& history) {
  std::vector<double> radius;
  for (std::size_t i = 0; i < history.time.size(); ++i) {
    radius.push_back(std::hypot(history.whirl_x[i] - rest.x(), history.whirl_y[i] - rest.y()));
  }
  return radius;
}

Chart courseChart(const Ensemble& ensemble, const PlotHistory& history, std::size_t quantity) {
  using State = state::EnsembleState;
  const EnsembleQuantity& q = ensemble.quantities()[quantity];
  Chart chart;
  chart.x = {"time (s)", false, true};
  chart.y.label = fmt::format("{} ({})", q.name == "radius" ? "whirl radius" : q.name, q.unit);
  chart.series = {
      area("5 to 95 %", history, &State::percentile_5, &State::percentile_95, quantity, kWide),
      area("25 to 75 %", history, &State::percentile_25, &State::percentile_75, quantity, kNarrow),
      curve("median", history, &State::median, quantity),
      curve("largest", history, &State::largest, quantity)};
  chart.series[2].pen = Pen{ink::kBlue, 1.8};
  chart.series[3].pen = Pen{ink::kGrey, 1.0, {4.0, 3.0}};
  Series given{
      "nominal", history.time,
      q.name == "radius" ? whirlAbout(ensemble.rest(), history) : history.coordinates[quantity]};
  given.pen = Pen{ink::kVermilion, 1.4};
  chart.series.push_back(given);
  return chart;
}

/// Members over the peak they reached, in about the square root of their number of classes.
Chart peakChart(const Ensemble& ensemble, std::size_t quantity) {
  const std::size_t quantities = ensemble.quantities().size();
  std::vector<double> record(ensemble.recordSize());
  ensemble.write(0, record.data());
  std::vector<double> peaks;
  for (std::size_t i = 0; i < ensemble.count(); ++i) {
    const double peak = ensemble.peaks(record.data())[i * quantities + quantity];
    if (std::fabs(peak) <= kLargestOnAxis) {
      peaks.push_back(peak);
    }
  }
  const EnsembleQuantity& q = ensemble.quantities()[quantity];
  Chart chart;
  chart.x = {fmt::format("largest {} of a sample ({})", q.name, q.unit), false, true};
  chart.y.label = "samples";
  if (peaks.empty()) {
    return chart;
  }
  const auto [low, high] = std::minmax_element(peaks.begin(), peaks.end());
  const double from = *low;
  const double range = *high > *low ? *high - *low : std::max(1.0e-12 * std::fabs(*high), 1.0e-300);
  const std::size_t classes = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(peaks.size())))));
  std::vector<int> members(classes);
  for (const double peak : peaks) {
    const auto place =
        static_cast<std::size_t>((peak - from) / range * static_cast<double>(classes));
    ++members[std::min(place, classes - 1)];
  }
  Series bars;
  bars.fill = paler(ink::kBlue, kNarrow);
  bars.line = false;
  bars.x.push_back(from);
  bars.y.push_back(0.0);
  for (std::size_t k = 0; k < classes; ++k) {
    for (const std::size_t edge : {k, k + 1}) {
      bars.x.push_back(from + range * static_cast<double>(edge) / static_cast<double>(classes));
      bars.y.push_back(members[k]);
    }
  }
  bars.x.push_back(from + range);
  bars.y.push_back(0.0);
  chart.series = {bars};
  return chart;
}

}  // namespace

Figure ensembleFigure(const Ensemble& ensemble, const PlotHistory& history) {
  Figure figure;
  figure.chart_height = kPercentilesHeight;
  for (std::size_t k = 0; k < ensemble.quantities().size(); ++k) {
    figure.charts.push_back(courseChart(ensemble, history, k));
    figure.charts.push_back(peakChart(ensemble, k));
  }
  return figure;
}

}  // namespace whirl_twin
