#include "monitoring/measured_signal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "algebra/constants.h"
#include "signal/order_filter.h"

namespace whirl_twin {

namespace {

constexpr double kTelling = 0.05;  // [s], of orders
constexpr double kFewTurns = 5.0;  // without a pulse: it is missing
constexpr int kManyRejected = ShaftTracker::kLately / 2;
constexpr double kStandsSoon = 10.0;  // [rad/s], a slower shaft may stop within a turn

/// Slow roll is constant in the shaft: a vector less certain than this part is none.
constexpr double kSure = 0.03;
constexpr double kAsSlow = 1.05;  // times the slowest speed it was learned at: there again

}  // namespace

std::optional<MeasuredOrbitSettings> measuredOrbitOf(const BuiltScene& scene, std::size_t system) {
  const SystemSpec& spec = scene.systems[system]->spec;
  const Dynamics& dynamics = *scene.systems[system]->dynamics;
  const auto& sensors = scene.scene.sensors;
  const std::size_t drive = scene.scene.driveOf(spec);
  const auto keyphasor = std::find_if(sensors.begin(), sensors.end(), [&](const SensorSpec& s) {
    return s.keyphasor && s.drive == drive;
  });
  if (!dynamics.isRotor() || keyphasor == sensors.end()) {
    return std::nullopt;
  }
  MeasuredOrbitSettings orbit;
  orbit.keyphasor = keyphasor->name;
  orbit.shaft = trackerOf(*keyphasor->keyphasor, dynamics.phaseMark());
  for (std::size_t station = 0; station < dynamics.stations().size(); ++station) {
    bool first = false;
    for (const SensorSpec& sensor : sensors) {
      for (const SensorChannelSpec& channel : sensor.channels) {
        const SignalSpec& at = channel.signal;
        if (at.kind != SignalSpec::Kind::kDisplacement || at.system != system ||
            at.station != station) {
          continue;
        }
        const MeasuredProbe probe{sensor.name, channel.name, at.direction};
        if (!first) {
          orbit.probes[0] = probe;
          first = true;
        } else if (MeasuredOrbit::makeAnOrbit(orbit.probes[0].direction, probe.direction)) {
          orbit.probes[1] = probe;
          return orbit;
        }
      }
    }
  }
  return std::nullopt;
}

MeasuredSignal::MeasuredSignal(std::string system, const MeasuredOrbitSettings& orbit,
                               const AlarmSettings& settings)
    : system_(std::move(system)), settings_(orbit), orbit_(orbit), slow_filter_({1.0}) {
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    probes_[i].name = orbit.probes[i].source + "/" + orbit.probes[i].channel;
  }
  restart();
  set(settings);
}

void MeasuredSignal::set(const AlarmSettings& settings) {
  timeout_ = settings.data_timeout;
  const AmplitudeLevels* const levels = settingOf(settings.amplitude, system_);
  range_ = levels == nullptr ? kInfinity : levels->range;
  const SlowRoll* const roll = settingOf(settings.slow_roll, system_);
  slow_below_ = roll == nullptr ? 0.0 : roll->below;
  if (roll == nullptr) {
    slow_roll_.reset();
  } else if (!(roll->below > 0.0)) {
    slow_roll_ = roll->given;
  }
}

void MeasuredSignal::restart() {
  orbit_.clear();
  filter_.clear();
  slow_filter_.clear();
  published_at_ = -kInfinity;  // never
  turning_ = acceleration_ = 0.0;
  beyond_.clear();
  for (Probe& probe : probes_) {
    probe.samples = StuckChannel();
  }
}

void MeasuredSignal::check(Probe& probe, const MeasuredProbe& at, const state::Measurement& message,
                           double wall_time) {
  const auto found = std::find(message.channel.begin(), message.channel.end(), at.channel);
  if (message.source != at.source || found == message.channel.end()) {
    return;
  }
  probe.received = true;
  probe.received_at = wall_time;
  probe.why.clear();
  for (auto i = static_cast<std::size_t>(found - message.channel.begin()); i < message.value.size();
       i += message.channel.size()) {
    if (message.valid[i] == 0) {
      probe.why = "invalid: " + probe.name;
    } else if (!std::isfinite(message.value[i])) {
      probe.why = "not finite: " + probe.name;
    } else {
      probe.samples.take(message.value[i]);
    }
  }
  if (probe.why.empty() && probe.samples.stuck()) {
    probe.why = "stuck: " + probe.name;
  }
}

