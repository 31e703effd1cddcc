// The figure of `twin fit`: measured and predicted motion, and the residual with its spectrum.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "reports/fit_report.h"
#include "signal/full_spectrum.h"

namespace whirl_twin {

namespace {

constexpr double kGap = 10.0;  // steps without a row: nothing was measured there

/// Amplitudes over frequency of what is left, its rows taken for even.
Series spectrum(const MeasuredRun& data, const Series& rest) {
  Eigen::ArrayXcd values(static_cast<Eigen::Index>(rest.y.size()));
  for (std::size_t i = 0; i < rest.y.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = std::isfinite(rest.y[i]) ? rest.y[i] : 0.0;
  }
  const double period = data.duration() / static_cast<double>(data.time.size() - 1);
  const FullSpectrum all(values, period);
  Series series;
  series.name = rest.name;
  series.pen = rest.pen;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all.frequency(k) > 0.0) {  // the other half is the same
      series.x.push_back(all.frequency(k) / kTwoPi);
      series.y.push_back(2.0 * all.amplitude(k));
    }
  }
  return series;
}

/// Interrupted where rows are missing: a line there would look measured.
Series interrupted(Series series, double step) {
  for (std::size_t k = series.x.size(); k-- > 1;) {
    if (series.x[k] - series.x[k - 1] > kGap * step) {
      series.x.insert(series.x.begin() + static_cast<std::ptrdiff_t>(k), series.x[k]);
      series.y.insert(series.y.begin() + static_cast<std::ptrdiff_t>(k), kNaN);
    }
  }
  return series;
}

/// [s], from row to row mostly.
double medianStep(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < time.size(); ++k) {
    steps.push_back(time[k] - time[k - 1]);
  }
  if (steps.empty()) {
    return 0.0;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

Figure figure(const FitStudy& study, const ShootingFit& fit, std::size_t run) {
  const StudyRun& one = study.runs[run];
  const std::vector<double>& time = one.data.time;
  const Eigen::MatrixXd& states = fit.runs[run].states;
  const double step = medianStep(time);
  Figure figure;
  figure.title =
      fmt::format("{}: {} ({})", study.system, one.file, one.train ? "train" : "validate");
  figure.width = 940;
  figure.chart_height = 300;
  Chart left, lines;
  left.title = "residual (measured - predicted)";
  left.x = {"time (s)", false, true};
  left.y = {"difference"};
  lines.title = "spectrum of the residual";
  lines.x = {"frequency (Hz)", true, true};
  lines.y = {"amplitude", true};
  for (std::size_t i = 0; i < one.measured.size(); ++i) {
    const MeasuredChannel& c = fit.runs[run].channels[i];
    const std::vector<double>& column = one.data.column(c.column);
    Chart both;
    both.title =
        fmt::format("{}, rms of the residual {:.3g} {}", c.name, fit.runs[run].rms[i], c.unit);
    both.x = {"time (s)", false, true};
    both.y = {fmt::format("{} ({})", c.name, c.unit)};
    Series measured{"measured", time, column};
    Series predicted{"predicted", time, {}};
    Series rest{c.name, time, {}};
    for (std::size_t k = 0; k < column.size(); ++k) {
      predicted.y.push_back(
          c.scale.value * states(static_cast<Eigen::Index>(c.state), static_cast<Eigen::Index>(k)) +
          c.offset.value);
      rest.y.push_back(column[k] - predicted.y.back());
    }
    measured.pen = Pen{ink::kSkyBlue, 4.0};  // wide and pale: both are seen where they agree
    predicted.pen = Pen{ink::kBlack, 1.2};
    both.series = {interrupted(measured, step), interrupted(predicted, step)};
    figure.charts.push_back(both);
    left.series.push_back(interrupted(rest, step));
    lines.series.push_back(spectrum(one.data, rest));
  }
  left.y.label = fmt::format("residual ({})", one.measured.front().unit);
  lines.y.label = fmt::format("amplitude ({})", one.measured.front().unit);
  figure.charts.push_back(left);
  figure.charts.push_back(lines);
  return figure;
}

}  // namespace whirl_twin
