#include "signal/passed_resonance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace whirl_twin {

namespace {

constexpr double kWorthTelling = 0.05;  // of the highest amplitude
constexpr double kCertain = 10.0;       // deviations: half power is 3 of them below the peak
constexpr double kNear = 0.2;           // of the speed

/// A shaft that passes a resonance fast leaves it ringing, and the ringing beats with 1X: peaks
/// that follow within so many half-power widths.
constexpr double kRinging = 3.0;

bool rings(const ResponsePeak& peak, const ResponsePeak& before) {
  return !peak.slow && before.amplitude > peak.amplitude &&
         std::fabs(peak.speed - before.speed) < kRinging * (*before.upper - *before.lower);
}

/// Those with half power on both sides and, where there are none, the highest.
std::vector<ResponsePeak> resonancesOf(const std::vector<ResponsePeak>& peaks) {
  std::vector<ResponsePeak> whole;
  for (const ResponsePeak& peak : peaks) {
    if (peak.amplification_factor &&
        std::none_of(whole.begin(), whole.end(),
                     [&](const ResponsePeak& before) { return rings(peak, before); })) {
      whole.push_back(peak);
    }
  }
  if (whole.empty() && !peaks.empty()) {
    whole.push_back(*std::max_element(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) {
      return a.amplitude < b.amplitude;
    }));
  }
  return whole;
}

bool certain(const ResponsePeak& peak, const OrderCourse& orders) {
  const auto at = std::find(orders.time.begin(), orders.time.end(), peak.time);
  return at != orders.time.end() &&
         peak.amplitude >
             kCertain * orders.deviation[static_cast<std::size_t>(at - orders.time.begin())];
}

}  // namespace

std::vector<PassedResonance> passedResonances(
    const OrderCourse& orders, const std::vector<state::CriticalSpeedMargin>& model) {
  if (orders.time.empty()) {
    return {};
  }
  const double highest = *std::max_element(orders.amplitude.begin(), orders.amplitude.end());
  std::vector<PassedResonance> passed;
  RunUpResponse run;
  const auto finish = [&] {
    for (const ResponsePeak& peak : resonancesOf(run.peaks())) {
      if (peak.amplitude > kWorthTelling * highest && certain(peak, orders)) {
        PassedResonance resonance;
        resonance.peak = peak;
        passed.push_back(resonance);
      }
    }
  };
  for (std::size_t i = 0; i < orders.time.size(); ++i) {
    const bool set_back = i > 0 && orders.time[i] <= orders.time[i - 1];
    if (set_back || run.turnsBack(orders.speed[i])) {
      finish();
      run = {};
    }
    run.take(orders.time[i], orders.speed[i], orders.amplitude[i]);
  }
  finish();
  for (PassedResonance& resonance : passed) {
    double least = kNear * std::fabs(resonance.peak.speed);
    for (const state::CriticalSpeedMargin& critical : model) {
      const double off = std::fabs(critical.speed - std::fabs(resonance.peak.speed));
      if (off < least) {
        least = off;
        resonance.model_speed = critical.speed;
        resonance.model_factor = critical.amplification_factor;
      }
    }
  }
  return passed;
}

}  // namespace whirl_twin
