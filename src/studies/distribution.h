// How one number varies over the points of a study, by its quantiles: value(u) is the number below
// which a part u of the distribution lies, so that a design of points in the unit cube is one of
// values. A list has its entries, all alike likely, in the order given.
#pragma once

#include <cstddef>
#include <vector>

namespace whirl_twin {

struct Distribution {
  enum class Kind { kUniform, kLogUniform, kNormal, kList };
  Kind kind = Kind::kUniform;
  double low = 0.0;               ///< uniform, log-uniform
  double high = 0.0;              ///< likewise; log-uniform: 0 < low < high
  double mean = 0.0;              ///< normal
  double deviation = 0.0;         ///< normal, > 0
  std::vector<double> list = {};  ///< not empty

  /// u: 0 < u < 1; for all but a normal distribution also 0 and 1.
  double value(double u) const;
  /// Value k of n that stand for it on a grid: those of a list; evenly from end to end of an
  /// interval (of its logarithms), the middle for n = 1; the quantiles (k + 1/2) / n of a normal
  /// distribution. n > 0, k < n.
  double level(std::size_t k, std::size_t n) const;
  /// How many levels there are where n are asked for: a list has its own number.
  std::size_t levels(std::size_t n) const;
  /// The smallest and largest number that can come, infinite for a normal distribution.
  double smallest() const;
  double largest() const;
};

}  // namespace whirl_twin