void MeasuredSignal::take(const state::Measurement& message, double wall_time) {
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    check(probes_[i], settings_.probes[i], message, wall_time);
  }
  if (message.source == settings_.keyphasor) {
    pulse_at_ = wall_time;
  }
  samples_.clear();
  motion_.clear();
  orders_.clear();
  orbit_.take(message, samples_);
  if (!samples_.empty()) {
    beyond_.clear();
  }
  for (const OrbitSample& sample : samples_) {
    addSample(sample);
  }
}

void MeasuredSignal::addSample(const OrbitSample& measured) {
  OrbitSample sample = measured;
  const bool due = sample.time - published_at_ >= kTelling;
  learnSlowRoll(sample, due);
  if (slow_roll_ && sample.speed != 0.0) {
    const std::complex<double> turn = std::polar(1.0, sample.remainder);
    const std::complex<double> roll =
        slow_roll_->forward * turn + slow_roll_->backward * std::conj(turn);
    sample.x -= roll.real();
    sample.y -= roll.imag();
  }
  state::WhirlState whirl;
  whirl.at.step = sample.index;
  whirl.at.time = sample.time + 1.0e-9 * static_cast<double>(orbit_.origin());
  whirl.system = system_;
  whirl.x = sample.x;
  whirl.y = sample.y;
  whirl.radius = std::hypot(sample.x, sample.y);
  whirl.whirl_angle = std::atan2(sample.y, sample.x);
  whirl.speed = sample.speed;
  whirl.shaft_angle = kTwoPi * static_cast<double>(sample.turns) + sample.remainder;
  if (whirl.radius > range_) {
    beyond_ = fmt::format("out of range: measured whirl {:.3g} mm 0-peak, above {:.3g} mm",
                          1.0e3 * whirl.radius, 1.0e3 * range_);
  }
  motion_.push_back(whirl);
  filter_.take(sample);
  if (due) {
    published_at_ = sample.time;
    state::OrderState orders = reportedOrders(filter_.estimate());
    orders.at = whirl.at;
    orders.system = system_;
    orders_.push_back(std::move(orders));
    const ShaftEstimate shaft = orbit_.shaftAt(orbit_.origin() + std::llround(1.0e9 * sample.time));
    acceleration_ = shaft.known ? shaft.acceleration : 0.0;
  }
  turning_ = sample.speed != 0.0 ? sample.speed : turning_;
}

void MeasuredSignal::learnSlowRoll(const OrbitSample& sample, bool due) {
  if (!(sample.speed > 0.0 && sample.speed < slow_below_)) {
    slow_filter_.clear();
    return;
  }
  slow_filter_.take(sample);
  if (!due) {
    return;
  }
  const OrbitEstimate estimate = slow_filter_.estimate();
  const bool sure =
      estimate.valid && estimate.orders[0].deviation < kSure * estimate.orders[0].major();
  if (sure && estimate.speed <= kAsSlow * slow_at_) {
    slow_roll_ = estimate.orders[0];
    slow_at_ = std::min(slow_at_, estimate.speed);
  }
}

bool MeasuredSignal::isSilent(const Probe& probe, double wall_time) const {
  return !probe.received || wall_time - probe.received_at > timeout_;
}

bool MeasuredSignal::isFit(double wall_time) const {
  return beyond_.empty() && std::none_of(probes_.begin(), probes_.end(), [&](const Probe& probe) {
           return !probe.why.empty() || isSilent(probe, wall_time);
         });
}

std::string MeasuredSignal::problem(double wall_time, bool paused) const {
  if (!received()) {
    return "";
  }
  for (const Probe& probe : probes_) {
    if (!probe.received) {
      return fmt::format("timeout: no sample of {} received yet", probe.name);
    }
    if (!paused && isSilent(probe, wall_time)) {
      return fmt::format("timeout: no sample of {} for {:.1f} s", probe.name,
                         wall_time - probe.received_at);
    }
    if (!probe.why.empty()) {
      return probe.why;
    }
  }
  const double silence = wall_time - pulse_at_;
  if (!paused && turning_ > kStandsSoon &&
      silence > std::max(timeout_, kFewTurns * kTwoPi / turning_)) {
    return fmt::format("timeout: no pulse of {} for {:.1f} s", settings_.keyphasor, silence);
  }
  const int rejected = orbit_.shaft().refusedLately();
  if (rejected >= kManyRejected) {
    return fmt::format("pulses rejected: {} of the last {} of {}", rejected, ShaftTracker::kLately,
                       settings_.keyphasor);
  }
  return beyond_;
}

}  // namespace whirl_twin
