#include "control/drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "messages/input_error.h"

namespace whirl_twin {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kNoneBefore = std::numeric_limits<double>::quiet_NaN();

bool runsTooFast(const BandedChange& plan) noexcept {
  return std::any_of(plan.speeds.begin(), plan.speeds.begin() + plan.count,
                     [](double speed) { return !(std::abs(speed) <= kMaxSpeed); });
}

}  // namespace

Drive::Drive(double speed, double angle) : Drive(speed, angle, {}) {}

Drive::Drive(double speed, double angle, const std::vector<SpeedMove>& moves,
             std::int64_t start_nanoseconds, ExclusionBands avoid)
    : avoid_(std::move(avoid)) {
  if (!(std::abs(speed) <= kMaxSpeed)) {
    throw InputError(fmt::format("drive: speed must be within +-1e6 rad/s, found {}", speed));
  }
  if (!(std::abs(angle) <= 1.0e15)) {
    throw InputError(fmt::format("drive: angle must be within +-1e15 rad, found {}", angle));
  }

  const auto append = [this](const SpeedSegment& motion, double target) {
    if (profile_.empty()) {
      profile_.push_back({motion, target, 0, 0.0, {}});
      return;
    }
    Segment& last = profile_.back();
    if (motion.constant() && last.motion.constant() && motion.speed == last.motion.speed) {
      last.motion.duration += motion.duration;
    } else {
      profile_.push_back({motion, target, 0, 0.0, {}});
    }
  };
  double total = 0.0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const SpeedMove& move = moves[i];
    if (const auto fault = faultOf(move)) {
      throw InputError(fmt::format("drive: profile move {}: {}, found {}", i + 1, fault->expected,
                                   fault->found));
    }
    const double allowed =
        avoid_.allowed(move.speed, move.max_acceleration, move.max_jerk, kNoneBefore);
    if (allowed != move.speed) {
      throw InputError(fmt::format(
          "drive: profile move {}: speed must be outside the barred speed ranges, found {} rad/s, "
          "nearest edge {} rad/s",
          i + 1, move.speed, allowed));
    }
    const BandedChange plan = avoid_.plan(speed, 0.0, move);
    if (runsTooFast(plan)) {
      throw InputError(fmt::format(
          "drive: profile move {}: must not exceed 1e6 rad/s when crossing a barred speed range",
          i + 1));
    }
    total += plan.duration + move.dwell;
    if (!(total <= kMaxDuration)) {
      throw InputError(fmt::format(
          "drive: profile move {}: the profile up to its end must last at most 1e9 s, found {} s",
          i + 1, total));
    }
    for (std::size_t c = 0; c < plan.count; ++c) {
      for (std::size_t k = 0; k < plan.changes[c].count; ++k) {
        append(plan.changes[c].segments[k], move.speed);
      }
    }
    speed = move.speed;
    if (move.dwell > 0.0) {
      append({move.dwell, speed, 0.0, 0.0}, speed);
    }
  }
  append({kForever, speed, 0.0, 0.0}, speed);

  profile_.front().first_tick = start_nanoseconds;
  profile_.front().angle = shaftAngle(angle);
  for (std::size_t i = 1; i < profile_.size(); ++i) {
    profile_[i] = following(profile_[i - 1], profile_[i].motion, profile_[i].target);
  }
  begin(start_nanoseconds);
}

std::pair<double, double> Drive::speedRange() const {
  std::pair<double, double> range{profile_.front().motion.speed, profile_.front().motion.speed};
  const auto take = [&range](double speed) {
    range.first = std::min(range.first, speed);
    range.second = std::max(range.second, speed);
  };
  for (const Segment& segment : profile_) {
    const SpeedSegment& m = segment.motion;
    const auto speed = [&m](double tau) {
      return m.speed + tau * (m.acceleration + 0.5 * tau * m.jerk);
    };
    take(m.speed);
    if (std::isfinite(m.duration)) {
      take(speed(m.duration));
    }
    const double turning = m.jerk != 0.0 ? -m.acceleration / m.jerk : -1.0;
    if (turning > 0.0 && turning < m.duration) {
      take(speed(turning));
    }
  }
  return range;
}

