#include "reports/spectrum_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"
#include "signal/whirl_component_class.h"

namespace whirl_twin {

namespace {

constexpr double kOrdersShown = 2.5;      // times the highest speed, to either side
constexpr double kFaintestLine = 1.0e-4;  // of the highest line, that a spectrum shows
constexpr std::size_t kColumns = 480;
constexpr std::size_t kMaxRidges = 40;
constexpr double kMaxRidge = 0.15;  // of the axis

/// [rad/s], how far a picture reaches to either side.
double reachOf(const std::vector<const WindowSpectrum*>& spectra) {
  double reach = 0.0;
  double end = kInfinity;
  double line = 0.0;
  for (const WindowSpectrum* spectrum : spectra) {
    reach = std::max(reach, kOrdersShown * std::fabs(spectrum->speed));
    end = std::min(end, -spectrum->first);
    if (!spectrum->lines.empty()) {
      line = std::max(line, std::fabs(spectrum->lines.front().frequency));
    }
  }
  return std::min(end, std::max(reach, 1.2 * line));
}

/// Between two bins, on the line through them.
double amplitudeAt(const WindowSpectrum& spectrum, double frequency) {
  const double last = static_cast<double>(spectrum.amplitude.size() - 1);
  const double place = std::clamp((frequency - spectrum.first) / spectrum.step, 0.0, last);
  const auto below = static_cast<std::size_t>(std::min(place, last - 1.0));
  const double part = place - static_cast<double>(below);
  return (1.0 - part) * static_cast<double>(spectrum.amplitude[below]) +
         part * static_cast<double>(spectrum.amplitude[below + 1]);
}

/// The highest amplitude in each column between -reach and reach.
std::vector<double> columnsOf(const WindowSpectrum& spectrum, double reach) {
  std::vector<double> columns(kColumns, 0.0);
  const double width = 2.0 * reach / static_cast<double>(kColumns);
  const double finest = std::min(width, spectrum.step);
  for (std::size_t i = 0; i < kColumns; ++i) {
    const double low = -reach + static_cast<double>(i) * width;
    for (double frequency = low; frequency < low + width; frequency += finest) {
      columns[i] = std::max(columns[i], amplitudeAt(spectrum, frequency));
    }
  }
  return columns;
}

double columnAt(std::size_t column, double reach) {
  return reach * ((2.0 * static_cast<double>(column) + 1.0) / static_cast<double>(kColumns) - 1.0);
}

double middleTime(const WindowSpectrum& spectrum) {
  return 0.5 * (spectrum.begin + spectrum.end);
}

struct Cascade {
  bool over_speed = false;
  std::vector<const WindowSpectrum*> spectra;  // of rising base

  double base(const WindowSpectrum& spectrum) const {
    return over_speed ? std::fabs(spectrum.speed) : middleTime(spectrum);
  }
};

/// Of all, those that stand at least a 40th of the axis apart, the last in time among them.
Cascade apart(const std::vector<WindowSpectrum>& spectra, bool over_speed) {
  Cascade cascade{over_speed, {}};
  for (const WindowSpectrum& spectrum : spectra) {
    cascade.spectra.push_back(&spectrum);
  }
  std::stable_sort(
      cascade.spectra.begin(), cascade.spectra.end(),
      [&](const auto* a, const auto* b) { return cascade.base(*a) < cascade.base(*b); });
  const double least =
      (cascade.base(*cascade.spectra.back()) - cascade.base(*cascade.spectra.front())) /
      static_cast<double>(kMaxRidges);
  const auto at_the_last = [&](const WindowSpectrum* spectrum) {
    return spectrum != &spectra.back() &&
           std::fabs(cascade.base(*spectrum) - cascade.base(spectra.back())) < least;
  };
  double before = -kInfinity;
  const auto crowded = [&](const WindowSpectrum* spectrum) {
    if (at_the_last(spectrum) || (spectrum != &spectra.back() &&
                                  cascade.base(*spectrum) < before + (1.0 - 1.0e-9) * least)) {
      return true;
    }
    before = cascade.base(*spectrum);
    return false;
  };
  cascade.spectra.erase(std::remove_if(cascade.spectra.begin(), cascade.spectra.end(), crowded),
                        cascade.spectra.end());
  return cascade;
}

/// The speed goes one way, and for most of the time it does go.
bool isRun(const std::vector<WindowSpectrum>& spectra) {
  constexpr double kBack = 0.02;  // of the span
  constexpr double kSpan = 0.1;   // of the highest speed
  constexpr double kMost = 0.5;   // of the spectra
  const double span = spectra.back().speed - spectra.front().speed;
  double highest = 0.0;
  std::size_t moving = 0;
  double reached = spectra.front().speed;
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    highest = std::max(highest, std::fabs(spectra[i].speed));
    const double back = (reached - spectra[i].speed) * std::copysign(1.0, span);
    if (back > kBack * std::fabs(span)) {
      return false;
    }
    if (i > 0 && -back > 0.2 * std::fabs(span) / static_cast<double>(spectra.size())) {
      ++moving;
    }
    reached = back < 0.0 ? spectra[i].speed : reached;
  }
  return std::fabs(span) > kSpan * highest &&
         static_cast<double>(moving) > kMost * static_cast<double>(spectra.size() - 1);
}

/// Forward and backward together, broken between.
Series orderLine(const Cascade& cascade, int order, const Ink& ink) {
  Series series;
  series.name = fmt::format("{}X", order);
  series.pen = Pen{ink, 1.4, {6.0, 4.0}};
  for (const double side : {1.0, -1.0}) {
    for (const WindowSpectrum* spectrum : cascade.spectra) {
      series.x.push_back(side * order * std::fabs(spectrum->speed));
      series.y.push_back(cascade.base(*spectrum));
    }
    series.x.push_back(kNaN);
    series.y.push_back(kNaN);
  }
  return series;
}

}  // namespace

