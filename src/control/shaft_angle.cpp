#include "control/shaft_angle.h"

#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {
namespace {

// 2 pi as the sum of two doubles.
constexpr double kTwoPiLow = 2.4492935982947064e-16;

// Turns per nanosecond at 1 rad/s, 1e-9 / (2 pi), as the sum of two doubles.
constexpr double kTurnRate = 1.5915494309189532e-10;
constexpr double kTurnRateLow = 1.1274188717473671e-26;

// high + low, with |low| <= ulp(high) / 2 after each operation.
using DoubleDouble = SplitTime;

[[gnu::always_inline]] inline DoubleDouble sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

// a + b where |a| >= |b| or a is zero.
[[gnu::always_inline]] inline DoubleDouble orderedSum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

[[gnu::always_inline]] inline DoubleDouble plus(const DoubleDouble& a, double b) {
  const DoubleDouble head = sum(a.high, b);
  return orderedSum(head.high, head.low + a.low);
}

[[gnu::always_inline]] inline DoubleDouble times(const DoubleDouble& a, const DoubleDouble& b) {
  const double high = a.high * b.high;
  const double error = std::fma(a.high, b.high, -high);
  return orderedSum(high, error + (a.high * b.low + a.low * b.high));
}

[[gnu::always_inline]] inline DoubleDouble times(const DoubleDouble& a, double b) {
  const double high = a.high * b;
  return orderedSum(high, std::fma(a.high, b, -high) + a.low * b);
}

// value / 6 with the remainder of the division.
[[gnu::always_inline]] inline DoubleDouble sixth(double value) {
  const double high = value * (1.0 / 6.0);
  return {high, std::fma(-6.0, high, value) * (1.0 / 6.0)};
}

// Beyond, turns cannot be counted, and a double resolves none: a motor that nothing holds may come
// here, a step before its state is no longer finite.
constexpr double kFarthest = 1e17;  // rad
constexpr double kFastest = 0.25;   // turns in a nanosecond

[[gnu::always_inline]] inline ShaftAngle add(const ShaftAngle& angle, const DoubleDouble& turned) {
  if (__builtin_expect(!(std::fabs(turned.high) < kFarthest), 0)) {
    return angle;
  }
  const double ratio = turned.high * (1.0 / kTwoPi);
  std::int64_t turns = static_cast<std::int64_t>(ratio + (ratio < 0.0 ? -0.5 : 0.5));

  // turned.high - whole is exact: they are equal, or within a factor of two of each other
  // (Sterbenz); the errors of the product are added after the large parts have cancelled.
  const double count = static_cast<double>(turns);
  const double whole = count * kTwoPi;
  const double whole_error = std::fma(count, kTwoPi, -whole);
  double remainder = (turned.high - whole) + ((turned.low - whole_error) - count * kTwoPiLow);
  remainder += angle.remainder;

  if (remainder < 0.0) {
    remainder += kTwoPi;
    --turns;
  } else if (remainder >= kTwoPi) {
    remainder -= kTwoPi;
    ++turns;
  }
  // A remainder just below zero rounds up to 2 pi itself.
  if (remainder >= kTwoPi) {
    remainder = 0.0;
    ++turns;
  }
  return {angle.turns + turns, remainder};
}

}  // namespace

double ShaftAngle::total() const noexcept {
  return std::fma(static_cast<double>(turns), kTwoPi, remainder);
}

SplitTime splitTime(std::int64_t nanoseconds) noexcept {
  constexpr std::int64_t kPerSecond = 1000000000;
  const std::int64_t whole = nanoseconds / kPerSecond;
  const double seconds = static_cast<double>(whole);
  const double rest = static_cast<double>(nanoseconds - whole * kPerSecond);
  // rest / 1e9 with the remainder of the division, which is exact in double.
  const double fraction = rest * 1e-9;
  const double fraction_error = std::fma(-1e9, fraction, rest) * 1e-9;
  const SplitTime head = orderedSum(seconds, fraction);
  return {head.high, head.low + fraction_error};
}

SplitTime later(const SplitTime& time, double seconds) noexcept {
  return plus(time, seconds);
}

ShaftAngle shaftAngle(double angle) noexcept {
  return add({}, {angle, 0.0});
}

namespace {

__extension__ typedef __int128 Int128;

// In a nanosecond at a speed [rad/s].
DoubleDouble turnsAt(double speed) {
  const DoubleDouble turns = times({kTurnRate, kTurnRateLow}, speed);
  return std::fabs(turns.high) < kFastest ? turns : DoubleDouble{};
}

// These, times 2^128.
Int128 turnRate(const DoubleDouble& turns) {
  return static_cast<Int128>(turns.high * 0x1p128) + static_cast<Int128>(turns.low * 0x1p128);
}

}  // namespace

SteadyTurn::SteadyTurn(const ShaftAngle& angle, double speed, double lead) noexcept
    : start_(angle) {
  const DoubleDouble turns = turnsAt(speed);
  const Int128 rate = turnRate(turns);
  rate_high_ = static_cast<std::int64_t>(rate >> 64);
  rate_low_ = static_cast<std::uint64_t>(rate);
  lead_ = static_cast<std::int64_t>(turns.high * (lead * 1e9) * 0x1p64) + (1 << 10);
}

SplitAngle turnIn(double speed, std::int64_t nanoseconds) noexcept {
  __extension__ typedef unsigned __int128 Whole;
  // Modulo one turn, by overflow; as a signed number from half a turn back to half a turn on.
  const Int128 rate = turnRate(turnsAt(speed));
  const auto part = static_cast<Int128>(static_cast<Whole>(rate) * static_cast<Whole>(nanoseconds));
  constexpr int kRest = 128 - 53;  // bits
  const Int128 head = part >> kRest;
  const Int128 rest = part - head * (Int128{1} << kRest);
  const DoubleDouble angle =
      times({kTwoPi, kTwoPiLow},
            orderedSum(static_cast<double>(head) * 0x1p-53, static_cast<double>(rest) * 0x1p-128));
  return {angle.high, angle.low};
}

ShaftAngle advance(const ShaftAngle& angle, double speed, std::int64_t nanoseconds) noexcept {
  return SteadyTurn(angle, speed, 0.0).at(nanoseconds);
}

// With fused products where the processor has them: elsewhere each is a call.
#if defined(__x86_64__) && !defined(__clang__)
__attribute__((target_clones("fma", "default")))
#endif
ShaftAngle
advance(const ShaftAngle& angle, double speed, double acceleration, double jerk,
        const SplitTime& time) noexcept {
  if (acceleration == 0.0 && jerk == 0.0) {
    return add(angle, times(time, speed));
  }
  // Horner's rule for ((j/6 tau + a/2) tau + v) tau.
  if (jerk == 0.0) {
    return add(angle, times(time, plus(times(time, 0.5 * acceleration), speed)));
  }
  const DoubleDouble slope = plus(times(time, sixth(jerk)), 0.5 * acceleration);
  return add(angle, times(time, plus(times(time, slope), speed)));
}

}  // namespace whirl_twin
