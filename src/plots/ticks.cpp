#include "plots/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl_twin {
namespace {

/// Fraction of a step by which a tick may miss the end of a range: rounding.
constexpr double kSlack = 1.0e-9;
constexpr double kSmallestSpread = 1.0e-6;  // relative to the values; labels have seven digits
constexpr double kRoom = 0.1;               // relative to a constant value, to either side

/// factor x 10^exponent, rounded as the number is written.
double decimal(double factor, int exponent) {
  return exponent < 0 ? factor / std::pow(10.0, -exponent) : factor * std::pow(10.0, exponent);
}

std::string withMinus(std::string text) {
  return text[0] == '-' ? "\u2212" + text.substr(1) : text;
}

}  // namespace

AxisRange widened(AxisRange range) {
  const double largest = std::max(std::fabs(range.low), std::fabs(range.high));
  if (largest == 0.0) {
    return {-1.0, 1.0};
  }
  if (range.high - range.low >= std::max(kSmallestSpread * largest, 1.0 / kMaxOnAxis)) {
    return range;
  }
  const double room = std::max(kRoom * largest, 1.0 / kMaxOnAxis);
  return {std::max(range.low - room, -kMaxOnAxis), std::min(range.high + room, kMaxOnAxis)};
}

std::vector<double> linearTicks(const AxisRange& range, int most) {
  const double closest = (range.high - range.low) / (most - 1);
  int exponent = static_cast<int>(std::floor(std::log10(closest)));
  for (;; ++exponent) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = decimal(factor, exponent);
      const double first = std::floor(range.low / step + kSlack);
      const double last = std::ceil(range.high / step - kSlack);
      if (last - first + 1.0 <= most) {
        std::vector<double> ticks;
        for (double i = first; i <= last; i += 1.0) {
          ticks.push_back(decimal(i * factor, exponent));
        }
        return ticks;
      }
    }
  }
}

std::vector<double> degreeTicks(const AxisRange& range, int most) {
  for (const double step : {15.0, 30.0, 45.0, 90.0, 180.0}) {
    const double first = std::floor(range.low / step + kSlack);
    const double last = std::ceil(range.high / step - kSlack);
    if (last - first + 1.0 <= most) {
      if (last - first < 2.0) {  // too narrow for fractions of a turn
        break;
      }
      std::vector<double> ticks;
      for (double i = first; i <= last; i += 1.0) {
        ticks.push_back(i * step);
      }
      return ticks;
    }
  }
  return linearTicks(range, most);
}

std::vector<double> logarithmicTicks(const AxisRange& range, int most) {
  const int first = static_cast<int>(std::floor(std::log10(range.low) + kSlack));
  const int last =
      std::max(first + 1, static_cast<int>(std::ceil(std::log10(range.high) - kSlack)));
  const int decades = last - first;
  const int stride = (decades + most - 2) / (most - 1);
  std::vector<double> ticks;
  for (int decade = first; decade < last; decade += stride) {
    ticks.push_back(decimal(1.0, decade));
    if (3 * decades + 1 <= most) {
      ticks.push_back(decimal(2.0, decade));
      ticks.push_back(decimal(5.0, decade));
    }
  }
  const int rounds = (decades + stride - 1) / stride;
  ticks.push_back(decimal(1.0, first + rounds * stride));
  return ticks;
}

TickLabels linearLabels(const std::vector<double>& ticks) {
  const double largest = std::max(std::fabs(ticks.front()), std::fabs(ticks.back()));
  const bool plain = largest < 1.0e5 && largest >= 0.5e-1;
  return linearLabels(
      ticks, plain ? 0 : 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0 + kSlack)));
}

TickLabels linearLabels(const std::vector<double>& ticks, int exponent) {
  TickLabels labels;
  labels.exponent = exponent;
  const double step = decimal(ticks[1] - ticks[0], -labels.exponent);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1.0e-6)));
  for (const double tick : ticks) {
    labels.text.push_back(
        withMinus(fmt::format("{:.{}f}", decimal(tick, -labels.exponent), decimals)));
  }
  return labels;
}

TickLabels logarithmicLabels(const std::vector<double>& ticks) {
  TickLabels labels;
  const bool plain = ticks.front() >= 0.9e-3 && ticks.back() <= 1.1e4;
  for (const double tick : ticks) {
    const int exponent = static_cast<int>(std::floor(std::log10(tick) + kSlack));
    const double factor = std::round(decimal(tick, -exponent));
    labels.text.push_back(plain ? fmt::format("{:g}", tick)
                          : factor == 1.0
                              ? powerOfTen(exponent)
                              : fmt::format("{:g}\u00b7{}", factor, powerOfTen(exponent)));
  }
  return labels;
}

std::string powerOfTen(int exponent) {
  static const std::array<const char*, 10> kDigits{"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                                   "\u2074", "\u2075", "\u2076", "\u2077",
                                                   "\u2078", "\u2079"};
  std::string text = "10";
  for (const char c : std::to_string(exponent)) {
    text += c == '-' ? "\u207b" : kDigits[static_cast<std::size_t>(c - '0')];
  }
  return text;
}

}  // namespace whirl_twin
