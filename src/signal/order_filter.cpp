#include "signal/order_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algebra/constants.h"
#include "signal/full_spectrum.h"
#include "signal/harmonic_fit.h"

namespace whirl_twin {

state::OrderState reportedOrders(const OrbitEstimate& e) {
  state::OrderState s;
  s.valid = e.valid;
  s.delay = e.delay;
  s.window = e.window;
  s.speed = e.speed;
  s.mean_x = e.mean.real();
  s.mean_y = e.mean.imag();
  s.peak_to_peak = e.peak_to_peak;
  s.precession = e.precession;
  s.forward = e.precession >= 0.0;
  s.noise = e.noise;
  for (const OrderVector& order : e.orders) {
    s.order.push_back(order.order);
    s.forward_amplitude.push_back(std::abs(order.forward));
    s.forward_lag.push_back(order.forwardLag());
    s.backward_amplitude.push_back(std::abs(order.backward));
    s.backward_lag.push_back(order.backwardLag());
    s.deviation.push_back(order.deviation);
  }
  for (const SpectralLine& line : e.lines) {
    s.line_frequency.push_back(line.frequency);
    s.line_ratio.push_back(e.speed == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                          : line.frequency / std::fabs(e.speed));
    s.line_forward.push_back(e.speed < 0.0 ? line.backward : line.forward);
    s.line_backward.push_back(e.speed < 0.0 ? line.forward : line.backward);
    s.line_growth.push_back(line.growth);
  }
  return s;
}

/// How long a window is, and how its amplitudes may change.
struct OrderFilter::Reach {
  double turns;
  int degree;         // of the first order
  int higher_degree;  // of the others
  int mean_degree;
};

namespace {

constexpr double kMaxOrderWindow = 2.0;  // [s], of a window that a shorter one could do for
constexpr double kLast = 20.0;           // [s], of any
constexpr double kStandstill = 1.0;      // [s], of one without turns
constexpr std::size_t kMaxOrderSamples = 640;
constexpr int kLineDegree = 3;
constexpr int kMaxFittedLines = 4;
/// Of a peak of noise among some hundred bins hardly ever.
constexpr double kProminent = 12.0;
/// A line must reduce the noise to this fraction.
constexpr double kWorthwhile = 0.8;
/// Fractions of the motion: noise below the first is not searched for lines, and lines below the
/// second, which may be artefacts of the change of a stronger one, are not reported.
constexpr double kQuiet = 1.0e-7;
constexpr double kMinFittedLine = 1.0e-4;

/// Cycles in a window by which two frequencies have to differ where their amplitudes may change as
/// polynomials of these degrees: each takes (degree + 1)/2 of them.
double cyclesApart(int degree, int other) {
  return 0.25 * (degree + other + 2);
}

/// The fit of a window and its components.
struct Fit {
  const OrbitPart& part;
  std::vector<double> orders;  // the mean is order 0
  std::vector<int> degrees;    // of each
  HarmonicFit harmonics;
  std::vector<double> lines;  // [rad/s]

  Fit(const OrbitPart& of, std::vector<double> all_orders, std::vector<int> all_degrees,
      Eigen::Index columns)
      : part(of),
        orders(std::move(all_orders)),
        degrees(std::move(all_degrees)),
        harmonics(of.tau, columns) {
    harmonics.addMean(degrees.front());
    for (std::size_t i = 1; i < orders.size(); ++i) {
      const double before = std::fmod(orders[i] * static_cast<double>(part.turns), 1.0);
      harmonics.addHarmonic(kTwoPi * before + orders[i] * part.angle, degrees[i]);
    }
  }

  bool solve() { return harmonics.solve(part.x, part.y); }
  std::size_t lineAt(std::size_t i) const { return degrees.size() + i; }
  double perCycle() const { return kTwoPi / (2.0 * part.half); }  // [rad/s], over the window
  void addLine(double frequency) {
    harmonics.addHarmonic(frequency * part.half * part.tau, kLineDegree);
    lines.push_back(frequency);
  }
  void removeLine() {
    harmonics.removeLast();
    lines.pop_back();
  }

  /// (a'/a) [1/s] of the larger part of a line, at the middle.
  std::complex<double> changeOf(std::size_t i) const {
    const std::complex<double> f = harmonics.forward(lineAt(i));
    const std::complex<double> b = harmonics.backward(lineAt(i));
    const std::complex<double> change = std::abs(f) >= std::abs(b)
                                            ? harmonics.forwardChange(lineAt(i)) / f
                                            : std::conj(harmonics.backwardChange(lineAt(i)) / b);
    return change / part.half;
  }

