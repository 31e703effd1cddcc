#include "analysis/real_root_count.h"

#include <algorithm>
#include <utility>

namespace whirl_twin {

namespace {

/// Moves the greatest common divisor of the entries into the scale.
void divideByCommonFactor(ScaledIntegers& values) {
  Integer factor = 0;
  for (const Integer& entry : values.entry) {
    factor = gcd(factor, entry);
  }
  if (factor > 1) {
    for (Integer& entry : values.entry) {
      entry /= factor;
    }
    values.scale = values.scale * scaledFloat(factor);
  }
}

ExactPolynomial negatedRemainder(ExactPolynomial dividend, const ExactPolynomial& divisor,
                                 ExactBudget& budget) {
  const Integer pivot = abs(divisor.entry.front());
  while (dividend.entry.size() >= divisor.entry.size()) {
    // |pivot| times the dividend, less the multiple of the divisor that cancels its first entry.
    const Integer across =
        divisor.entry.front() > 0 ? dividend.entry.front() : -dividend.entry.front();
    for (std::size_t i = 1; i < dividend.entry.size(); ++i) {
      dividend.entry[i] *= pivot;
      if (i < divisor.entry.size()) {
        dividend.entry[i] -= across * divisor.entry[i];
      }
    }
    dividend.scale = dividend.scale / scaledFloat(pivot);
    dividend.entry.front() = 0;
    dividend = trimmed(std::move(dividend));
    removeCommonFactor(dividend, budget);
  }
  for (Integer& coefficient : dividend.entry) {
    coefficient = -coefficient;
  }
  return dividend;
}

/// Sign changes of the sequence at plus (direction 1) or minus (direction -1) infinity.
int signChanges(const std::vector<ExactPolynomial>& sequence, int direction) {
  int changes = 0;
  int previous = 0;
  for (const ExactPolynomial& member : sequence) {
    const bool odd_degree = member.entry.size() % 2 == 0;
    const int sign = member.entry.front().sign() * (odd_degree ? direction : 1);
    changes += sign * previous < 0 ? 1 : 0;
    previous = sign;
  }
  return changes;
}

}  // namespace

ScaledIntegers scaledIntegers(const std::vector<Rational>& values) {
  Integer common_denominator = 1;
  for (const Rational& value : values) {
    common_denominator *= denominator(value) / gcd(common_denominator, denominator(value));
  }
  ScaledIntegers result;
  for (const Rational& value : values) {
    result.entry.push_back(numerator(value) * (common_denominator / denominator(value)));
  }
  result.scale = scaledFloat(1) / scaledFloat(common_denominator);
  divideByCommonFactor(result);
  return result;
}

void removeCommonFactor(ScaledIntegers& values, ExactBudget& budget) {
  for (const Integer& entry : values.entry) {
    budget.spendOn(entry);
  }
  divideByCommonFactor(values);
}

ExactPolynomial derivative(const ExactPolynomial& polynomial) {
  ExactPolynomial result;
  result.scale = polynomial.scale;
  for (std::size_t i = 0; i + 1 < polynomial.entry.size(); ++i) {
    result.entry.push_back(polynomial.entry[i] * (polynomial.entry.size() - 1 - i));
  }
  return result;
}

ExactPolynomial trimmed(ExactPolynomial polynomial) {
  polynomial.entry.erase(polynomial.entry.begin(),
                         std::find_if(polynomial.entry.begin(), polynomial.entry.end(),
                                      [](const Integer& entry) { return entry != 0; }));
  return polynomial;
}

std::vector<ExactPolynomial> sturmSequence(ExactPolynomial a, ExactPolynomial b,
                                           ExactBudget& budget) {
  std::vector<ExactPolynomial> sequence;
  while (!b.entry.empty()) {
    ExactPolynomial next = negatedRemainder(a, b, budget);
    sequence.push_back(std::move(a));
    a = std::move(b);
    b = std::move(next);
  }
  sequence.push_back(std::move(a));
  return sequence;
}

int cauchyIndex(const std::vector<ExactPolynomial>& sturm_sequence) {
  return signChanges(sturm_sequence, -1) - signChanges(sturm_sequence, 1);
}

RealRootCount countRealRoots(ExactPolynomial polynomial, ExactBudget& budget) {
  // The index of p'/p is the number of distinct real roots; gcd(p, p') has each of them once less.
  RealRootCount count;
  while (polynomial.entry.size() > 1) {
    std::vector<ExactPolynomial> sequence =
        sturmSequence(polynomial, derivative(polynomial), budget);
    const int distinct = cauchyIndex(sequence);
    if (distinct == 0) {
      break;
    }
    count.total += distinct;
    ++count.largest_multiplicity;
    polynomial = std::move(sequence.back());
  }
  return count;
}

}  // namespace whirl_twin
