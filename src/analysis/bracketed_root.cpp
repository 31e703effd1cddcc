#include "analysis/bracketed_root.h"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace whirl_twin {

double bracketedRoot(const std::function<double(double)>& f, double low, double high, double f_low,
                     double f_high) {
  if (f_low == 0.0) {
    return low;
  }
  if (f_high == 0.0) {
    return high;
  }
  constexpr double kExact = 4.0 * std::numeric_limits<double>::epsilon();
  std::uintmax_t evaluations = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      std::cref(f), low, high, f_low, f_high,
      [](double a, double b) {
        return std::fabs(b - a) <= kExact * std::fmax(std::fabs(a), std::fabs(b));
      },
      evaluations);
  return 0.5 * (below + above);
}

}  // namespace whirl_twin