std::vector<double> Drive::constantSpeeds() const {
  std::vector<double> speeds;
  for (const Segment& segment : profile_) {
    const SpeedSegment& m = segment.motion;
    if (m.constant() && std::find(speeds.begin(), speeds.end(), m.speed) == speeds.end()) {
      speeds.push_back(m.speed);
    }
  }
  return speeds;
}

void Drive::beginInProfile() noexcept {
  if (time_ < first_tick_ || time_ >= until_) {
    enter(time_);
  }
  if (until_ != kLatest) {
    // Unsigned: times further apart than 292 years are no overflow.
    const std::uint64_t ticks =
        static_cast<std::uint64_t>(until_) - static_cast<std::uint64_t>(time_);
    remaining_ = static_cast<double>(ticks) / 1e9 - next_lead_;
  }
  within_ = kAngleUnknown;
  if (steady_) {
    return;
  }
  const Segment& segment = segments()[cursor_];
  const SpeedSegment& motion = segment.motion;
  const double tau = static_cast<double>(time_ - first_tick_) / 1e9 + segment.lead;
  speed_ = motion.speed + tau * (motion.acceleration + 0.5 * tau * motion.jerk);
  acceleration_ = motion.acceleration + tau * motion.jerk;
}

void Drive::findAngle() const noexcept {
  if (steady_) {
    angle_ = turn_.at(time_ - first_tick_);
  } else {
    const Segment& segment = segments()[cursor_];
    const SpeedSegment& motion = segment.motion;
    angle_ = advance(segment.angle, motion.speed, motion.acceleration, motion.jerk,
                     later(splitTime(time_ - first_tick_), segment.lead));
  }
  within_ = remaining_;
}

// Steps onto the segment that holds this time, and keeps what begin() needs of it.
void Drive::enter(std::int64_t time_nanoseconds) noexcept {
  const Segment* const all = segments();
  const std::size_t count = segmentCount();
  if (time_nanoseconds < all[cursor_].first_tick) {
    cursor_ = 0;
  }
  while (cursor_ + 1 < count && time_nanoseconds >= all[cursor_ + 1].first_tick) {
    ++cursor_;
  }
  const Segment& segment = all[cursor_];
  const SpeedSegment& motion = segment.motion;
  ++piece_;
  first_tick_ = segment.first_tick;
  steady_ = motion.constant();
  if (steady_) {
    turn_ = SteadyTurn(segment.angle, motion.speed, segment.lead);
  }
  speed_ = motion.speed;
  acceleration_ = motion.acceleration;
  jerk_ = motion.jerk;
  if (cursor_ + 1 < count) {
    until_ = all[cursor_ + 1].first_tick;
    next_lead_ = all[cursor_ + 1].lead;
  } else {
    until_ = kLatest;
    remaining_ = kForever;
  }
}

void Drive::findPlace(StateImage& image) noexcept {
  image.requireWithin(live_count_, std::size_t{0}, live_.size());
  bool sound = true;
  for (std::size_t i = 0; i < live_count_; ++i) {
    const Segment& segment = live_[i];
    const bool last = i + 1 == live_count_;
    sound = sound &&
            (last ? segment.motion.duration == kForever
                  : segment.motion.duration >= 0.0 && segment.motion.duration <= kMaxDuration) &&
            std::abs(segment.motion.speed) <= kMaxSpeed &&
            std::abs(segment.angle.remainder) < 7.0 && segment.lead >= 0.0 &&
            segment.lead <= 1.0e-9;
  }
  if (!image.require(sound)) {
    live_count_ = 0;
  }
  image.requireWithin(cursor_, std::size_t{0}, segmentCount() - 1);
  const std::uint64_t piece = piece_;
  enter(time_);
  begin(time_);
  piece_ = piece;
}

