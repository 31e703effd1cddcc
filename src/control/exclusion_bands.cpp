#include "control/exclusion_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "messages/input_error.h"

namespace whirl_twin {
namespace {

/// [-], of the speeds that enter: what rounding may make of a run-up that is just long enough.
constexpr double kRounding = 1.0e-12;

double runUpOf(double max_acceleration, double max_jerk) noexcept {
  return max_jerk == 0.0 ? 0.0 : max_acceleration * max_acceleration / (2.0 * max_jerk);
}

/// Of all changes of a plan.
struct Limits {
  double acceleration, jerk;
  double run_up;

  /// The speed from which the present acceleration is gained, or at which it is lost, at full jerk.
  double origin(double speed, double now) const noexcept {
    return jerk == 0.0 ? speed : speed - now * now / (2.0 * jerk);
  }
};

/// How a shaft leaves a band through its upper edge as fast as it can.
struct Exit {
  bool possible;  ///< it does not leave through the lower edge before
  double goal;    ///< [rad/s], where it can be brought to a stop then
  double time;    ///< [s], until it is at the edge
};

Exit upwards(const SpeedBand& band, double speed, double acceleration, const Limits& by) noexcept {
  if (by.jerk == 0.0) {
    return {true, band.to, (band.to - speed) / by.acceleration};
  }
  const double origin = by.origin(speed, acceleration);
  const double at_edge =
      std::min(by.acceleration, std::sqrt(2.0 * by.jerk * std::max(0.0, band.to - origin)));
  const double ramp = std::abs(at_edge - acceleration) / by.jerk;
  const double rest = band.to - speed - 0.5 * (acceleration + at_edge) * ramp;
  return {acceleration >= 0.0 || origin >= band.from, band.to + at_edge * at_edge / (2.0 * by.jerk),
          ramp + (at_edge > 0.0 ? std::max(0.0, rest) / at_edge : 0.0)};
}

SpeedBand mirrored(const SpeedBand& band) noexcept {
  return {-band.to, -band.from};
}

void appendChange(BandedChange& plan, const SpeedChange& change, double speed) noexcept {
  if (change.count > 0 && plan.count < plan.changes.size()) {
    plan.changes[plan.count] = change;
    plan.speeds[plan.count++] = speed;
    plan.duration += change.duration;
  }
}

}  // namespace

ExclusionBands::ExclusionBands(std::vector<SpeedBand> bands, double hysteresis)
    : hysteresis_(hysteresis) {
  if (!(hysteresis >= 0.0 && hysteresis <= 0.5)) {
    throw InputError(fmt::format(
        "hysteresis must be from 0 to 0.5 of the width of a barred speed range, found {}",
        hysteresis));
  }
  for (const SpeedBand& band : bands) {
    if (!(band.from > 0.0 && band.from < band.to && band.to <= kMaxSpeed)) {
      throw InputError(fmt::format("a band must be 0 < from < to <= {} rad/s, found from {} to {}",
                                   kMaxSpeed, band.from, band.to));
    }
  }
  const std::size_t given = bands.size();
  for (std::size_t i = 0; i < given; ++i) {
    bands.push_back(mirrored(bands[i]));
  }
  std::sort(bands.begin(), bands.end(),
            [](const SpeedBand& a, const SpeedBand& b) { return a.from < b.from; });
  for (const SpeedBand& band : bands) {
    if (!bands_.empty() && band.from < bands_.back().to) {
      bands_.back().to = std::max(bands_.back().to, band.to);
    } else {
      bands_.push_back(band);
    }
  }
}

template <class Visit>
void ExclusionBands::visitMerged(double run_up, Visit visit) const noexcept {
  for (std::size_t i = 0; i < bands_.size();) {
    SpeedBand band = bands_[i];
    for (++i; i < bands_.size(); ++i) {
      const bool across_rest = band.to < 0.0 && bands_[i].from > 0.0;
      if (across_rest || bands_[i].from - band.to >= run_up * (1.0 - kRounding)) {
        break;
      }
      band.to = bands_[i].to;
    }
    visit(band);
  }
}

std::optional<SpeedBand> ExclusionBands::around(double speed, double run_up) const noexcept {
  std::optional<SpeedBand> found;
  visitMerged(run_up, [&](const SpeedBand& band) {
    if (band.holds(speed)) {
      found = band;
    }
  });
  return found;
}

std::optional<SpeedBand> ExclusionBands::bandOf(double target, double max_acceleration,
                                                double max_jerk) const noexcept {
  return around(target, runUpOf(max_acceleration, max_jerk));
}

double ExclusionBands::allowed(double target, double max_acceleration, double max_jerk,
                               double before) const noexcept {
  const std::optional<SpeedBand> band = bandOf(target, max_acceleration, max_jerk);
  if (!band) {
    return target;
  }
  const double width = hysteresis_ * (band->to - band->from);
  const double turn =
      band->centre() + (before == band->from ? width : 0.0) - (before == band->to ? width : 0.0);
  return target >= turn ? band->to : band->from;
}

BandedChange ExclusionBands::plan(double speed, double acceleration,
                                  const SpeedMove& move) const noexcept {
  const Limits by{move.max_acceleration, move.max_jerk,
                  runUpOf(move.max_acceleration, move.max_jerk)};
  const double target = move.speed;
  BandedChange plan;
  double v = speed;
  double a = acceleration;
  const auto go = [&](double to) {
    appendChange(plan, planSpeedChange(v, a, {to, by.acceleration, by.jerk, 0.0}), to);
    v = to;
    a = 0.0;
  };
  // Beyond an edge by a part of the run-up, but not beyond rest, on the way (up: 1) out of a band.
  const auto clear = [&](double edge, double up, double beyond) {
    const double place = edge + up * beyond;
    return place * edge < 0.0 ? 0.0 : place;
  };
  const double short_of = by.run_up * (1.0 - kRounding) - kRounding * std::abs(speed);

  // From here on with a sign, `up`, that makes the way upwards. The bands in which a way from v to
  // the target begins, and ends.
  const auto crossed = [&](double up) {
    std::optional<SpeedBand> first, last;
    visitMerged(by.run_up, [&](const SpeedBand& merged) {
      const SpeedBand band = up > 0.0 ? merged : mirrored(merged);
      if (band.from >= up * v && band.to <= up * target) {
        first = !first || band.from < first->from ? band : *first;
        last = !last || band.to > last->to ? band : *last;
      }
    });
    return std::pair(first, last);
  };
  // To the target or, if that is too near to the last band, beyond it and back.
  const auto finish = [&](double up, const std::optional<SpeedBand>& last) {
    if (last && up * target - last->to < short_of) {
      go(up * clear(last->to, 1.0, by.run_up));
    }
    go(target);
  };

  // The band that it is in, or cannot stop before.
  std::optional<SpeedBand> band = around(v, by.run_up);
  const double stop = stoppingSpeed(v, a, by.jerk);
  const double onward = stop >= v ? 1.0 : -1.0;
  const double slack = kRounding * (std::abs(v) + std::abs(stop));
  if (!band) {
    visitMerged(by.run_up, [&](const SpeedBand& merged) {
      const SpeedBand ahead = onward > 0.0 ? merged : mirrored(merged);
      const bool nearest = !band || ahead.from < (onward > 0.0 ? *band : mirrored(*band)).from;
      if (ahead.from >= onward * v && ahead.from < onward * stop - slack && nearest) {
        band = merged;
      }
    });
  }
  if (band) {
    const Exit above = upwards(*band, v, a, by);
    const Exit below = upwards(mirrored(*band), -v, -a, by);
    const SpeedBand ahead = onward > 0.0 ? *band : mirrored(*band);
    const double entered = std::max(onward * v, ahead.from);
    const bool full =
        by.jerk > 0.0 && std::abs(a) > 0.0 && entered - by.origin(onward * v, a) >= short_of;
    const double up = full                                          ? onward
                      : !above.possible                             ? -1.0
                      : !below.possible || above.time <= below.time ? 1.0
                                                                    : -1.0;
    const double edge = up > 0.0 ? band->to : -band->from;
    const double goal = clear(edge, 1.0, (up > 0.0 ? above.goal : below.goal) - edge);
    if (up * target >= goal) {
      v = up * edge;
      const auto last = crossed(up).second;
      v = speed;
      finish(up, last);
      return plan;
    }
    go(up * goal);
  }

  const double up = target >= v ? 1.0 : -1.0;
  const auto [first, last] = crossed(up);
  if (first && first->from - by.origin(up * v, a) < short_of) {
    const double back = up * clear(first->from, -1.0, by.run_up);
    if (up * back < up * v) {
      go(back);
    }
  }
  finish(up, last);
  return plan;
}

}  // namespace whirl_twin
