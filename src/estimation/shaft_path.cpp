#include "estimation/shaft_path.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kSmall = 1.0e-3;  // of a duration, for differences

}  // namespace

ShaftPath::ShaftPath(const ShaftInstant& from, const ShaftInstant& to, std::int64_t to_twin)
    : from_(from),
      start_(static_cast<double>(from.time + to_twin) * kNanosecond),
      angle_(from.angle.remainder),
      turn_{static_cast<double>(to.time - from.time) * kNanosecond, 0.0,
            to.angle.remainder - from.angle.remainder +
                ShaftAngle::kTurn * static_cast<double>(to.angle.turns - from.angle.turns),
            from.speed, to.speed} {}

Moment<double> ShaftPath::at(double part) const {
  const double t = part * duration();
  const double h = kSmall * duration();
  const double low = std::clamp(t, h, duration() - h);
  const double here = turn_.at(low), before = turn_.at(low - h), after = turn_.at(low + h);
  Moment<double> moment;
  moment.time = start_ + t;
  moment.angle = angle_ + turn_.at(t);
  moment.acceleration = (after - 2.0 * here + before) / (h * h);
  moment.speed = (after - before) / (2.0 * h) + (t - low) * moment.acceleration;
  return moment;
}

ShaftInstant ShaftPath::instantAt(std::int64_t time) const {
  const double t = static_cast<double>(time - from_.time) * kNanosecond;
  const double h = std::min({kSmall * duration(), t, duration() - t});
  const double a = angle_ + turn_.at(t);
  const double whole = std::floor(a / ShaftAngle::kTurn);
  return {time,
          {from_.angle.turns + static_cast<std::int64_t>(whole), a - whole * ShaftAngle::kTurn},
          (turn_.at(t + h) - turn_.at(t - h)) / (2.0 * h)};
}

}  // namespace whirl_twin
