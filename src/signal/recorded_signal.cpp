#include "signal/recorded_signal.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kSteadySpeed = 0.01;     // of a speed
constexpr double kSurelyKnown = 0.1;      // rad, deviation of the shaft's angle
constexpr double kSmallestJitter = 1e-9;  // s

}  // namespace

void WildSamples::take(std::int64_t instant, double value) {
  largest = std::fmax(largest, std::fabs(value));
  if (const auto found = detector.take(instant, value)) {
    instants.push_back(*found);
  }
}

double longestKeptSpeed(std::vector<std::pair<double, double>> dwells) {
  std::sort(dwells.begin(), dwells.end());
  double longest = 0.0, time = 0.0, moment = 0.0, speed = 0.0;
  std::size_t first = 0;
  for (const auto& [now, spent] : dwells) {
    time += spent;
    moment += spent * now;
    while (dwells[first].first < now * (1.0 - kSteadySpeed)) {
      time -= dwells[first].second;
      moment -= dwells[first].second * dwells[first].first;
      ++first;
    }
    if (time > longest) {
      longest = time;
      speed = moment / time;
    }
  }
  return speed;
}

double longestKeptSpeed(const std::vector<std::int64_t>& pulses) {
  std::vector<std::pair<double, double>> dwells;
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    const double time = static_cast<double>(pulses[i] - pulses[i - 1]) * kNanosecond;
    if (time > 0.0) {
      dwells.emplace_back(kTwoPi / time, time);
    }
  }
  return longestKeptSpeed(std::move(dwells));
}

RecordedShaft::RecordedShaft(const KeyphasorSettings& keyphasor,
                             const std::vector<std::int64_t>& pulses)
    : tracker_(trackerOf(keyphasor, 0.0, kSmallestJitter)),
      stated_(tracker_.jitter()),
      pulses_(pulses) {}

ShaftEstimate RecordedShaft::at(std::int64_t instant) {
  while (next_ < pulses_.size() && (!tracker_.locked() || tracker_.newest() <= instant)) {
    tracker_.take(pulses_[next_++]);
  }
  ShaftEstimate shaft = tracker_.at(instant);
  shaft.known = shaft.known && shaft.deviation < kSurelyKnown;
  return shaft;
}

}  // namespace whirl_twin
