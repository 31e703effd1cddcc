#include "signal/measured_orbit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "algebra/constants.h"
#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr double kMinAngle = 1.0e-3;        // [-], sine of that between the two probes
constexpr std::size_t kMaxPulses = 4096;    // that wait for samples
constexpr std::int64_t kExact = 1LL << 53;  // [ns], up to which a double counts them
constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();

/// [ns], mean of a message; 0 where it has one sample.
std::int64_t periodOf(const state::Measurement& message) {
  if (message.period > 0 || message.samples < 2) {
    return message.period;
  }
  return (message.lastInstant() - message.first_instant) / (message.samples - 1);
}

}  // namespace

bool MeasuredOrbit::makeAnOrbit(double first, double second) {
  return std::fabs(std::sin(second - first)) >= kMinAngle;
}

MeasuredOrbit::MeasuredOrbit(const MeasuredOrbitSettings& settings)
    : settings_(settings), shaft_(settings.shaft) {
  const double a = settings.probes[0].direction, b = settings.probes[1].direction;
  const double sine = std::sin(b - a);
  if (!makeAnOrbit(a, b)) {
    throw std::invalid_argument("the two probes of an orbit must not be parallel");
  }
  inverse_ = {
      {{std::sin(b) / sine, -std::sin(a) / sine}, {-std::cos(b) / sine, std::cos(a) / sine}}};
  clear();
}

void MeasuredOrbit::clear() {
  shaft_.clear();
  wild_ = {};
  for (auto& readings : readings_) {
    readings.clear();
  }
  pulses_.clear();
  newest_reading_ = {kNone, kNone};
  newest_ = last_ = kNone;
}

bool MeasuredOrbit::listensTo(const std::string& source) const {
  return source == settings_.probes[0].source || source == settings_.probes[1].source ||
         source == settings_.keyphasor;
}

void MeasuredOrbit::take(const state::Measurement& message, std::vector<OrbitSample>& out) {
  for (std::size_t i = 0; i < settings_.probes.size(); ++i) {
    if (message.source == settings_.probes[i].source) {
      takeProbe(i, message);
    }
  }
  if (message.source == settings_.keyphasor) {
    takePulses(message);
  }
  advance(out, settings_.longest_wait);
}

void MeasuredOrbit::finish(std::vector<OrbitSample>& out) {
  advance(out, -1.0);
}

void MeasuredOrbit::takeProbe(std::size_t probe, const state::Measurement& message) {
  const auto found =
      std::find(message.channel.begin(), message.channel.end(), settings_.probes[probe].channel);
  if (found == message.channel.end()) {
    return;
  }
  const std::size_t channels = message.channel.size();
  auto at = static_cast<std::size_t>(found - message.channel.begin());
  const double scale = unitScale(message.unit[at], "m");
  const std::int64_t period = periodOf(message);
  for (std::int64_t i = 0; i < message.samples; ++i, at += channels) {
    const std::int64_t instant = message.instantOf(i);
    std::int64_t& newest = newest_reading_[probe];
    if (instant <= newest) {
      ++(instant == newest ? samples_.repeated : samples_.late);
      continue;
    }
    newest = instant;
    newest_ = std::max(newest_, instant);
    if (message.valid[at] == 0 || scale == 0.0) {
      ++samples_.invalid;
    } else if (!std::isfinite(message.value[at])) {
      ++samples_.not_finite;
    } else {
      readings_[probe].push_back({instant, period, scale * message.value[at]});
      leaveOutWild(probe);
    }
  }
}

/// Evaluated six samples later, when a reading is nearly always still waiting for the next pulse.
void MeasuredOrbit::leaveOutWild(std::size_t probe) {
  std::deque<Reading>& waiting = readings_[probe];
  const auto wild = wild_[probe].take(waiting.back().instant, waiting.back().value);
  if (!wild) {
    return;
  }
  ++samples_.wild;
  const auto found = std::find_if(waiting.rbegin(), waiting.rend(),
                                  [&](const Reading& r) { return r.instant == *wild; });
  if (found != waiting.rend()) {
    waiting.erase(std::next(found).base());
  }
}

void MeasuredOrbit::takePulses(const state::Measurement& message) {
  const std::size_t channels = message.channel.size();
  for (std::int64_t i = 0; i < message.samples; ++i) {
    // Of a keyphasor the first channel counts; the instants are what is measured.
    if (message.valid[static_cast<std::size_t>(i) * channels] != 0) {
      pulses_.push_back(message.instantOf(i));
      newest_ = std::max(newest_, pulses_.back());
    }
  }
}

bool MeasuredOrbit::paired() {
  auto& [first, second] = readings_;
  while (!first.empty() && !second.empty()) {
    if (first.front().instant == second.front().instant) {
      return true;
    }
    ++samples_.alone;
    (first.front().instant < second.front().instant ? first : second).pop_front();
  }
  return false;
}

void MeasuredOrbit::advance(std::vector<OrbitSample>& out, double longest_wait) {
  // Seconds that the newest there is lies ahead.
  const auto ahead = [&](std::int64_t instant) {
    return kNanosecond * static_cast<double>(newest_ - instant);
  };
  while (true) {
    const bool sample_waits = paired();
    const std::int64_t instant = sample_waits ? readings_[0].front().instant : 0;
    const bool followed = shaft_.locked() && sample_waits && instant <= shaft_.newest();
    if (!followed && !pulses_.empty() && (sample_waits || pulses_.size() > kMaxPulses)) {
      shaft_.take(pulses_.front());
      pulses_.pop_front();
    } else if (sample_waits && (followed || ahead(instant) > longest_wait)) {
      out.push_back(sample(readings_[0].front(), readings_[1].front()));
      readings_[0].pop_front();
      readings_[1].pop_front();
    } else {
      return;
    }
  }
}

OrbitSample MeasuredOrbit::sample(const Reading& first, const Reading& second) {
  if (last_ == kNone) {
    origin_ = std::llabs(first.instant) < kExact ? 0 : first.instant;
    index_ = 0;
  } else if (first.period > 0) {
    const double periods =
        static_cast<double>(first.instant - last_) / static_cast<double>(first.period);
    index_ += std::max<std::int64_t>(1, std::llround(periods));
  } else {
    ++index_;
  }
  last_ = first.instant;
  samples_.used += 2;
  const ShaftEstimate shaft = shaft_.at(first.instant);
  OrbitSample sample;
  sample.index = index_;
  sample.time = kNanosecond * static_cast<double>(first.instant - origin_);
  sample.turns = shaft.angle.turns;
  sample.remainder = shaft.angle.remainder;
  sample.speed = shaft.known ? shaft.speed : 0.0;
  sample.x = inverse_[0][0] * first.value + inverse_[0][1] * second.value;
  sample.y = inverse_[1][0] * first.value + inverse_[1][1] * second.value;
  return sample;
}

}  // namespace whirl_twin
