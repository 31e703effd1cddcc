#include "monitoring/resonance_alarms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "messages/alert.h"

namespace whirl_twin {
namespace {

constexpr double kRepeatWindow = 2.0;    // s, after an alarm has cleared
constexpr double kTurningHorizon = 5.0;  // approach times, that a speed may take to turn back
constexpr double kSlowHalf = 0.5;        // dwell limits, that a ripple may hold a passage back
constexpr double kTrail = 2.0 / 3.0;     // dwell limits, that a mean acceleration is taken over
constexpr double kTrailStep = 0.1;       // s, between the speeds that a mean is made of
constexpr double kMaxCountdown = 60.0;   // s: what is further away is no countdown
constexpr double kSteadyChange = 0.005;  // of the critical speed, that a captured speed varies
constexpr double kSteadyFor = 1.5;       // s
constexpr double kNearCapture = 0.1;     // of the critical speed, from where a capture is

bool isEmpty(const state::CriticalSpeedMargin& critical) {
  return !(critical.band_low < critical.band_high);
}

std::string criticalSpeedText(const state::CriticalSpeedMargin& critical) {
  return "critical speed " + shaftSpeedText(critical.speed);
}

void describe(const state::DriveState& shaft, const state::CriticalSpeedMargin& critical,
              state::Alert& alert) {
  alert.speed = shaft.speed;
  alert.acceleration = shaft.acceleration;
  alert.critical_speed = critical.speed;
  alert.separation_margin = critical.separation_margin;
  alert.required_separation_margin = critical.required_separation_margin;
  alert.amplification_factor = critical.amplification_factor;
}

std::string bandText(const state::CriticalSpeedMargin& critical) {
  return fmt::format("between {} and {}", shaftSpeedText(critical.band_low),
                     shaftSpeedText(critical.band_high));
}

}  // namespace

/// A band the present move reaches from outside.
struct CriticalSpeedAlarm::Entry {
  Place place;
  double time = 0.0;      ///< [s] to the edge; infinite while there is no acceleration toward it
  bool creeping = false;  ///< within the hysteresis of the edge

