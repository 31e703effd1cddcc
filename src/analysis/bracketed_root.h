// A root between two places where a function has opposite signs: algorithm 748 (G. Alefeld, F.
// Potra, Y. Shi, ACM Trans. Math. Software 21, 1995), about ten evaluations where bisection takes
// fifty.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace whirl_twin {

/// f(low) and f(high), given, differ in sign. Exact to a few units in the last place of the root.
template <class Function>
double bracketedRoot(const Function& f, double low, double high, double f_low, double f_high) {
  if (f_low == 0.0) {
    return low;
  }
  if (f_high == 0.0) {
    return high;
  }
  constexpr double kExact = 4.0 * std::numeric_limits<double>::epsilon();
  std::uintmax_t evaluations = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      f, low, high, f_low, f_high,
      [](double a, double b) {
        return std::fabs(b - a) <= kExact * std::fmax(std::fabs(a), std::fabs(b));
      },
      evaluations);
  return 0.5 * (below + above);
}

}  // namespace whirl_twin
