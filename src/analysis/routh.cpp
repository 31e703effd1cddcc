#include "analysis/routh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/polynomial_roots.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

/// A row of the table: the coefficients of every second power, highest first.
using IntegerRow = ScaledIntegers;

/// Every entry is a multiple of `divisor`.
IntegerRow integerRowBelow(const IntegerRow& upper, const IntegerRow& lower, const Integer& divisor,
                           ExactBudget& budget) {
  const Integer pivot = abs(lower.entry.front());
  const Integer across = lower.entry.front() > 0 ? upper.entry.front() : -upper.entry.front();
  IntegerRow row;
  for (std::size_t j = 1; j < upper.entry.size(); ++j) {
    row.entry.push_back(pivot * upper.entry[j]);
    if (j < lower.entry.size()) {
      row.entry.back() -= across * lower.entry[j];
    }
  }
  row.scale = upper.scale / scaledFloat(pivot);
  for (Integer& entry : row.entry) {
    budget.spendOn(entry);
    if (divisor > 1) {
      entry /= divisor;
    }
  }
  row.scale = row.scale * scaledFloat(divisor);
  return row;
}

/// The known common divisors of the rows of a table without divisions: their entries are minors of
/// Hurwitz's matrix, and from the fourth row below the first on each is a multiple of the first
/// entry three rows above it (fraction-free elimination: Bareiss, Math. Comp. 22 (1968); Jeltsch,
/// Numer. Math. 31 (1979)). Euclid's algorithm would cost a hundred times more.
class KnownDivisors {
 public:
  /// The first two rows of a table, or those where a special case restarted it.
  void restart(const IntegerRow& upper) { firsts_ = {abs(upper.entry.front())}; }
  /// Of the row below `lower`, which is the next one.
  Integer next(const IntegerRow& lower) {
    firsts_.push_back(abs(lower.entry.front()));
    const std::size_t last = firsts_.size() - 1;
    return last >= 3 ? firsts_[last - 2] : Integer(1);
  }

 private:
  std::vector<Integer> firsts_;
};

/// Special case A: the row begins with m zeros. Multiplies it by 1 + (-s^2)^m, which is positive on
/// the imaginary axis and gives the row its full degree.
void fillIntegerZeros(IntegerRow& row, std::size_t m) {
  for (std::size_t j = 0; j + m < row.entry.size(); ++j) {
    if (m % 2 == 0) {
      row.entry[j] += row.entry[j + m];
    } else {
      row.entry[j] -= row.entry[j + m];
    }
  }
}

/// Special case B: the derivative of the auxiliary polynomial, a row of the given degree.
IntegerRow derivativeRow(const IntegerRow& auxiliary, int degree, ExactBudget& budget) {
  IntegerRow row;
  row.scale = auxiliary.scale;
  for (int j = 0; 2 * j < degree; ++j) {
    row.entry.push_back(auxiliary.entry[j] * (degree - 2 * j));
  }
  removeCommonFactor(row, budget);
  return row;
}

/// The roots that a row of the given degree has on the imaginary axis: real roots of
/// A(jx)/j^degree.
RealRootCount rootsOnAxis(const IntegerRow& auxiliary, int degree, ExactBudget& budget) {
  ExactPolynomial on_axis;
  on_axis.entry.resize(degree + 1);
  for (int j = 0; 2 * j <= degree; ++j) {
    on_axis.entry[2 * j] = j % 2 == 0 ? auxiliary.entry[j] : -auxiliary.entry[j];
  }
  return countRealRoots(std::move(on_axis), budget);
}

/// The first two rows, with a positive leading coefficient.
std::pair<IntegerRow, IntegerRow> firstRows(const std::vector<Rational>& coefficients,
                                            ExactBudget& budget) {
  const ScaledIntegers all = scaledIntegers(coefficients);
  std::pair<IntegerRow, IntegerRow> rows;
  rows.first.scale = rows.second.scale = all.scale;
  for (std::size_t i = 0; i < all.entry.size(); ++i) {
    IntegerRow& row = i % 2 == 0 ? rows.first : rows.second;
    row.entry.push_back(all.entry.front() > 0 ? all.entry[i] : -all.entry[i]);
  }
  removeCommonFactor(rows.first, budget);
  removeCommonFactor(rows.second, budget);
  return rows;
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAsymptoticallyStable:
      return "asymptotically_stable";
    case Verdict::kMarginal:
      return "marginal";
    case Verdict::kRepeatedImaginary:
      return "repeated_imaginary";
    case Verdict::kUnstable:
      return "unstable";
    case Verdict::kUncertain:
      break;
  }
  return "uncertain";
}

Verdict verdictOf(const RouthResult& result) {
  if (result.right > 0) {
    return Verdict::kUnstable;
  }
  if (result.imaginary == 0) {
    return Verdict::kAsymptoticallyStable;
  }
  return result.largest_imaginary_multiplicity > 1 ? Verdict::kRepeatedImaginary
                                                   : Verdict::kMarginal;
}

RouthResult routh(const std::vector<Rational>& coefficients, ExactBudget& budget) {
  const auto [reduced, zeros] =
      withoutZeroRoots(coefficients, [](const Rational& a) { return a == 0; });
  const int degree = static_cast<int>(reduced.size()) - 1;
  auto [upper, lower] = firstRows(reduced, budget);
  KnownDivisors divisors;
  divisors.restart(upper);
  RouthResult result;
  RealRootCount on_axis;
  result.first_column.push_back(toDouble(scaledFloat(upper.entry.front()) * upper.scale));
  int sign = 1;
  for (int power = degree - 1; power >= 0; --power) {
    const std::size_t leading_zeros =
        std::find_if(lower.entry.begin(), lower.entry.end(),
                     [](const Integer& entry) { return entry != 0; }) -
        lower.entry.begin();
    if (leading_zeros == lower.entry.size()) {
      // The first auxiliary polynomial holds every root on the axis; later ones only repetitions.
      if (on_axis.total == 0) {
        on_axis = rootsOnAxis(upper, power + 1, budget);
      }
      lower = derivativeRow(upper, power + 1, budget);
      divisors.restart(upper);
    } else if (leading_zeros > 0) {
      fillIntegerZeros(lower, leading_zeros);
      divisors.restart(upper);
    }
    const Integer& first = lower.entry.front();
    result.first_column.push_back(toDouble(scaledFloat(first) * lower.scale));
    if (first.sign() != sign) {
      ++result.right;
      sign = -sign;
    }
    IntegerRow next = integerRowBelow(upper, lower, divisors.next(lower), budget);
    upper = std::move(lower);
    lower = std::move(next);
  }
  result.imaginary = on_axis.total + zeros;
  result.left = degree - result.right - on_axis.total;
  result.largest_imaginary_multiplicity = std::max(on_axis.largest_multiplicity, zeros);
  result.verdict = verdictOf(result);
  return result;
}

RouthResult routh(const std::vector<Rational>& coefficients) {
  ExactBudget unlimited(std::numeric_limits<double>::infinity());
  return routh(coefficients, unlimited);
}

RouthResult routh(const std::vector<double>& coefficients) {
  std::vector<Rational> exact;
  exact.reserve(coefficients.size());
  for (const double coefficient : coefficients) {
    if (!std::isfinite(coefficient)) {
      throw InputError(
          fmt::format("polynomial: coefficient {} of {} must be a finite number, found {}",
                      exact.size() + 1, coefficients.size(), coefficient));
    }
    exact.emplace_back(coefficient);
  }
  return routh(exact);
}

}  // namespace whirl_twin