ShaftMotion Drive::beyond(double offset) const noexcept {
  if (within_ == kAngleUnknown) {
    findAngle();
    if (offset <= within_) {
      return at(offset);
    }
  }
  const Segment* segment = segments() + cursor_ + 1;
  double tau = offset - remaining_;
  for (; tau > segment->motion.duration; ++segment) {
    tau -= segment->motion.duration;
  }
  const SpeedSegment& motion = segment->motion;
  const ShaftAngle since{segment->angle.turns - angle_.turns, segment->angle.remainder};
  const double turned =
      tau * (motion.speed + tau * (0.5 * motion.acceleration + tau * motion.jerk * (1.0 / 6.0)));
  return {since.total() + turned,
          motion.speed + tau * (motion.acceleration + 0.5 * tau * motion.jerk),
          motion.acceleration + tau * motion.jerk, motion.jerk};
}

double Drive::cornerBeyond(double offset) const noexcept {
  double corner = remaining_;
  for (std::size_t i = cursor_ + 1; corner <= offset; ++i) {
    corner += segments()[i].motion.duration;  // the last piece has no end
  }
  return corner;
}

bool Drive::setSpeed(double speed, double max_acceleration, double max_jerk) noexcept {
  SpeedMove move{speed, max_acceleration, max_jerk, 0.0};
  if (faultOf(move) || !(std::abs(stoppingSpeed(speed_, acceleration_, max_jerk)) <= kMaxSpeed)) {
    return false;
  }
  move.speed = avoid_.allowed(speed, max_acceleration, max_jerk, targetSpeed());
  const BandedChange plan = avoid_.plan(speed_, acceleration_, move);
  if (!(plan.duration <= kMaxDuration) || runsTooFast(plan)) {
    return false;
  }

  // time_ and angle() are those of begin(), so the new pieces start from the present state.
  std::size_t count = 0;
  const auto append = [&](const SpeedSegment& piece) {
    live_[count] = count == 0 ? Segment{piece, move.speed, time_, 0.0, angle()}
                              : following(live_[count - 1], piece, move.speed);
    ++count;
  };
  for (std::size_t c = 0; c < plan.count; ++c) {
    for (std::size_t k = 0; k < plan.changes[c].count; ++k) {
      append(plan.changes[c].segments[k]);
    }
  }
  append({kForever, move.speed, 0.0, 0.0});
  live_count_ = count;
  cursor_ = 0;
  move_duration_ = plan.duration;
  enter(time_);
  begin(time_);
  return true;
}

void Drive::reset() noexcept {
  live_count_ = 0;
  cursor_ = 0;
  move_duration_ = 0.0;
  enter(profile_.front().first_tick);
  begin(profile_.front().first_tick);
}

Drive::Segment Drive::following(const Segment& segment, const SpeedSegment& motion,
                                double target) noexcept {
  // The end of the segment in nanoseconds after its first tick, duration * 1e9 - lead, is kept as
  // an exact product (high + low); the next tick is the whole number at or above it.
  const double duration = segment.motion.duration;
  const double high = duration * 1e9;
  const double low = std::fma(duration, 1e9, -high);
  const double up = std::ceil(high);
  double lead = ((up - high) - low) + segment.lead * 1e9;
  const double carry = std::floor(lead);
  lead -= carry;

  Segment next;
  next.motion = motion;
  next.target = target;
  next.first_tick =
      segment.first_tick + static_cast<std::int64_t>(up) - static_cast<std::int64_t>(carry);
  next.lead = lead * 1e-9;
  next.angle = advance(segment.angle, segment.motion.speed, segment.motion.acceleration,
                       segment.motion.jerk, {duration, 0.0});
  return next;
}

}  // namespace whirl_twin
