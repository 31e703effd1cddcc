#include "control/speed_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kLeft = 1.0e-3;      // of the largest acceleration, at the highest speed
constexpr std::size_t kSteps = 48;    // of A(w), about
constexpr std::size_t kLooks = 2000;  // for the highest speed
constexpr int kBisections = 60;
constexpr std::size_t kPiecesOfStep = 3;  // up, along, down

void appendPiece(SpeedPlan& plan, const SpeedSegment& piece) noexcept {
  if (piece.duration > 0.0 && plan.count < plan.pieces.size()) {
    plan.pieces[plan.count++] = piece;
    plan.duration += piece.duration;
  }
}

}  // namespace

double ShaftLimits::torque(double speed) const noexcept {
  return std::max(0.0, motor.torque(std::abs(speed)));
}

double ShaftLimits::rise(double speed) const noexcept {
  const double surplus = (1.0 - reserve) * torque(speed) - motor.drag * std::abs(speed);
  return std::min(max_acceleration, surplus / inertia);
}

double ShaftLimits::fall(double speed) const noexcept {
  const double braking = (1.0 - reserve) * torque(speed) + motor.drag * std::abs(speed);
  return std::min(max_acceleration, braking / inertia);
}

SpeedPlanner::SpeedPlanner(const ShaftLimits& limits, double max_jerk, ExclusionBands avoid)
    : limits_(limits), max_jerk_(max_jerk), avoid_(std::move(avoid)) {
  const double left = kLeft * limits.max_acceleration;
  const auto rises = [&](double speed) {
    return limits.rise(speed) >= left && limits.fall(speed) >= left;
  };
  // The breakpoints of its characteristic, and beyond the last as far as it has torque.
  std::vector<double> corners{0.0};
  for (std::size_t i = 0; i < limits.motor.count; ++i) {
    if (limits.motor.points[i].speed > 0.0) {
      corners.push_back(limits.motor.points[i].speed);
    }
  }
  double beyond = std::max(1.0, corners.back());
  while (beyond < kMaxSpeed && rises(beyond)) {
    beyond *= 2.0;
  }
  corners.push_back(std::min(beyond, kMaxSpeed));
  // The first speed at which it has none.
  highest_ = rises(0.0) ? corners.back() : 0.0;
  for (std::size_t i = 1; i <= kLooks && highest_ == corners.back(); ++i) {
    double good = corners.back() * static_cast<double>(i - 1) / kLooks;
    double bad = corners.back() * static_cast<double>(i) / kLooks;
    if (!rises(bad)) {
      for (int k = 0; k < kBisections; ++k) {
        const double middle = 0.5 * (good + bad);
        (rises(middle) ? good : bad) = middle;
      }
      highest_ = good;
    }
  }
  corners.erase(std::remove_if(corners.begin(), corners.end(),
                               [&](double corner) { return corner >= highest_; }),
                corners.end());
  corners.push_back(highest_);
  const std::size_t parts = std::max<std::size_t>(1, kSteps / corners.size());
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    for (std::size_t k = 0; k < parts; ++k) {
      const double width = (corners[i + 1] - corners[i]) / static_cast<double>(parts);
      const double from = corners[i] + width * static_cast<double>(k);
      const double to = k + 1 == parts ? corners[i + 1] : from + width;
      // Between breakpoints both are linear, except for max_acceleration.
      steps_.push_back({from, to, std::min(limits.rise(from), limits.rise(to)),
                        std::min(limits.fall(from), limits.fall(to))});
    }
  }
}

SpeedPlan SpeedPlanner::staying(double speed) const {
  SpeedPlan plan;
  plan.pieces.resize(BandedChange::kMaxChanges * (kPiecesOfStep * (2 * steps_.size() + 1) + 1));
  plan.target = speed;
  return plan;
}

bool SpeedPlanner::plan(double speed, double acceleration, double target,
                        SpeedPlan& plan) const noexcept {
  const BandedChange goals =
      avoid_.plan(speed, acceleration, {target, limits_.max_acceleration, max_jerk_, 0.0});
  const auto within = [&](double goal) { return std::abs(goal) <= highest_; };
  if (!within(target) ||
      !std::all_of(goals.speeds.begin(), goals.speeds.begin() + goals.count, within)) {
    return false;
  }
  plan.count = 0;
  plan.duration = 0.0;
  plan.target = target;
  for (std::size_t i = 0; i < goals.count; ++i) {
    change(speed, acceleration, goals.speeds[i], plan);
    speed = goals.speeds[i];
    acceleration = 0.0;
  }
  return true;
}

