#include "display/instrument_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "display/scales.h"
#include "monitoring/stability_alarm.h"

namespace whirl_twin {
namespace {

constexpr double kLive = 3.0;  // s, maximum age of a live verdict
constexpr double kMinDecrement = -0.2,
                 kMaxDecrement = 0.6;  // log decrements at the ends of the scale
constexpr std::size_t kRanges = 4;     // maximum number of ranges of either kind that are drawn

constexpr Color kGrey{0.55F, 0.58F, 0.62F};
constexpr Color kRed{0.80F, 0.20F, 0.17F};
constexpr Color kOrange{0.90F, 0.60F, 0.10F};
constexpr Color kGreen{0.22F, 0.55F, 0.42F};

/// The next of 1, 1.2, 1.5, 2, 3, 4, 5, 6, 8, 10 times a power of ten.
double roundUp(double number) {
  const double decade = std::pow(10.0, std::floor(std::log10(number)));
  for (const double digit : {1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (digit * decade >= number * (1.0 - 1.0e-12)) {
      return digit * decade;
    }
  }
  return 10.0 * decade;
}

double decrementPlace(double log_decrement) {
  return std::clamp((log_decrement - kMinDecrement) / (kMaxDecrement - kMinDecrement), 0.0, 1.0);
}

bool stable(const StabilityMargin& margin) {
  return margin.verdict != StabilityMargin::UNSTABLE &&
         margin.verdict != StabilityMargin::REPEATED_IMAGINARY;
}

/// Unstable speed ranges, bounded by the nearest thresholds: between them if the system is unstable
/// now, beyond them if it is stable.
std::vector<SpeedRange> unstableRanges(const StabilityMargin& margin, double end) {
  const double below = margin.threshold_below;
  const double above = margin.threshold_above;
  if (!stable(margin)) {
    return {{std::isfinite(below) ? std::fabs(below) : 0.0,
             std::isfinite(above) ? std::fabs(above) : end}};
  }
  std::vector<SpeedRange> ranges;
  if (std::isfinite(below)) {
    ranges.emplace_back(0.0, std::fabs(below));
  }
  if (std::isfinite(above)) {
    ranges.emplace_back(std::fabs(above), end);
  }
  return ranges;
}

void drawSpeed(double speed, const LiveMargin& live, double middle, double height,
               MarkerCanvas& board) {
  ScaleBar bar("speed", middle, height, board);
  const SpeedScale scale = speedScale(speed, live.margin.get());
  const bool shaft = std::isfinite(speed);
  bar.range("track", 0.0, shaft ? 1.0 : 0.0, live.margin ? kGreen : kTrackColor, 0);
  for (std::size_t i = 0; i < kRanges; ++i) {
    const auto range = [&](const std::vector<SpeedRange>& ranges) {
      return shaft && i < ranges.size() ? ranges[i] : SpeedRange{0.0, 0.0};
    };
    const auto [from, to] = range(scale.avoid);
    bar.range("avoid", from / scale.end, to / scale.end, kOrange, 1);
    const auto [begin, end] = range(scale.unstable);
    bar.range("unstable", begin / scale.end, end / scale.end, kRed, 2);
  }
  if (shaft) {
    bar.pointer(std::fabs(speed) / scale.end);
  } else {
    bar.noPointer();
  }
}

void drawMargin(const LiveMargin& live, double middle, double height, MarkerCanvas& board) {
  ScaleBar bar("margin", middle, height, board);
  const std::optional<MarginScale> scale = marginScale(live);
  const double required = scale ? scale->required : 0.0;
  bar.range("track", 0.0, scale || !live.margin ? 1.0 : 0.0, kTrackColor, 0);
  bar.range("unstable", 0.0, scale ? MarginScale::kEdge : 0.0, kRed, 1);
  bar.range("low", MarginScale::kEdge, required, kOrange, 1);
  bar.range("enough", required, scale && required > MarginScale::kEdge ? 1.0 : 0.0, kGreen, 1);
  if (scale) {
    bar.pointer(scale->place);
  } else {
    bar.noPointer();
  }
}

}  // namespace

LiveMargin liveMargin(const StabilityMargin::ConstPtr& margin, double since_heard, bool held,
                      const std::string& silence) {
  LiveMargin live;
  if (!silence.empty()) {
    live.why_not = "no message from the monitor";
    return live;
  }
  if (!margin) {
    return live;
  }
  const double age = since_heard + (std::isfinite(margin->age) ? margin->age : 0.0);
  if (!held && age > kLive) {
    live.why_not = fmt::format("the last verdict is {:.0f} s old", age);
    return live;
  }
  live.margin = margin;
  if (!held) {
    live.age = age;
  }
  return live;
}

SpeedScale speedScale(double speed, const StabilityMargin* margin) {
  constexpr double kRoom = 1.15;
  const double now = std::isfinite(speed) ? std::fabs(speed) : 0.0;
  double reach = kRoom * now;
  if (margin != nullptr) {
    const auto next = std::find_if(margin->band_high.begin(), margin->band_high.end(),
                                   [&](double high) { return high > now; });
    if (next != margin->band_high.end()) {
      reach = std::max(reach, kRoom * *next);
    } else if (!margin->band_high.empty()) {
      reach = std::max(reach, kRoom * margin->band_high.back());
    }
    if (std::isfinite(margin->threshold_above)) {
      reach = std::max(reach, kRoom * std::fabs(margin->threshold_above));
    }
  }
  SpeedScale scale;
  scale.end = reach > 0.0 ? roundUp(reach) : 1.0;
  if (margin == nullptr) {
    return scale;
  }
  const std::size_t bands = std::min(margin->band_low.size(), margin->band_high.size());
  for (std::size_t i = 0; i < bands; ++i) {
    if (margin->band_low[i] < scale.end) {
      scale.avoid.emplace_back(margin->band_low[i], std::min(margin->band_high[i], scale.end));
    }
  }
  if (scale.avoid.size() > kRanges) {  // those about the speed
    const auto above = std::find_if(scale.avoid.begin(), scale.avoid.end(),
                                    [&](const SpeedRange& band) { return band.second > now; });
    const auto last = std::min<std::ptrdiff_t>(above - scale.avoid.begin() + 2,
                                               static_cast<std::ptrdiff_t>(scale.avoid.size()));
    const auto first = std::max<std::ptrdiff_t>(0, last - static_cast<std::ptrdiff_t>(kRanges));
    scale.avoid = {scale.avoid.begin() + first,
                   scale.avoid.begin() +
                       std::min<std::ptrdiff_t>(first + static_cast<std::ptrdiff_t>(kRanges),
                                                static_cast<std::ptrdiff_t>(scale.avoid.size()))};
  }
  scale.unstable = unstableRanges(*margin, scale.end);
  return scale;
}

std::string scaleText(const SpeedScale& scale) {
  std::vector<std::string> parts;
  for (const auto& [from, to] : scale.avoid) {
    parts.push_back(fmt::format("{}{:.1f} to {:.1f}", parts.empty() ? "avoid " : "", from, to));
  }
  for (const auto& [from, to] : scale.unstable) {
    parts.push_back(from == 0.0 && to == scale.end ? "unstable"
                    : from == 0.0                  ? fmt::format("unstable below {:.1f}", to)
                    : to == scale.end              ? fmt::format("unstable above {:.1f}", from)
                                      : fmt::format("unstable {:.1f} to {:.1f}", from, to));
  }
  return fmt::format("0 to {:g} rad/s{}{}", scale.end, parts.empty() ? "" : ": ",
                     fmt::join(parts, ", "));
}

std::optional<MarginScale> marginScale(const LiveMargin& live) {
  if (!live.margin) {
    return std::nullopt;
  }
  const StabilityMargin& margin = *live.margin;
  const double rate = dampingDecayRate(margin);
  const double decrement = dampingLogDecrement(margin);
  if (!stable(margin)) {
    return MarginScale{std::isfinite(decrement) ? decrementPlace(decrement) : 0.0,
                       MarginScale::kEdge, "unstable"};
  }
  const auto nearness = [](double value, double level) {  // infinite: not required, or unknown
    return level > 0.0 && std::isfinite(value) ? value / level : kInfinity;
  };
  const double by_decrement = nearness(decrement, live.least_decrement);
  const double by_rate = nearness(rate, live.least_decay_rate);
  if (!requiresDamping(margin) || !std::isfinite(rate) ||
      !(live.least_decrement > 0.0 || live.least_decay_rate > 0.0)) {
    return std::nullopt;
  }
  if (std::isfinite(by_rate) && by_rate < by_decrement) {
    // Its level is half-way between the edge and the end.
    constexpr double kLevel = 0.5 * (MarginScale::kEdge + 1.0);
    return MarginScale{
        std::clamp(MarginScale::kEdge + by_rate * (kLevel - MarginScale::kEdge), 0.0, 1.0), kLevel,
        fmt::format("decay rate {:.3g} 1/s ({:g} required)", rate, live.least_decay_rate)};
  }
  if (!std::isfinite(by_decrement)) {  // overdamped, or standing
    if (!(rate > 0.0)) {
      return std::nullopt;
    }
    return MarginScale{1.0, decrementPlace(live.least_decrement), "overdamped"};
  }
  return MarginScale{
      decrementPlace(decrement), decrementPlace(live.least_decrement),
      fmt::format("log decrement {:.3g} ({:g} required)", decrement, live.least_decrement)};
}

std::string marginText(const LiveMargin& live) {
  if (!live.margin) {
    return live.why_not.empty() ? "not evaluated yet" : live.why_not;
  }
  const std::optional<MarginScale> scale = marginScale(live);
  if (!scale) {
    return "";
  }
  return std::isfinite(live.age) ? scale->text + fmt::format(", {:.1f} s old", live.age)
                                 : scale->text;
}

double drawInstruments(const LiveMargin& live, double speed, bool compact, MarkerCanvas& board) {
  const bool shaft = std::isfinite(speed);
  const double bar = compact ? 0.10 : 0.05;    // m
  const double words = compact ? 0.0 : 0.066;  // m, of a line of them
  const double room = compact ? 0.06 : 0.05;   // m, between
  double y = 0.5 * bar + 0.5 * room;
  const auto caption = [&](const std::string& part, const std::string& text, const Color& color) {
    y += 0.5 * bar + 0.95 * words;
    board.text(part, {0.0, y, 0.03}, words, compact ? "" : text, color);
    y += 0.4 * words + room;
  };
  drawMargin(live, y, bar, board);
  const std::string margin = marginText(live);
  caption("margin_caption", margin.empty() ? "" : "margin: " + margin,
          live.margin ? kWordsColor : kGrey);
  y += 0.5 * bar;
  drawSpeed(speed, live, y, bar, board);
  if (!shaft) {
    board.gone("speed_caption");
    return y - 0.5 * bar;
  }
  caption("speed_caption", scaleText(speedScale(speed, live.margin.get())), kWordsColor);
  return y;
}

}  // namespace whirl_twin
