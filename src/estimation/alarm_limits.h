// Limits of statistics from the rate of false alarms that one accepts. Real-time safe.
#pragma once

#include <cstddef>

namespace whirl_twin {

/// [1/h] -> the probability for one of the decisions that are made each after `period` [s].
inline double falseAlarmsEach(double per_hour, double period) {
  return per_hour * period / 3600.0;
}

/// z, above which a number of a standard normal distribution is with this probability, > 0 and
/// <= 0.5.
double normalLimit(double probability);

/// A limit of the mean of the squares of `count` independent standard normal numbers, which is
/// chi-squared: of the upper end for z, of the lower for -z, with z the normal limit of the same
/// probability. By Wilson & Hilferty's cube root (Proc. Nat. Acad. Sci. 17, 1931); from 50 numbers
/// on, and down to 1e-8, it is passed at most as often as asked: 0.59 times as often at 50, 0.998
/// times at 8000.
double meanSquareLimit(std::size_t count, double z);

/// The limit h of a one-sided cumulative sum S := max(0, S + w - allowance) of independent standard
/// normal numbers w which it passes once in `run_length` of them on average: Siegmund's
/// approximation (D. Siegmund, Sequential Analysis, Springer 1985, ch. 2; also D. C. Montgomery,
/// Statistical Quality Control, on the design of cusums),
///
///   run_length = (e^y - 1 - y) / (2 allowance^2),   y = 2 allowance (h + 1.166).
///
/// At least 0: a large allowance alone is passed less often. allowance > 0.
double cumulativeSumLimit(double allowance, double run_length);

}  // namespace whirl_twin
