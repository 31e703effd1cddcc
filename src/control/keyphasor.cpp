#include "control/keyphasor.h"

#include <cmath>

#include "algebra/constants.h"
#include "control/sensor.h"

namespace whirl_twin {

namespace {

/// Halvings that leave less than a nanosecond of the longest step of a scene, 10 s.
constexpr int kHalvings = 64;

}  // namespace

std::vector<std::int64_t> Keyphasor::pulses(const ShaftInstant& from,
                                            const ShaftInstant& to) const {
  std::vector<std::int64_t> instants;
  const double length = static_cast<double>(to.time - from.time) * 1.0e-9;
  if (!(length > 0.0)) {
    return instants;
  }
  // Angles count from the turn at `from`: so that no digit is lost after 1e9 turns.
  const double start = from.angle.remainder;
  const double end =
      to.angle.remainder + kTwoPi * static_cast<double>(to.angle.turns - from.angle.turns);
  const CubicPiece angle{length, start, end, from.speed, to.speed};
  const bool forward = end >= start;
  const auto passed = [&](double a) { return std::floor((a - settings_.mark) / kTwoPi); };
  const auto first = static_cast<std::int64_t>(passed(start));
  const auto last = static_cast<std::int64_t>(passed(end));
  for (std::int64_t turn = first; turn != last; forward ? ++turn : --turn) {
    const std::int64_t pulse = forward ? turn + 1 : turn;
    const double mark = settings_.mark + kTwoPi * static_cast<double>(pulse);
    double low = 0.0;
    double high = length;
    for (int i = 0; i < kHalvings && high - low > 1.0e-12 * length; ++i) {
      const double middle = 0.5 * (low + high);
      ((angle.at(middle) < mark) == forward ? low : high) = middle;
    }
    double instant = 0.5 * (low + high) * 1.0e9;  // [ns] after from.time
    if (settings_.jitter > 0.0) {
      instant += 1.0e9 * settings_.jitter * noise_.normal(from.angle.turns + pulse);
    }
    std::int64_t stamp = from.time + std::llround(instant);
    const std::int64_t tick = std::llround(settings_.resolution * 1.0e9);
    if (tick > 1) {
      stamp = tick * (stamp / tick);
    }
    instants.push_back(stamp);
  }
  return instants;
}

}  // namespace whirl_twin
