// The figure of `twin loop`: Bode and Nyquist diagrams, and the sensitivity over the zones of ISO
// 14839-3.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "reports/loop_report.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

constexpr int kPoints = 1600;
constexpr double kDecadesOfFrequency = 5.0;  // below the highest frequency
constexpr double kNyquistReach = 3.0;  // of the Nyquist diagram: what is farther is not near -1
constexpr double kMaxSensitivity = 12.0;
constexpr double kLowestGain = 1.0e-6;  // of the highest; half the rate of the samples has none

struct Zone {
  const char* name;
  double low, high;
  Ink ink;
};

const std::array<Zone, 4> kZones{{{"zone A", 0.0, 3.0, paler(ink::kGreen, 0.8)},
                                  {"zone B", 3.0, 4.0, paler(ink::kOrange, 0.8)},
                                  {"zone C", 4.0, 5.0, paler(ink::kOrange, 0.5)},
                                  {"zone D", 5.0, 6.0, paler(ink::kVermilion, 0.5)}}};

/// Evenly on a logarithmic scale, with the frequencies of the poles between them.
std::vector<double> frequenciesOf(const LoopResponse& response) {
  std::vector<double> w;
  for (int i = 0; i < kPoints; ++i) {
    w.push_back(response.highest *
                std::pow(10.0, kDecadesOfFrequency * (i / (kPoints - 1.0) - 1.0)));
  }
  for (const Complex& pole : response.poles) {
    const double place = std::fabs(pole.imag());
    if (place > w.front() && place < response.highest) {
      w.push_back(place);
    }
  }
  std::sort(w.begin(), w.end());
  return w;
}

struct Curves {
  Series gain, phase, nyquist, sensitivity;
};

Curves curvesOf(const LoopResponse& response, const std::string& name) {
  Curves curves;
  for (Series* series : {&curves.gain, &curves.phase, &curves.nyquist, &curves.sensitivity}) {
    series->name = name;
  }
  const auto add = [](Series& series, double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
  };
  double before = kNaN;
  for (const double w : frequenciesOf(response)) {
    const Complex loop = response.open_loop(w);
    const double phase = std::arg(loop) * 180.0 / kPi;
    if (std::fabs(phase - before) > 180.0) {  // from one end of the axis to the other
      add(curves.phase, w, kNaN);
    }
    before = phase;
    add(curves.gain, w, std::abs(loop));
    add(curves.phase, w, phase);
    const bool near = std::abs(loop + 1.0) < kNyquistReach;
    add(curves.nyquist, near ? loop.real() : kNaN, near ? loop.imag() : kNaN);
    const double sensitivity = 1.0 / std::abs(1.0 + loop);
    add(curves.sensitivity, w, sensitivity <= kMaxSensitivity ? sensitivity : kNaN);
  }
  const double highest = *std::max_element(curves.gain.y.begin(), curves.gain.y.end());
  for (double& gain : curves.gain.y) {
    gain = gain < kLowestGain * highest ? kNaN : gain;
  }
  return curves;
}

/// |1 + L| = 1 / 3: what zone A keeps clear.
Series circleOfZoneA() {
  Series circle{"limit of zone A (curve outside)", {}, {}, Pen{ink::kGreen, 1.5, {5.0, 3.0}}};
  for (int i = 0; i <= 120; ++i) {
    const Complex at = -1.0 + std::polar(1.0 / 3.0, kTwoPi * i / 120.0);
    circle.x.push_back(at.real());
    circle.y.push_back(at.imag());
  }
  return circle;
}

void addZones(double low, double high, Chart& chart) {
  double top = kZones.back().high;
  for (const Series& curve : chart.series) {
    for (const double y : curve.y) {
      top = std::fmax(top, y);
    }
  }
  for (const Zone& zone : kZones) {
    const double end = zone.high == kZones.back().high ? top : zone.high;
    Series area{zone.name, {low, high, high, low}, {zone.low, zone.low, end, end}};
    area.fill = zone.ink;
    chart.series.push_back(area);
  }
}

}  // namespace

Figure figure(const LoopedController& controller) {
  Chart gain, phase, nyquist, sensitivity;
  gain.title = "open loop, all other loops closed";
  for (Chart* chart : {&gain, &phase, &sensitivity}) {
    chart->x = {"frequency (rad/s)", true, true};
  }
  gain.y = {"gain |L|", true, false};
  phase.y.label = "phase of L (deg)";
  phase.y.degrees = true;
  phase.horizontal = {{-180.0, ""}, {180.0, ""}, {0.0, ""}};
  nyquist.title = "Nyquist";
  nyquist.x.label = "Re L";
  nyquist.y.label = "Im L";
  nyquist.equal_aspect = true;
  sensitivity.title = "sensitivity, zones of ISO 14839-3";
  sensitivity.y.label = "|S|";
  gain.horizontal = {{1.0, ""}};
  const double highest = controller.responses.front().highest;
  for (std::size_t i = 0; i < controller.responses.size(); ++i) {
    const Curves curves = curvesOf(controller.responses[i], controller.spec->measured[i]);
    gain.series.push_back(curves.gain);
    phase.series.push_back(curves.phase);
    nyquist.series.push_back(curves.nyquist);
    sensitivity.series.push_back(curves.sensitivity);
  }
  for (const SampledMargins& margins : controller.margins) {
    if (margins.sensitivity_peak <= kMaxSensitivity) {
      Series peak{"", {margins.peak_frequency}, {margins.sensitivity_peak}, Pen{ink::kBlack, 1.0}};
      peak.line = false;
      peak.marks = Marks::kRings;
      sensitivity.series.push_back(peak);
    }
  }
  addZones(highest * std::pow(10.0, -kDecadesOfFrequency), highest, sensitivity);
  nyquist.series.push_back(circleOfZoneA());
  Series point{"-1", {-1.0}, {0.0}, Pen{ink::kBlack, 1.0}};
  point.line = false;
  point.marks = Marks::kDots;
  nyquist.series.push_back(point);
  Figure figure;
  figure.title = fmt::format("{}: {} at {:g} Hz, {}", controller.spec->name, controller.spec->type,
                             controller.spec->rate, verdictText(controller.stability->verdict));
  figure.charts = {gain, nyquist, phase, sensitivity};
  figure.columns = 2;
  figure.width = 1200;
  figure.chart_height = 430;
  return figure;
}

}  // namespace whirl_twin
