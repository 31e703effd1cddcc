#include "analysis/loop_instants.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr long double kNanoseconds = 1e9L;  // a second
/// Rates are doubles: ratios as near as this to one of small whole numbers are meant to be it.
constexpr double kSameRatio = 1e-12;
constexpr long double kRoundingOfPeriod = 1e-15L;
/// Ticks of a period that is no whole number of nanoseconds: finer than any double of it.
constexpr std::int64_t kFinestPeriod = std::int64_t{1} << 50;
constexpr std::int64_t kMaxCommonMultiple = std::int64_t{1} << 40;

struct Ratio {
  std::int64_t over = 0, under = 1;
};

/// The simplest fraction of whole numbers up to kMaxLoopSamples that is x, by its continued
/// fraction.
std::optional<Ratio> ratioOf(double x) {
  Ratio before{1, 0};
  Ratio ratio{static_cast<std::int64_t>(std::fmin(std::floor(x), 2.0 * kMaxLoopSamples)), 1};
  double rest = x - std::floor(x);
  while (ratio.over <= kMaxLoopSamples && ratio.under <= kMaxLoopSamples) {
    const auto value = static_cast<double>(ratio.over) / static_cast<double>(ratio.under);
    if (std::fabs(value - x) <= kSameRatio * x) {
      return ratio;
    }
    if (!(rest > 0.0)) {
      break;
    }
    const double whole = std::floor(1.0 / rest);
    if (whole > 2.0 * kMaxLoopSamples) {
      break;
    }
    rest = 1.0 / rest - whole;
    const auto digit = static_cast<std::int64_t>(whole);
    const Ratio next{digit * ratio.over + before.over, digit * ratio.under + before.under};
    before = ratio;
    ratio = next;
  }
  return std::nullopt;
}

[[noreturn]] void noCommonPeriod(const std::vector<LoopController>& controllers) {
  std::vector<std::string> rates;
  for (const LoopController& controller : controllers) {
    rates.push_back(fmt::format("{:.17g} ({})", controller.rate, controller.name));
  }
  throw RunFailure(
      fmt::format("sampled loop: the rates {} Hz must have a common period of at most {} samples "
                  "for an analysis (a simulation is possible)",
                  fmt::join(rates, ", "), kMaxLoopSamples));
}

/// Of each controller in the shortest common period.
std::vector<int> samplesInPeriod(const std::vector<LoopController>& controllers) {
  std::vector<Ratio> ratios;
  std::int64_t first = 1;  // samples of the first controller
  for (const LoopController& controller : controllers) {
    const std::optional<Ratio> ratio = ratioOf(controller.rate / controllers.front().rate);
    if (!ratio) {
      noCommonPeriod(controllers);
    }
    ratios.push_back(*ratio);
    first = std::lcm(first, ratio->under);
    if (first > kMaxLoopSamples) {
      noCommonPeriod(controllers);
    }
  }
  std::vector<int> samples;
  std::int64_t all = 0;
  for (const Ratio& ratio : ratios) {
    all += first * ratio.over / ratio.under;
    if (all > kMaxLoopSamples) {
      noCommonPeriod(controllers);
    }
    samples.push_back(static_cast<int>(first * ratio.over / ratio.under));
  }
  return samples;
}

/// The unit of time, and how many of it the period has.
void chooseTick(const std::vector<LoopController>& controllers, LoopInstants& instants) {
  const long double nanoseconds = kNanoseconds *
                                  static_cast<long double>(instants.samples.front()) /
                                  static_cast<long double>(controllers.front().rate);
  const long double whole = std::round(nanoseconds);
  instants.whole_nanoseconds =
      whole >= 1.0L && std::fabs(nanoseconds - whole) <= kRoundingOfPeriod * nanoseconds;
  if (instants.whole_nanoseconds) {
    instants.period = static_cast<std::int64_t>(whole);
    instants.tick = 1e-9;
    return;
  }
  std::int64_t common = 1;
  for (const int samples : instants.samples) {
    common = std::lcm(common, std::int64_t{samples});
    if (common > kMaxCommonMultiple) {
      noCommonPeriod(controllers);
    }
  }
  instants.period = kFinestPeriod / common * common;
  instants.tick =
      static_cast<double>(nanoseconds / kNanoseconds / static_cast<long double>(instants.period));
}

std::int64_t floorOf(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return a % b < 0 ? quotient - 1 : quotient;
}

}  // namespace

LoopInstants loopInstants(const std::vector<LoopController>& controllers) {
  LoopInstants instants;
  instants.samples = samplesInPeriod(controllers);
  chooseTick(controllers, instants);
  const std::int64_t period = instants.period;
  const auto ticks = [&](double seconds) { return std::llround(seconds / instants.tick); };
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    const LoopController& controller = controllers[i];
    const std::int64_t early = ticks(controller.sensor_delay);
    const std::int64_t late = ticks(controller.delay);
    std::int64_t on_the_way = 0;
    bool held = true;
    for (int k = 0; k < instants.samples[i]; ++k) {
      const std::int64_t sample =
          instants.whole_nanoseconds
              ? std::llround(k * kNanoseconds / static_cast<long double>(controller.rate))
              : period / instants.samples[i] * k;
      const std::int64_t reads = sample - early;
      const std::int64_t acts = sample + late;
      const std::int64_t periods_read = floorOf(reads, period);
      const std::int64_t periods_acted = floorOf(acts, period);
      // This sample and those whole periods before: read before 0, acting at 0 or later.
      on_the_way += periods_acted - periods_read;
      held = held && acts != periods_acted * period;
      instants.events.push_back({reads - periods_read * period, false, i});
      instants.events.push_back({acts - periods_acted * period, true, i});
    }
    instants.on_the_way.push_back(static_cast<int>(std::min<std::int64_t>(on_the_way, 1 << 30)));
    instants.held.push_back(held);
  }
  std::stable_sort(instants.events.begin(), instants.events.end(),
                   [](const LoopEvent& x, const LoopEvent& y) {
                     return std::tie(x.tick, x.acts) < std::tie(y.tick, y.acts);
                   });
  return instants;
}

}  // namespace whirl_twin