  bool operator<(const Entry& other) const {
    return time < other.time || (time == other.time && creeping && !other.creeping);
  }
};

void CriticalSpeedAlarm::update(const state::DriveState& shaft,
                                const CriticalSpeeds& critical_speeds, AlertList& alerts) {
  if (!std::isfinite(shaft.speed) || !std::isfinite(shaft.at.time)) {
    band_alarm_.step(shaft.at.time, AlarmCondition::kHold);
    approach_alarm_.step(shaft.at.time, AlarmCondition::kHold);
    return;
  }
  // A cause that is back a moment after its alarm has cleared is a repeat, until it lasts as long
  // as a dwell.
  const ConditionAlarm::Repeats repeats{settings_->clear_delay + kRepeatWindow,
                                        settings_->dwell_limit};
  band_alarm_.state().setRepeats(repeats);
  approach_alarm_.state().setRepeats(repeats);
  updateBand(shaft, critical_speeds, alerts);
  updateApproach(shaft, critical_speeds, alerts);
}

double CriticalSpeedAlarm::widening(double edge) const {
  return settings_->hysteresis * std::abs(edge);
}

bool CriticalSpeedAlarm::inOrNear(double speed, const state::CriticalSpeedMargin& critical) const {
  return !isEmpty(critical) && std::abs(speed) >= critical.band_low - widening(critical.band_low) &&
         std::abs(speed) <= critical.band_high + widening(critical.band_high);
}

void CriticalSpeedAlarm::updateBand(const state::DriveState& shaft,
                                    const CriticalSpeeds& critical_speeds, AlertList& alerts) {
  const double speed = std::abs(shaft.speed);
  const double time = shaft.at.time;
  bool near = false;
  const bool reverse = shaft.speed < 0.0;
  std::optional<std::size_t> occupied;
  for (std::size_t i = 0; i < critical_speeds.size(); ++i) {
    const state::CriticalSpeedMargin& critical = critical_speeds[i];
    near = near || inOrNear(speed, critical);
    const bool inside =
        !isEmpty(critical) && speed >= critical.band_low && speed <= critical.band_high;
    // Where bands overlap the nearest critical speed is the one to report.
    if (inside && (!occupied || std::abs(speed - critical.speed) <
                                    std::abs(speed - critical_speeds[*occupied].speed))) {
      occupied = i;
    }
  }

  // The time in the band runs on through excursions within the hysteresis, or too short to clear,
  // so that a speed that wavers about the edge still counts as dwelling.
  if (occupied && ((!passing_ && !band_alarm_.active()) || time < entered_at_)) {
    entered_at_ = in_time_at_ = time;
    trail_.clear();
  }
  if (occupied) {
    const Place now{*occupied, reverse};
    if (!(now == stay_) && !band_alarm_.active()) {
      band_alarm_.state().forgetCause();
    }
    stay_ = now;
  }
  passing_ = occupied || (passing_ && near);
  if (passing_ && stay_ == approached_) {
    approach_alarm_.state().causeSeen(time);
  }

  AlarmCondition condition =
      near || turnsBack(shaft, critical_speeds) ? AlarmCondition::kHold : AlarmCondition::kClear;
  if (occupied) {
    const bool passing = passes(shaft, critical_speeds);
    const bool dwells = time - entered_at_ >= settings_->dwell_limit && !passing;
    condition = dwells ? AlarmCondition::kDanger : AlarmCondition::kWarning;
  }
  band_alarm_.update(
      time, condition, alerts,
      [&](state::Alert& alert) {
        const state::CriticalSpeedMargin& critical = critical_speeds[*occupied];
        describe(shaft, critical, alert);
        // No live numbers: the latched list is published again only when a decision changes.
        alert.text = alert.severity == state::Severity::kDanger
                         ? fmt::format("longer than {:g} s near {}: leave the range {}",
                                       settings_->dwell_limit, criticalSpeedText(critical),
                                       bandText(critical))
                         : fmt::format("passing {}: do not dwell {}", criticalSpeedText(critical),
                                       bandText(critical));
        return fmt::format("critical {}", *occupied);
      },
      [&] { return fmt::format("left the critical band, speed {}", shaftSpeedText(speed)); });
}

void CriticalSpeedAlarm::updateApproach(const state::DriveState& shaft,
                                        const CriticalSpeeds& critical_speeds, AlertList& alerts) {
  const double time = shaft.at.time;
  if (!std::isfinite(shaft.acceleration)) {
    approach_alarm_.step(time, AlarmCondition::kHold);
    return;
  }
  const bool entered = passing_ && approached_.index < critical_speeds.size() &&
                       inOrNear(shaft.speed, critical_speeds[approached_.index]);
  if (approach_alarm_.active() && entered) {
    approach_alarm_.state().clearNow();
    alerts.clear(band_alarm_.subject(), alert_type::kCriticalSpeedApproach, time,
                 fmt::format("{}: entered the critical band {} of {}", band_alarm_.subject(),
                             bandText(critical_speeds[approached_.index]),
                             criticalSpeedText(critical_speeds[approached_.index])));
  }

  const std::optional<Entry> entry = nextEntry(shaft, critical_speeds);
  AlarmCondition condition = entry ? AlarmCondition::kHold : AlarmCondition::kClear;
  const bool imminent = entry && (entry->time < settings_->approach_time || entry->creeping);
  if (imminent) {
    condition = AlarmCondition::kWarning;
    if (!(entry->place == approached_) && !approach_alarm_.active()) {
      approach_alarm_.state().forgetCause();
    }
    approached_ = entry->place;
  }
  approach_alarm_.update(
      time, condition, alerts,
      [&](state::Alert& alert) {
        const state::CriticalSpeedMargin& critical = critical_speeds[entry->place.index];
        const double speed = std::abs(shaft.speed);
        describe(shaft, critical, alert);
        std::string when = fmt::format("close to {}", shaftSpeedText(speed));
        if (entry->time < kMaxCountdown) {
          alert.time_to_entry = entry->time;
          when = fmt::format("band entered in {:.1f} s at {:.3g} rad/s^2", entry->time,
                             std::abs(shaft.acceleration));
        }
        alert.text = fmt::format("{}, {}: do not dwell {}", criticalSpeedText(critical), when,
                                 bandText(critical));
        return fmt::format("critical {} from {}", entry->place.index,
                           speed < critical.speed ? "below" : "above");
      },
      [&] { return "the speed no longer approaches a critical band"; });
}

std::optional<CriticalSpeedAlarm::Entry> CriticalSpeedAlarm::entryOf(
    const state::DriveState& shaft, const state::CriticalSpeedMargin& critical, Place place) const {
  const double low = place.reverse ? -critical.band_high : critical.band_low;
  const double high = place.reverse ? -critical.band_low : critical.band_high;
  const bool below = shaft.speed < low;
  const double edge = below ? low : high;
  const double distance = below ? low - shaft.speed : shaft.speed - high;
  const double toward = below ? shaft.acceleration : -shaft.acceleration;
  // Nor does a shaft of which nothing else is known turn round.
  bool reached = toward > 0.0 && (place.reverse ? shaft.speed <= 0.0 : shaft.speed >= 0.0);
  if (!std::isnan(shaft.target_speed)) {
    reached = below ? shaft.target_speed >= low : shaft.target_speed <= high;
  }
  if (distance < 0.0 || !reached) {
    return std::nullopt;
  }
  const double time = toward > 0.0 ? distance / toward : kInfinity;
  return Entry{place, time, distance <= widening(edge)};
}

std::optional<CriticalSpeedAlarm::Entry> CriticalSpeedAlarm::nextEntry(
    const state::DriveState& shaft, const CriticalSpeeds& critical_speeds) const {
  std::optional<Entry> next;
  for (std::size_t i = 0; i < critical_speeds.size(); ++i) {
    const state::CriticalSpeedMargin& critical = critical_speeds[i];
    // A band just left, or just entered, is the concern of the other alarm.
    if (isEmpty(critical) || (passing_ && inOrNear(shaft.speed, critical))) {
      continue;
    }
    for (const bool reverse : {false, true}) {
      const Place place{i, reverse};
      if (band_alarm_.active() && place == stay_) {
        continue;
      }
      const std::optional<Entry> entry = entryOf(shaft, critical, place);
      if (entry && (!next || *entry < *next)) {
        next = entry;
      }
    }
  }
  return next;
}

bool CriticalSpeedAlarm::turnsBack(const state::DriveState& shaft,
                                   const CriticalSpeeds& critical_speeds) const {
  if (!band_alarm_.active() || stay_.index >= critical_speeds.size() ||
      isEmpty(critical_speeds[stay_.index])) {
    return false;
  }
  const auto entry = entryOf(shaft, critical_speeds[stay_.index], stay_);
  return entry && entry->time < kTurningHorizon * settings_->approach_time;
}

bool CriticalSpeedAlarm::leavesInTime(const state::DriveState& shaft, double acceleration,
                                      const CriticalSpeeds& critical_speeds) const {
  const double sense = shaft.speed < 0.0 ? -1.0 : 1.0;
  const double speed = std::abs(shaft.speed);
  // Bands that overlap are one to be passed, and each may take its time.
  double low = speed;
  double high = speed;
  std::vector<bool> joined(critical_speeds.size(), false);
  int bands = 0;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t i = 0; i < critical_speeds.size(); ++i) {
      const state::CriticalSpeedMargin& critical = critical_speeds[i];
      if (!joined[i] && !isEmpty(critical) && critical.band_low <= high &&
          critical.band_high >= low) {
        joined[i] = grows = true;
        ++bands;
        low = std::min(low, critical.band_low);
        high = std::max(high, critical.band_high);
      }
    }
  }
  const double outward = sense * acceleration;
  const bool upward = outward > 0.0;
  const double edge = upward ? high : low;
  const double target = sense * shaft.target_speed;
  if (!(std::abs(outward) > 0.0) || (upward ? target <= edge : target >= edge)) {
    return false;  // it stays, or means to
  }
  const double left = (edge - speed) / outward;
  return shaft.at.time + left <= entered_at_ + (1 + bands) * settings_->dwell_limit;
}

