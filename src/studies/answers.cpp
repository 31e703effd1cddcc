#include "studies/answers.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kWithin95 = 1.959963984540054;  // standard deviations of a normal distribution

/// Of the part p, of values in their order: the r-th lies below it unless less than r of them do.
std::array<double, 2> intervalOf(const std::vector<double>& sorted, double p) {
  using boost::math::complement;
  const boost::math::binomial_distribution<double> below(static_cast<double>(sorted.size()), p);
  // The largest with a chance of at most 2.5 % that fewer lie below; near the quantile, whose
  // rounding is Boost's affair.
  constexpr double kPart = 0.025;
  const auto n = static_cast<double>(sorted.size());
  auto low = static_cast<std::size_t>(std::fmax(0.0, quantile(below, kPart) - 2.0));
  while (low < sorted.size() && cdf(below, static_cast<double>(low)) <= kPart) {
    ++low;
  }
  auto high = static_cast<std::size_t>(std::fmin(n, quantile(complement(below, kPart)) + 3.0));
  while (high > 0 && cdf(complement(below, static_cast<double>(high) - 1.0)) <= kPart) {
    --high;
  }
  return {low == 0 ? -kInfinity : sorted[low - 1],
          high == sorted.size() ? kInfinity : sorted[high]};
}

}  // namespace

Distributed distributed(const std::vector<double>& values, const std::vector<bool>& failed,
                        bool drawn) {
  Distributed found;
  std::vector<double> finite;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) {
      finite.push_back(values[i]);
    } else if (!failed[i]) {
      ++found.undefined;
    }
  }
  found.count = finite.size();
  if (finite.empty()) {
    found.mean = found.deviation = found.smallest = found.largest = kNaN;
    found.percentiles.fill(kNaN);
    return found;
  }
  double squares = 0.0;  // Welford's
  double count = 0.0;
  for (const double value : finite) {
    const double off = value - found.mean;
    found.mean += off / ++count;
    squares += off * (value - found.mean);
  }
  found.deviation = count > 1.0 ? std::sqrt(squares / (count - 1.0)) : kNaN;
  std::sort(finite.begin(), finite.end());
  found.smallest = finite.front();
  found.largest = finite.back();
  for (std::size_t k = 0; k < kPercentiles.size(); ++k) {
    const double at = kPercentiles[k] / 100.0 * (count - 1.0);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, finite.size() - 1);
    found.percentiles[k] =
        finite[below] + (at - static_cast<double>(below)) * (finite[above] - finite[below]);
  }
  if (drawn) {
    for (const double percentile : kPercentiles) {
      found.intervals.push_back(intervalOf(finite, percentile / 100.0));
    }
  }
  return found;
}

Yield yieldOf(std::uint64_t passed, std::uint64_t of) {
  Yield yield{passed, of, 0.0, 1.0};
  const auto n = static_cast<double>(of);
  const double p = yield.part();
  const double z2 = kWithin95 * kWithin95;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kWithin95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  yield.low = passed == 0 ? 0.0 : middle - half;
  yield.high = passed == of ? 1.0 : middle + half;
  return yield;
}

Answers answersOf(const Study& study, const StudyTable& table) {
  Answers answers;
  answers.points = study.points();
  answers.failures = table.failures;
  for (const std::vector<double>& measure : table.measures) {
    answers.measures.push_back(distributed(measure, table.failed, study.design.drawn()));
    if (study.design.kind == Design::Kind::kSobolIndices) {
      answers.sobol.push_back(sobolIndices(study.design, measure));
    } else if (study.design.kind == Design::Kind::kMorris) {
      answers.morris.push_back(morrisEffects(study.design, study.seed, measure));
    }
  }
  std::vector<std::uint64_t> passed(study.requirements.size());
  std::uint64_t passed_all = 0;
  for (std::uint64_t point = 0; point < study.points(); ++point) {
    bool all = true;
    for (std::size_t k = 0; k < passed.size(); ++k) {
      const Requirement& asked = study.requirements[k];
      const bool holds = asked.holds(table.measures[asked.measure][point]);
      passed[k] += holds ? 1 : 0;
      all = all && holds;
    }
    passed_all += all ? 1 : 0;
  }
  for (const std::uint64_t count : passed) {
    answers.requirements.push_back(yieldOf(count, study.points()));
  }
  if (!passed.empty()) {
    answers.yield = yieldOf(passed_all, study.points());
  }
  return answers;
}

}  // namespace whirl_twin