std::string lineName(const SpectrumLine& line) {
  if (line.order > 0) {
    return fmt::format("{}X", line.order);
  }
  return std::isfinite(line.ratio) ? fmt::format("{:.2f}X", line.ratio) : "";
}

std::string lineText(const SpectrumLine& line) {
  const std::string name = lineName(line);
  return fmt::format(
      "{}{}{} {:.4g} um", name.empty() ? "" : name + " ",
      line.frequency < 0.0 ? "backward" : "forward",
      line.order > 0 ? "" : fmt::format(" ({:.4g} rad/s)", std::fabs(line.frequency)),
      1.0e6 * line.amplitude);
}

std::string subsynchronousText(const std::vector<WindowSpectrum>& spectra) {
  WhirlComponentClass character;
  for (const WindowSpectrum& spectrum : spectra) {
    const auto line = std::find_if(spectrum.lines.begin(), spectrum.lines.end(),
                                   [](const SpectrumLine& l) { return l.subsynchronous(); });
    if (line != spectrum.lines.end()) {
      character.take(line->frequency, spectrum.speed);
    }
  }
  switch (character.kind()) {
    case WhirlComponentClass::Kind::kKeepsRatio:
      return "the subsynchronous component keeps its ratio to the speed, as oil whirl does";
    case WhirlComponentClass::Kind::kKeepsFrequency:
      return "the subsynchronous component keeps its frequency, as oil whip and free vibration do";
    default:
      return "";
  }
}

Chart spectrumChart(const WindowSpectrum& spectrum) {
  Chart chart;
  chart.title = fmt::format("full spectrum, t = {:.4g} to {:.4g} s, shaft at {}", spectrum.begin,
                            spectrum.end, ShownUnits{}.speedText(spectrum.speed));
  chart.x = {"backward          frequency (rad/s)          forward", false, true};
  chart.y = {"amplitude (m)", true, true};
  const double reach = reachOf({&spectrum});
  const std::vector<double> columns = columnsOf(spectrum, reach);
  const double highest = *std::max_element(columns.begin(), columns.end());
  Series series;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    series.x.push_back(columnAt(i, reach));
    series.y.push_back(std::max(columns[i], kFaintestLine * highest));
  }
  series.pen = Pen{ink::kBlue, 1.4};
  chart.series = {series};
  const double speed = std::fabs(spectrum.speed);
  for (const int order : {-2, -1, 1, 2}) {
    if (speed > 0.0) {
      chart.vertical.push_back({order * speed, fmt::format("{}X", std::abs(order))});
    }
  }
  for (const SpectrumLine& line : spectrum.lines) {
    if (line.order == 0 || line.order > 2) {
      const std::string name = lineName(line);
      chart.vertical.push_back(
          {line.frequency,
           name.empty() ? fmt::format("{:.4g} rad/s", std::fabs(line.frequency)) : name});
    }
  }
  return chart;
}

Chart cascadeChart(const std::vector<WindowSpectrum>& spectra) {
  const Cascade cascade = apart(spectra, isRun(spectra));
  const double reach = reachOf(cascade.spectra);
  const double low = cascade.base(*cascade.spectra.front());
  const double high = cascade.base(*cascade.spectra.back());
  std::vector<std::vector<double>> columns;
  double highest = std::numeric_limits<double>::min();
  for (const WindowSpectrum* spectrum : cascade.spectra) {
    columns.push_back(columnsOf(*spectrum, reach));
    highest = std::max(highest, *std::max_element(columns.back().begin(), columns.back().end()));
  }
  Chart chart;
  chart.title = fmt::format(
      "cascade of full spectra: height is the square root of the amplitude, the highest {:.4g} um",
      1.0e6 * highest);
  chart.x = {"backward          frequency (rad/s)          forward", false, true};
  chart.y = {cascade.over_speed ? "speed of the shaft (rad/s)" : "time (s)", false, true};
  if (cascade.over_speed) {
    chart.y.second = SecondScale{"rpm", 1.0 / kRpm};
  }
  // From the front backwards: what stands behind something higher is hidden.
  std::vector<double> horizon(kColumns, -kInfinity);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double base = cascade.base(*cascade.spectra[i]);
    Series ridge;
    ridge.pen = Pen{ink::kBlue, 0.9};
    for (std::size_t k = 0; k < kColumns; ++k) {
      const double y = base + kMaxRidge * (high - low) * std::sqrt(columns[i][k] / highest);
      ridge.x.push_back(columnAt(k, reach));
      ridge.y.push_back(y >= horizon[k] ? y : kNaN);
      horizon[k] = std::max(horizon[k], y);
    }
    chart.series.push_back(ridge);
  }
  chart.series.push_back(orderLine(cascade, 1, ink::kVermilion));
  chart.series.push_back(orderLine(cascade, 2, ink::kGreen));
  Series slower;
  slower.name = "subsynchronous";
  slower.pen = Pen{ink::kPurple, 2.6};
  for (const WindowSpectrum* spectrum : cascade.spectra) {
    for (const SpectrumLine& line : spectrum->lines) {
      if (line.subsynchronous() && line.amplitude > 0.02 * highest) {
        const double base = cascade.base(*spectrum);
        const double half = 0.008 * reach;
        slower.x.insert(slower.x.end(), {line.frequency - half, line.frequency + half, kNaN});
        slower.y.insert(slower.y.end(), {base, base, kNaN});
      }
    }
  }
  if (!slower.x.empty()) {
    chart.series.push_back(slower);
  }
  return chart;
}

}  // namespace whirl_twin
