#include "plots/bar_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "plots/label_places.h"
#include "plots/marked_axis.h"

namespace whirl_twin {
namespace {

constexpr int kBarChartWidth = 800;  // px
constexpr double kBarWidth = 15.0;   // px
constexpr double kGap = 12.0;        // px, between groups
constexpr double kHead = 62.0;       // px: title and subtitle
constexpr double kBarLegendRow = 24.0;
constexpr double kBarChartFoot = 56.0;
constexpr double kWhisker = 4.0;  // px, half length of its end cap
constexpr std::array kBarInks{ink::kBlue, ink::kSkyBlue, ink::kOrange};

const Lettering kSubtitle{13.0, ink::kGrey, Align::kMiddle, Align::kMiddle};
const Lettering kName{13.0, ink::kBlack, Align::kEnd, Align::kMiddle};

bool hasInterval(const Bar& bar) {
  return std::isfinite(bar.value) && std::isfinite(bar.low) && std::isfinite(bar.high);
}

class BarDrawing {
 public:
  BarDrawing(const BarChart& chart, Canvas& canvas, double height)
      : chart_(chart), canvas_(canvas) {
    double widest = 0.0;
    for (const BarGroup& group : chart.groups) {
      widest = std::max(widest, canvas.textWidth(group.name, kName));
    }
    plot_.left = 22.0 + widest;
    plot_.width = kBarChartWidth - 26.0 - plot_.left;
    plot_.top = kHead + (chart.names.size() > 1 ? kBarLegendRow : 0.0);
    plot_.height = height - kBarChartFoot - plot_.top;
    std::vector<double> reached{chart.base};
    for (const BarGroup& group : chart.groups) {
      for (const Bar& bar : group.bars) {
        reached.push_back(bar.value);
        if (hasInterval(bar)) {
          reached.insert(reached.end(), {bar.low, bar.high});
        }
      }
    }
    x_ = {dataRange({&reached}, false), false, {}, {}};
    x_.mark(chart.x.tight, std::max(3, static_cast<int>(plot_.width / 70.0)));
  }

  void draw() {
    canvas_.text({0.5 * kBarChartWidth, 19.0}, chart_.title, kTitleLettering);
    canvas_.text({0.5 * kBarChartWidth, 41.0}, chart_.subtitle, kSubtitle);
    drawLegend();
    drawGrid();
    double top = plot_.top + 0.5 * kGap;
    for (const BarGroup& group : chart_.groups) {
      const double height = kBarWidth * static_cast<double>(chart_.names.size());
      canvas_.text({plot_.left - 8.0, top + 0.5 * height}, group.name, kName);
      for (std::size_t k = 0; k < group.bars.size(); ++k) {
        drawBar(group.bars[k], top + kBarWidth * static_cast<double>(k),
                kBarInks[k % kBarInks.size()]);
      }
      top += height + kGap;
    }
    const double base = across(chart_.base);
    canvas_.line({{base, plot_.top}, {base, plot_.bottom()}}, {ink::kBlack, 1.4});
  }

 private:
  double across(double value) const { return plot_.left + x_.place(value) * plot_.width; }

  void drawLegend() {
    double x = plot_.left;
    for (std::size_t k = 0; k < chart_.names.size() && chart_.names.size() > 1; ++k) {
      drawBox(x, x + 24.0, kHead + 2.0, kBarInks[k % kBarInks.size()]);
      canvas_.text({x + 32.0, kHead + 8.0}, chart_.names[k], kLegendLettering);
      x += 54.0 + canvas_.textWidth(chart_.names[k], kLegendLettering);
    }
  }

  void drawGrid() {
    for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
      const double x = across(x_.ticks[i]);
      canvas_.line({{x, plot_.top}, {x, plot_.bottom()}}, {ink::kGrid, 1.0});
      canvas_.text({x, plot_.bottom() + 13.0}, x_.labels.text[i], kTickLettering);
    }
    canvas_.line({{plot_.left, plot_.bottom()}, {plot_.right(), plot_.bottom()}},
                 {ink::kGrey, 1.2});
    const std::string power =
        x_.labels.exponent == 0 ? "" : "  \u00d7" + powerOfTen(x_.labels.exponent);
    canvas_.text({plot_.left + 0.5 * plot_.width, plot_.bottom() + 36.0}, chart_.x.label + power,
                 kAxisLettering);
  }

  void drawBox(double from, double to, double top, const Ink& ink) {
    canvas_.polygon({{from, top}, {to, top}, {to, top + 12.0}, {from, top + 12.0}}, ink,
                    {darker(ink, 0.3), 0.8});
  }

  void drawBar(const Bar& bar, double top, const Ink& ink) {
    const double end = across(bar.value);
    if (!std::isfinite(end)) {
      return;
    }
    drawBox(across(chart_.base), end, top + 1.5, ink);
    if (hasInterval(bar)) {
      const double y = top + 0.5 * kBarWidth;
      const double low = across(bar.low);
      const double high = across(bar.high);
      canvas_.lines({{{low, y}, {high, y}},
                     {{low, y - kWhisker}, {low, y + kWhisker}},
                     {{high, y - kWhisker}, {high, y + kWhisker}}},
                    {ink::kBlack, 1.4});
    }
  }

  const BarChart& chart_;
  Canvas& canvas_;
  Rectangle plot_;
  MarkedAxis x_;
};

}  // namespace

std::string barImage(const BarChart& chart, ImageFormat format) {
  const double group = kBarWidth * static_cast<double>(chart.names.size()) + kGap;
  const double height = kHead + (chart.names.size() > 1 ? kBarLegendRow : 0.0) +
                        group * static_cast<double>(chart.groups.size()) + kBarChartFoot;
  std::string description = chart.x.label + " of";
  const char* separator = " ";
  for (const BarGroup& one : chart.groups) {
    description += separator + one.name;
    separator = ", ";
  }
  Canvas canvas(format, kBarChartWidth, static_cast<int>(height), chart.title, description);
  BarDrawing(chart, canvas, height).draw();
  return canvas.finish();
}

}  // namespace whirl_twin
