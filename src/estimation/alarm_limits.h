// Limits of test statistics for an accepted rate of false alarms. Real-time safe.
#pragma once

#include <cstddef>

namespace whirl_twin {

/// False-alarm rate [1/h] -> probability of a false alarm per decision, one decision each `period`
/// [s].
inline double falseAlarmsEach(double per_hour, double period) {
  return per_hour * period / 3600.0;
}

/// Quantile z of the standard normal distribution for an upper tail probability > 0 and <= 0.5.
double normalLimit(double probability);

/// Limit of the mean of the squares of `count` independent standard normal numbers (chi-squared):
/// the upper limit for z, the lower one for -z, with z the normal limit of the same probability.
/// Wilson & Hilferty's cube-root approximation (Proc. Nat. Acad. Sci. 17, 1931); from 50 numbers on
/// and down to a probability of 1e-8 it is exceeded at most as often as specified: 0.59 times as
/// often at 50, 0.998 times at 8000.
double meanSquareLimit(std::size_t count, double z);

/// Limit h of a one-sided cumulative sum S := max(0, S + w - allowance) of independent standard
/// normal numbers w for an average run length of `run_length` numbers: Siegmund's approximation (D.
/// Siegmund, Sequential Analysis, Springer 1985, ch. 2; also D. C. Montgomery, Statistical Quality
/// Control, on the design of cusums),
///
///   run_length = (e^y - 1 - y) / (2 allowance^2),   y = 2 allowance (h + 1.166).
///
/// At least 0: a large allowance alone gives a longer run length. allowance > 0.
double cumulativeSumLimit(double allowance, double run_length);

}  // namespace whirl_twin