bool CriticalSpeedAlarm::passes(const state::DriveState& shaft,
                                const CriticalSpeeds& critical_speeds) {
  const double time = shaft.at.time;
  if (trail_.empty() || time >= trail_.back().time + kTrailStep) {
    trail_.push_back({time, shaft.speed});
  }
  while (trail_.size() > 1 && trail_[1].time <= time - kTrail * settings_->dwell_limit) {
    trail_.pop_front();
  }
  if (leavesInTime(shaft, shaft.acceleration, critical_speeds)) {
    in_time_at_ = time;
  }
  const double since = time - trail_.front().time;
  const double mean =
      since > 0.0 ? (shaft.speed - trail_.front().speed) / since : shaft.acceleration;
  // A ripple has moments that promise everything, and others that promise nothing.
  return shaft.acceleration != 0.0 && time - in_time_at_ <= kSlowHalf * settings_->dwell_limit &&
         leavesInTime(shaft, mean, critical_speeds);
}

void CaptureAlarm::hold() {
  alarm_.hold();
  steady_ = false;
}

bool CaptureAlarm::isSteady(double time, double speed, double scale) {
  if (!steady_ || time < steady_since_ || std::abs(speed - steady_at_) > kSteadyChange * scale) {
    steady_ = true;
    steady_since_ = time;
    steady_at_ = speed;
  }
  return time - steady_since_ >= kSteadyFor;
}

