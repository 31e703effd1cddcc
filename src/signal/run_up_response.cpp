#include "signal/run_up_response.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

constexpr double kHalfPower = 0.70710678118654752;
constexpr double kBack = 0.02;  // of the span of speeds
constexpr double kSlow = 0.15;  // of (N2 - N1)^2
/// Amplitudes kept; beyond, every second one goes.
constexpr std::size_t kMaxRunSamples = 20000;

}  // namespace

bool RunUpResponse::turnsBack(double speed) const {
  if (run_.empty()) {
    return false;
  }
  const double span = run_.back().speed - run_.front().speed;
  const double gone = speed - run_.back().speed;
  return span * gone < 0.0 && std::fabs(gone) > kBack * std::fabs(span);
}

void RunUpResponse::take(double time, double speed, double amplitude) {
  if (!std::isfinite(time) || !std::isfinite(speed) || !std::isfinite(amplitude)) {
    return;
  }
  if (!run_.empty()) {
    const double span = run_.back().speed - run_.front().speed;
    const double gone = speed - run_.back().speed;
    if (turnsBack(speed)) {
      run_.clear();
    } else if (gone == 0.0 || span * gone < 0.0 || time <= run_.back().time) {
      return;  // it dwells or ripples, or the window of the filter has become longer
    }
  }
  if (run_.size() == kMaxRunSamples) {
    for (std::size_t i = 0; i < kMaxRunSamples / 2; ++i) {
      run_[i] = run_[2 * i];
    }
    run_.resize(kMaxRunSamples / 2);
  }
  run_.push_back({time, speed, amplitude});
}

/// The speed nearest to a peak, in a direction along the run, at which the amplitude is `level`;
/// none where a higher peak or the end of the run comes first.
std::optional<double> RunUpResponse::crossing(std::size_t peak, double level, int direction) const {
  const auto last = direction > 0 ? static_cast<std::ptrdiff_t>(run_.size()) - 1 : 0;
  for (auto i = static_cast<std::ptrdiff_t>(peak); i != last; i += direction) {
    const Point& here = run_[static_cast<std::size_t>(i)];
    const Point& next = run_[static_cast<std::size_t>(i + direction)];
    if (next.amplitude > run_[peak].amplitude) {
      return std::nullopt;
    }
    if (next.amplitude <= level) {
      const double part = (here.amplitude - level) / (here.amplitude - next.amplitude);
      return here.speed + part * (next.speed - here.speed);
    }
  }
  return std::nullopt;
}

std::vector<ResponsePeak> RunUpResponse::peaks() const {
  std::vector<ResponsePeak> peaks;
  for (std::size_t i = 1; i + 1 < run_.size(); ++i) {
    const Point &before = run_[i - 1], &here = run_[i], &after = run_[i + 1];
    if (here.amplitude <= before.amplitude || here.amplitude < after.amplitude) {
      continue;
    }
    // The parabola through the three, over speeds that need not be evenly apart.
    const double left = before.speed - here.speed;
    const double right = after.speed - here.speed;
    const double rise = (before.amplitude - here.amplitude) / left;
    const double fall = (after.amplitude - here.amplitude) / right;
    const double curvature = (fall - rise) / (right - left);
    const double slope = rise - curvature * left;
    ResponsePeak peak;
    peak.time = here.time;
    peak.speed = here.speed - 0.5 * slope / curvature;
    peak.amplitude = here.amplitude - 0.25 * slope * slope / curvature;
    const double level = kHalfPower * peak.amplitude;
    const std::optional<double> on_the_way = crossing(i, level, -1);
    const std::optional<double> beyond = crossing(i, level, 1);
    if (!on_the_way && !beyond) {
      continue;  // a ripple on something higher
    }
    const bool up = right > 0.0;
    peak.lower = up ? on_the_way : beyond;
    peak.upper = up ? beyond : on_the_way;
    peak.acceleration = std::fabs((after.speed - before.speed) / (after.time - before.time));
    if (peak.lower && peak.upper) {
      const double width = std::fabs(*peak.upper - *peak.lower);
      peak.amplification_factor = std::fabs(peak.speed) / width;
      peak.slow = peak.acceleration < kSlow * width * width;
    }
    peaks.push_back(peak);
  }
  return peaks;
}

}  // namespace whirl_twin
