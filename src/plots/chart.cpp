#include "plots/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "plots/chart_drawing.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kMaxSpots = 10000;  // of a whole SVG
const Lettering kFigureTitle{17.0, ink::kBlack, Align::kMiddle, Align::kMiddle, true};

std::string words(const ChartAxis& axis) {
  return axis.second ? fmt::format("{}, {}", axis.label, axis.second->label) : axis.label;
}

/// A text description of the figure.
std::string description(const Figure& figure) {
  std::string text;
  for (const Chart& chart : figure.charts) {
    text +=
        fmt::format("{}{}{} over {}:", text.empty() ? "" : "; ",
                    chart.title.empty() ? "" : chart.title + ": ", words(chart.y), words(chart.x));
    const char* separator = " ";
    for (const Series& series : chart.series) {
      if (!series.name.empty()) {
        text += separator + series.name;
        separator = ", ";
      }
    }
    for (const std::vector<ReferenceLine>* lines : {&chart.vertical, &chart.horizontal}) {
      for (const ReferenceLine& line : *lines) {
        if (!line.label.empty()) {
          text += fmt::format(" [{} at {:.4g}]", line.label, line.at);
        }
      }
    }
  }
  return text;
}

}  // namespace

std::string figureImage(const Figure& figure, ImageFormat format) {
  const int count = static_cast<int>(figure.charts.size());
  const int rows = (count + figure.columns - 1) / figure.columns;
  const double top = figure.title.empty() ? 6.0 : 36.0;
  Canvas canvas(format, figure.width, static_cast<int>(top) + rows * figure.chart_height,
                figure.title, description(figure));
  canvas.text({0.5 * figure.width, 19.0}, figure.title, kFigureTitle);

  const std::size_t most_spots =
      format == ImageFormat::kSvg ? kMaxSpots : std::numeric_limits<std::size_t>::max();
  std::size_t all_series = 0;
  for (const Chart& chart : figure.charts) {
    all_series += static_cast<std::size_t>(
        std::count_if(chart.series.begin(), chart.series.end(),
                      [](const Series& series) { return !series.fill; }));  // of areas all stay
  }
  std::vector<ChartDrawing> drawings;
  drawings.reserve(figure.charts.size());
  const auto columns = static_cast<std::size_t>(figure.columns);
  std::vector<double> left_margins(columns, 0.0), right_margins(columns, 0.0);
  const double width = static_cast<double>(figure.width) / figure.columns;
  for (int i = 0; i < count; ++i) {
    const int column = i % figure.columns;
    const int row = i / figure.columns;
    const Rectangle place{column * width, top + row * figure.chart_height, width,
                          static_cast<double>(figure.chart_height)};
    drawings.emplace_back(figure.charts[static_cast<std::size_t>(i)], place,
                          most_spots / std::max<std::size_t>(all_series, 1), canvas);
    double& left = left_margins[static_cast<std::size_t>(column)];
    double& right = right_margins[static_cast<std::size_t>(column)];
    left = std::max(left, drawings.back().leftMargin());
    right = std::max(right, drawings.back().rightMargin());
  }
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    drawings[i].draw(left_margins[i % columns], right_margins[i % columns]);
  }
  return canvas.finish();
}

}  // namespace whirl_twin
