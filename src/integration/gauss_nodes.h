// Gauss-Legendre nodes on 0..1, with quadratures from 0 to each of them.
#pragma once

#include <cstddef>
#include <vector>

namespace whirl_twin {

struct GaussNodes {
  explicit GaussNodes(std::size_t count);

  /// The values at the nodes as a polynomial, at a point in 0..1: what each contributes.
  std::vector<double> shares(double at) const;

  std::size_t count() const noexcept { return nodes.size(); }

  std::vector<double> nodes, weights;  ///< the weights add up to 1
};

/// Quadratures from 0 to each of some nodes, of a kernel times the polynomial through values at
/// them: the kernel is evaluated at the fractions `points` of each interval, and share(j, q, k) is
/// the weight of the value at node k for the point q of the interval to node j.
struct GaussStretches {
  explicit GaussStretches(std::size_t count);

  double share(std::size_t j, std::size_t q, std::size_t k) const noexcept {
    return shares[(j * points.count() + q) * nodes.count() + k];
  }

  GaussNodes nodes;
  GaussNodes points;
  std::vector<double> shares;  ///< times the points' weights
};

}  // namespace whirl_twin
