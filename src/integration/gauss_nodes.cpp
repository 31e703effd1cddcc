#include "integration/gauss_nodes.h"

#include <cmath>
#include <utility>

namespace whirl_twin {

namespace {

constexpr long double kLongPi = 3.14159265358979323846264338327950288L;
/// Number of points in excess of the nodes: the kernel is smooth and the polynomial of degree count
/// - 1.
constexpr std::size_t kFurtherPoints = 4;

/// P_n and its derivative at x.
std::pair<long double, long double> legendreWithSlope(std::size_t n, long double x) {
  long double before = 1.0L;
  long double p = x;
  for (std::size_t k = 2; k <= n; ++k) {
    const auto degree = static_cast<long double>(k);
    const long double next = ((2.0L * degree - 1.0L) * x * p - (degree - 1.0L) * before) / degree;
    before = p;
    p = next;
  }
  return {p, static_cast<long double>(n) * (before - x * p) / (1.0L - x * x)};
}

}  // namespace

GaussNodes::GaussNodes(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    // Newton's method from Tricomi's estimate of the zeros of P_n.
    long double x = -std::cos(kLongPi * (static_cast<long double>(i) + 0.75L) /
                              (static_cast<long double>(count) + 0.5L));
    for (int round = 0; round < 8; ++round) {
      const auto [p, slope] = legendreWithSlope(count, x);
      x -= p / slope;
    }
    const long double slope = legendreWithSlope(count, x).second;
    nodes.push_back(static_cast<double>(0.5L * (1.0L + x)));
    weights.push_back(static_cast<double>(1.0L / ((1.0L - x * x) * slope * slope)));
  }
}

std::vector<double> GaussNodes::shares(double at) const {
  std::vector<double> all;
  for (std::size_t k = 0; k < count(); ++k) {
    long double share = 1.0L;
    for (std::size_t i = 0; i < count(); ++i) {
      if (i != k) {
        share *= (static_cast<long double>(at) - nodes[i]) /
                 (static_cast<long double>(nodes[k]) - nodes[i]);
      }
    }
    all.push_back(static_cast<double>(share));
  }
  return all;
}

GaussStretches::GaussStretches(std::size_t count) : nodes(count), points(count + kFurtherPoints) {
  for (const double node : nodes.nodes) {
    for (std::size_t q = 0; q < points.count(); ++q) {
      for (const double share : nodes.shares(node * points.nodes[q])) {
        shares.push_back(points.weights[q] * share);
      }
    }
  }
}

}  // namespace whirl_twin