  bool standsApart(double frequency) const;
  std::optional<double> lineInTheRest() const;
  bool findLine();
};

/// Whether a line there can be separated from the orders and from the lines found so far.
bool Fit::standsApart(double frequency) const {
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const double order = orders[i] * std::fabs(part.speed);
    if (std::fabs(frequency - order) < cyclesApart(degrees[i], kLineDegree) * perCycle()) {
      return false;
    }
  }
  return std::all_of(lines.begin(), lines.end(), [&](double line) {
    return std::fabs(frequency - line) >= cyclesApart(kLineDegree, kLineDegree) * perCycle();
  });
}

/// [rad/s], of the highest line that no order and no line so far explains.
std::optional<double> Fit::lineInTheRest() const {
  Eigen::ArrayXcd rest = Eigen::ArrayXcd::Zero(part.place.back() + 1);  // holes hold nothing
  for (std::size_t i = 0; i < part.place.size(); ++i) {
    rest[part.place[i]] = harmonics.rest()[static_cast<Eigen::Index>(i)];
  }
  const auto peak = FullSpectrum(rest, part.period).highest([&](double frequency) {
    return standsApart(std::fabs(frequency));
  });
  if (!peak || peak->prominence < kProminent) {
    return std::nullopt;
  }
  return std::fabs(peak->frequency);
}

/// Adds a line, at the frequency at which its amplitude does not turn, and fits again. False, and
/// nothing has changed, where there is none.
bool Fit::findLine() {
  const double before = harmonics.noise();
  std::optional<double> found = lineInTheRest();
  if (!found || !harmonics.hasRoom(kLineDegree)) {
    return false;
  }
  addLine(*found);
  bool fits = solve();
  if (fits) {
    // The phase of the amplitude rotates at the frequency error.
    const double better = *found + changeOf(lines.size() - 1).imag();
    removeLine();
    fits = std::fabs(better - *found) < perCycle() && standsApart(better);
    addLine(fits ? better : *found);
    fits = fits && solve();
  }
  if (fits && harmonics.noise() <= kWorthwhile * before) {
    return true;
  }
  removeLine();
  solve();
  return false;
}

/// Area swept about the mean, relative to the maximum for steps of that length.
double precessionOf(const OrbitPart& part, std::complex<double> mean) {
  double swept = 0.0;
  double most = 0.0;
  for (Eigen::Index i = 0; i + 1 < part.x.size(); ++i) {
    const double x = 0.5 * (part.x[i] + part.x[i + 1]) - mean.real();
    const double y = 0.5 * (part.y[i] + part.y[i + 1]) - mean.imag();
    const double dx = part.x[i + 1] - part.x[i];
    const double dy = part.y[i + 1] - part.y[i];
    swept += x * dy - y * dx;
    most += std::hypot(x, y) * std::hypot(dx, dy);
  }
  return most > 0.0 ? std::copysign(1.0, part.speed) * swept / most : 0.0;
}

}  // namespace

OrbitEstimate OrderFilter::fitted(const Reach& reach, double seconds) const {
  const OrbitPart part = window_.last(seconds, kMaxOrderSamples);
  std::vector<double> orders = {0.0};
  std::vector<int> degrees = {reach.mean_degree};
  Eigen::Index columns = reach.mean_degree + 1;
  for (std::size_t i = 0; i < orders_.size() && reach.turns > 0.0; ++i) {
    orders.push_back(orders_[i]);
    degrees.push_back(i == 0 ? reach.degree : reach.higher_degree);
    columns += 2 * (degrees.back() + 1);
  }
  OrbitEstimate estimate;
  if (part.tau.size() < 2 * columns) {
    return estimate;
  }
  Fit fit(part, orders, degrees, columns + 2 * kMaxFittedLines * (kLineDegree + 1));
  if (!fit.solve()) {
    return estimate;
  }
  const double size = std::sqrt((part.x - part.x.mean()).square().mean() +
                                (part.y - part.y.mean()).square().mean());
  for (int i = 0; i < kMaxFittedLines && fit.harmonics.noise() > kQuiet * size; ++i) {
    if (!fit.findLine()) {
      break;
    }
  }
  estimate.valid = orders.size() > 1;
  estimate.time = part.centre;
  estimate.delay = window_.newest().time - part.centre;
  estimate.speed = part.speed;
  estimate.window = 2.0 * part.half;
  estimate.mean = fit.harmonics.mean();
  estimate.noise = fit.harmonics.noise();
  for (std::size_t i = 1; i < orders.size(); ++i) {
    estimate.orders.push_back(
        {orders[i], fit.harmonics.forward(i), fit.harmonics.backward(i), fit.harmonics.doubt(i)});
  }
  for (std::size_t i = 0; i < fit.lines.size(); ++i) {
    const std::complex<double> change = fit.changeOf(i);
    const double forward = std::abs(fit.harmonics.forward(fit.lineAt(i)));
    const double backward = std::abs(fit.harmonics.backward(fit.lineAt(i)));
    if (std::max(forward, backward) > kMinFittedLine * size) {
      estimate.lines.push_back({fit.lines[i] + change.imag(), forward, backward, change.real()});
    }
  }
  std::sort(estimate.lines.begin(), estimate.lines.end(), [](const auto& a, const auto& b) {
    return std::max(a.forward, a.backward) > std::max(b.forward, b.backward);
  });
  estimate.precession = precessionOf(part, estimate.mean);
  estimate.peak_to_peak = window_.peakToPeak(seconds);
  return estimate;
}

OrbitEstimate OrderFilter::estimate() const {
  // From the longest to the shortest window: 4 and 2 turns for the passage of a resonance.
  static constexpr Reach kReaches[] = {{16, 2, 2, 1}, {8, 4, 2, 1}, {4, 7, 3, 0}, {2, 3, 2, 0}};
  static constexpr Reach kFewSamples = {64, 2, 2, 1};  // a turn
  static constexpr Reach kMeanOnly = {0, 0, 0, 1};
  OrbitEstimate best;
  if (window_.empty()) {
    return best;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Reach& reach : kReaches) {
    const double seconds = window_.since(reach.turns);
    const bool last = reach.turns == 2;
    if (seconds == 0.0 || seconds > (last ? kLast : kMaxOrderWindow)) {
      continue;
    }
    OrbitEstimate now = fitted(reach, seconds);
    if (now.valid && now.orders.front().deviation < least) {
      least = now.orders.front().deviation;
      best = std::move(now);
    }
  }
  if (!best.valid && window_.since(kFewSamples.turns) > 0.0) {
    best = fitted(kFewSamples, window_.since(kFewSamples.turns));
  }
  return best.valid ? best : fitted(kMeanOnly, kStandstill);
}

}  // namespace whirl_twin
