#include "reports/recorded_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr double kSurelyKnown = 0.1;     // rad, deviation of the shaft's angle
constexpr double kLeastJitter = 1.0e-9;  // s

}  // namespace

std::string WildSamples::note(const std::string& probe, std::int64_t start) const {
  return fmt::format(
      "{}: {} implausible {} left out, the first {:.4g} s after the first sample, up to {:.3g} m",
      probe, instants.size(), instants.size() == 1 ? "sample" : "samples",
      kNanosecond * static_cast<double>(instants.front() - start), largest);
}

void RecordedSource::take(const state::Measurement& message) {
  if (samples == 0) {
    first = last = message.instantOf(0);
    for (std::size_t c = 0; c < message.channel.size(); ++c) {
      deviation[message.channel[c]] = unitScale(message.unit[c], "m") * message.deviation[c];
    }
  }
  for (std::int64_t i = 0; i < message.samples; ++i) {
    const std::int64_t instant = message.instantOf(i);
    if (samples > 0 && instant <= last) {
      continue;
    }
    ++samples;
    last = instant;
    for (std::size_t c = 0; c < message.channel.size(); ++c) {
      const std::size_t at = static_cast<std::size_t>(i) * message.channel.size() + c;
      const double value = unitScale(message.unit[c], "m") * message.value[at];
      if (message.valid[at] == 0 || !std::isfinite(value)) {
        continue;
      }
      WildSamples& of = wild[message.channel[c]];
      of.largest = std::fmax(of.largest, std::fabs(value));
      if (const auto found = of.detector.take(instant, value)) {
        of.instants.push_back(*found);
      }
    }
  }
}

double RecordedSource::period() const {
  return static_cast<double>(last - first) * kNanosecond / static_cast<double>(samples - 1);
}

bool RecordedSource::isAtInstantsOf(const RecordedSource& other) const {
  const double slack = kTogether * other.period() / kNanosecond;
  return samples == other.samples && std::fabs(static_cast<double>(first - other.first)) < slack &&
         std::fabs(static_cast<double>(last - other.last)) < slack;
}

TrackedShaft::TrackedShaft(const KeyphasorSettings& keyphasor,
                           const std::vector<std::int64_t>& pulses)
    : tracker_(trackerOf(keyphasor, 0.0, kLeastJitter)),
      stated_(tracker_.jitter()),
      pulses_(pulses) {}

ShaftEstimate TrackedShaft::at(std::int64_t instant) {
  while (next_ < pulses_.size() && (!tracker_.locked() || tracker_.newest() <= instant)) {
    tracker_.take(pulses_[next_++]);
  }
  ShaftEstimate shaft = tracker_.at(instant);
  shaft.known = shaft.known && shaft.deviation < kSurelyKnown;
  return shaft;
}

}  // namespace whirl_twin
