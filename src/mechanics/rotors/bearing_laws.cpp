#include "mechanics/rotors/bearing_laws.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace whirl_twin {

namespace {

using Eight = std::array<double, 8>;

Eight eight(const BearingCoefficients& b) {
  return {b.kxx, b.kxy, b.kyx, b.kyy, b.cxx, b.cxy, b.cyx, b.cyy};
}

struct Knot {
  double speed;
  Eight value, slope;
};

/// Slope at a knot between two chords: their weighted harmonic mean, 0 at an extremum.
double slopeBetween(double step0, double chord0, double step1, double chord1) {
  if (chord0 * chord1 <= 0.0) {
    return 0.0;
  }
  const double w0 = 2.0 * step1 + step0;
  const double w1 = step1 + 2.0 * step0;
  return (w0 + w1) / (w0 / chord0 + w1 / chord1);
}

std::vector<Knot> knotsOf(const std::vector<BearingRow>& rows) {
  std::vector<Knot> knots;
  for (const BearingRow& row : rows) {
    if (!knots.empty() && !(row.speed > knots.back().speed)) {
      throw std::logic_error("bearing table: the speeds must increase");
    }
    knots.push_back({row.speed, eight(row.coefficients), {}});
  }
  const std::size_t n = knots.size();
  const auto step = [&](std::size_t i) { return knots[i + 1].speed - knots[i].speed; };
  for (std::size_t c = 0; c < 8 && n > 1; ++c) {
    const auto chord = [&](std::size_t i) {
      return (knots[i + 1].value[c] - knots[i].value[c]) / step(i);
    };
    knots.front().slope[c] = chord(0);
    knots.back().slope[c] = chord(n - 2);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      knots[i].slope[c] = slopeBetween(step(i - 1), chord(i - 1), step(i), chord(i));
    }
  }
  return knots;
}

BearingCoefficients interpolated(const std::vector<Knot>& knots, double speed) {
  const auto above = std::upper_bound(knots.begin(), knots.end(), speed,
                                      [](double w, const Knot& k) { return w < k.speed; });
  Eight r{};
  if (above == knots.begin() || above == knots.end()) {
    r = above == knots.begin() ? knots.front().value : knots.back().value;
  } else {
    const Knot& a = *(above - 1);
    const Knot& b = *above;
    const double step = b.speed - a.speed;
    const double s = (speed - a.speed) / step;
    const double rise = s * s * (3.0 - 2.0 * s);
    for (std::size_t c = 0; c < 8; ++c) {
      r[c] = a.value[c] + rise * (b.value[c] - a.value[c]) +
             step * s * (1.0 - s) * ((1.0 - s) * a.slope[c] - s * b.slope[c]);
    }
  }
  return {r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7]};
}

}  // namespace

SpeedBearing tabulatedBearing(int node, const std::vector<BearingRow>& rows) {
  if (rows.empty()) {
    throw std::logic_error("bearing table: it has no row");
  }
  SpeedBearing bearing;
  bearing.node = node;
  for (const BearingRow& row : rows) {
    bearing.knots.push_back(row.speed);
  }
  bearing.coefficients = [knots = knotsOf(rows)](double speed) {
    return interpolated(knots, speed);
  };
  if (rows.size() > 1) {
    bearing.data = {rows.front().speed, rows.back().speed};
  }
  return bearing;
}

SpeedBearing journalBearing(int node, const ShortJournalBearing& bearing, double load) {
  const double slowest = bearing.speedAt(load, ShortJournalBearing::kMaxEccentricity);
  return {node,
          [bearing, load](double speed) { return bearing.coefficients(load, speed); },
          {-slowest, slowest},
          {slowest, std::numeric_limits<double>::infinity()}};
}

}  // namespace whirl_twin