void CaptureAlarm::update(const state::DriveState& shaft, const std::vector<CaptureSpeed>& captures,
                          AlertList& alerts) {
  const double time = shaft.at.time;
  const double speed = shaft.speed;
  if (!std::isfinite(speed) || !std::isfinite(time)) {
    alarm_.step(time, AlarmCondition::kHold);
    return;
  }
  // A band that is behind it, by more than the hysteresis, captures it no more.
  const auto ahead = std::find_if(captures.begin(), captures.end(), [&](const CaptureSpeed& c) {
    return speed <= (1.0 + alarm_.settings().hysteresis) * c.band.to;
  });
  AlarmCondition condition = AlarmCondition::kClear;
  if (ahead != captures.end()) {
    const bool steady = isSteady(time, speed, ahead->critical_speed);
    const bool near = std::abs(speed - ahead->speed) <= kNearCapture * ahead->critical_speed;
    condition = speed > ahead->escape ? AlarmCondition::kHold : AlarmCondition::kWarning;
    condition = steady && near ? AlarmCondition::kDanger : condition;
  }
  alarm_.update(
      time, condition, alerts,
      [&](state::Alert& alert) {
        alert.speed = speed;
        alert.acceleration = shaft.acceleration;
        alert.critical_speed = ahead->critical_speed;
        const std::string where = "critical speed " + shaftSpeedText(ahead->critical_speed);
        alert.text =
            alert.severity == state::Severity::kDanger
                ? fmt::format(
                      "resonance capture near {} by {}: the whirl absorbs all the motor's "
                      "torque: switch the motor off or raise its torque",
                      shaftSpeedText(ahead->speed), where)
                : fmt::format(
                      "the motor has less torque than {} needs, resonance capture at {} "
                      "expected: stay below {} or raise the torque",
                      where, shaftSpeedText(ahead->speed), shaftSpeedText(ahead->band.from));
        return fmt::format("capture {}", ahead - captures.begin());
      },
      [&] { return fmt::format("the resonance was passed, speed {}", shaftSpeedText(speed)); });
}

}  // namespace whirl_twin