// From here on with a sign, `up`, that makes the way one of rising speed.
void SpeedPlanner::change(double speed, double acceleration, double target,
                          SpeedPlan& plan) const noexcept {
  const double jerk = max_jerk_;
  const double missing = target - stoppingSpeed(speed, acceleration, jerk);
  const double up = std::copysign(1.0, missing != 0.0 ? missing : acceleration);
  double v = up * speed;
  double a = up * acceleration;
  const double goal = up * target;
  const auto give = [&](double duration, double from, double at, double j) {
    appendPiece(plan, {duration, up * from, up * at, up * j});
  };
  if (a < 0.0) {  // what goes the other way comes to nothing first
    give(-a / jerk, v, a, jerk);
    v -= a * a / (2.0 * jerk);
    a = 0.0;
  }
  // The steps between v and the goal: those of falling size below 0, of rising size above.
  struct Place {
    double to, limit, end;  // end: E where the step ends
  };
  std::array<Place, 2 * kSteps + 4> way;
  std::size_t count = 0;
  const auto enter = [&](double from, double to, double limit) {
    if (to > v && from < goal && count < way.size()) {
      way[count++] = {std::min(to, goal), limit, 0.0};
    }
  };
  for (std::size_t i = steps_.size(); i-- > 0;) {
    enter(i + 1 == steps_.size() ? -kMaxSpeed * 2.0 : -steps_[i].to, -steps_[i].from,
          steps_[i].fall);
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    enter(steps_[i].from, i + 1 == steps_.size() ? kMaxSpeed * 2.0 : steps_[i].to, steps_[i].rise);
  }
  const auto energy = [](double rate) { return 0.5 * rate * rate; };
  // Backward from the goal, then forward from where it is: E at the ends of the steps.
  for (std::size_t i = count; i-- > 0;) {
    const bool last = i + 1 == count;
    way[i].end = last ? 0.0
                      : std::min({energy(way[i].limit), energy(way[i + 1].limit),
                                  way[i + 1].end + jerk * (way[i + 1].to - way[i].to)});
  }
  double from = v;
  double begin = energy(a);
  for (std::size_t i = 0; i < count; ++i) {
    Place& place = way[i];
    const double length = place.to - from;
    place.end = std::min(place.end, begin + jerk * length);
    place.end = std::max(place.end, begin - jerk * length);
    const double limit = energy(place.limit);
    const double meet = 0.5 * (begin + place.end + jerk * length);
    // Beyond the limit it comes down to it at once, or to what it can.
    const bool beyond = begin > limit;
    const double top = beyond ? std::max(limit, place.end) : std::min(limit, meet);
    const double rate = top == limit ? place.limit : std::sqrt(2.0 * top);
    const double first = std::sqrt(2.0 * begin);
    const double last = std::sqrt(2.0 * place.end);
    give(std::abs(rate - first) / jerk, from, first, beyond ? -jerk : jerk);
    const double along = from + std::abs(top - begin) / jerk;
    const double down = place.to - std::max(0.0, top - place.end) / jerk;
    if (rate > 0.0) {
      give(std::max(0.0, down - along) / rate, along, rate, 0.0);
    }
    give((rate - last) / jerk, down, rate, -jerk);
    from = place.to;
    begin = place.end;
  }
}

SpeedSegment PlanCursor::at(const SpeedPlan& plan, double time) noexcept {
  while (piece < plan.count && time - begun >= plan.pieces[piece].duration) {
    begun += plan.pieces[piece++].duration;
  }
  if (piece == plan.count) {
    return {0.0, plan.target, 0.0, 0.0};
  }
  const SpeedSegment& at = plan.pieces[piece];
  const double tau = time - begun;
  return {0.0, at.speed + tau * (at.acceleration + 0.5 * tau * at.jerk),
          at.acceleration + tau * at.jerk, at.jerk};
}

}  // namespace whirl_twin
