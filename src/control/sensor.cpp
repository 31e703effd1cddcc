#include "control/sensor.h"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

SampleInstants::SampleInstants(double rate) : rate_(rate), period_(std::llround(1.0e9 / rate)) {
  if (static_cast<double>(period_) * rate != 1.0e9) {
    period_ = 0;
  }
}

std::int64_t SampleInstants::at(std::int64_t k) const noexcept {
  // A long double has the digits of an int64.
  return period_ > 0 ? k * period_ : std::llroundl(static_cast<long double>(k) * 1.0e9L / rate_);
}

std::int64_t SampleInstants::firstFrom(std::int64_t time) const noexcept {
  auto k =
      static_cast<std::int64_t>(std::floor(static_cast<long double>(time) * 1.0e-9L * rate_)) - 1;
  while (at(k) < time) {
    ++k;
  }
  return k;
}

namespace {

constexpr double kPerWord = 1.0 / 4294967296.0;  // 2^-32

/// The midpoint of the interval that a word represents: never 0, never 1.
double uniform(std::uint32_t word) noexcept {
  return (static_cast<double>(word) + 0.5) * kPerWord;
}

r123::Philox4x32::ctr_type wordsOf(std::uint32_t seed, std::uint32_t channel,
                                   std::int64_t k) noexcept {
  const auto count = static_cast<std::uint64_t>(k);
  const r123::Philox4x32::ctr_type counter{
      {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(count >> 32U), 0U, 0U}};
  const r123::Philox4x32::key_type key{{seed, channel}};
  return r123::Philox4x32{}(counter, key);
}

}  // namespace

double CounterNoise::even(std::int64_t k) const noexcept {
  return 2.0 * uniform(wordsOf(seed_, channel_, k)[2]) - 1.0;
}

double CounterNoise::normal(std::int64_t k) const noexcept {
  const r123::Philox4x32::ctr_type words = wordsOf(seed_, channel_, k);
  return std::sqrt(-2.0 * std::log(uniform(words[0]))) * std::cos(kTwoPi * uniform(words[1]));
}

namespace {

/// Below this, the closed form of the filtered cubic loses digits, and quadrature has them all.
constexpr double kSlowFilter = 0.5;

struct Node {
  double at, weight;
};
constexpr std::array<Node, 5> kGauss{{{0.046910077030668004, 0.118463442528094544},
                                      {0.230765344947158454, 0.239314335249683234},
                                      {0.5, 0.284444444444444444},
                                      {0.769234655052841546, 0.239314335249683234},
                                      {0.953089922969331996, 0.118463442528094544}}};

/// s = c[0] + c[1] t + c[2] t^2 + c[3] t^3
std::array<double, 4> coefficients(const CubicPiece& p) noexcept {
  const double h = p.length;
  const double rise = p.to - p.from;
  return {p.from, p.from_rate, (3.0 * rise / h - 2.0 * p.from_rate - p.to_rate) / h,
          (p.from_rate + p.to_rate - 2.0 * rise / h) / (h * h)};
}

double cubic(const std::array<double, 4>& c, double t) noexcept {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/// s - s'/w + s''/w^2 - s'''/w^3 at t.
double steadyResponse(const std::array<double, 4>& c, double w, double t) noexcept {
  const double first = c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]);
  const double second = 2.0 * c[2] + 6.0 * c[3] * t;
  return cubic(c, t) - (first - (second - 6.0 * c[3] / w) / w) / w;
}

}  // namespace

double CubicPiece::at(double t) const noexcept {
  return t >= length ? to : cubic(coefficients(*this), t);
}

Sensor::Sensor(const SensorSettings& settings, std::uint32_t seed, std::uint32_t channel)
    : settings_(settings), noise_(seed, channel), pole_(kTwoPi * settings.bandwidth) {}

double Sensor::filtered(const CubicPiece& piece, double t) const noexcept {
  if (pole_ == 0.0) {
    return piece.at(t);
  }
  if (!(t > 0.0)) {
    return filtered_;
  }
  const std::array<double, 4> c = coefficients(piece);
  const double left = std::exp(-pole_ * t);
  if (pole_ * t > kSlowFilter) {
    return steadyResponse(c, pole_, t) + left * (filtered_ - steadyResponse(c, pole_, 0.0));
  }
  double sum = left * filtered_;
  for (const Node& node : kGauss) {
    sum += node.weight * pole_ * t * std::exp(-pole_ * t * (1.0 - node.at)) * cubic(c, node.at * t);
  }
  return sum;
}

Sample Sensor::sample(double filtered, std::int64_t k) const noexcept {
  double value = filtered;
  if (settings_.noise > 0.0) {
    value += settings_.noise * noise_.normal(k);
  }
  bool valid = std::isfinite(value);
  if (settings_.range > 0.0 && !(std::fabs(value) <= settings_.range)) {
    valid = false;
    value = std::clamp(value, -settings_.range, settings_.range);
  }
  if (settings_.resolution > 0.0) {
    value = settings_.resolution * std::nearbyint(value / settings_.resolution);
  }
  return {value, valid};
}

}  // namespace whirl_twin
