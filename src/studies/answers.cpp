#include "studies/answers.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr int kResamples = 1000;
constexpr std::uint64_t kFewest = 2;   // minimum number of rows
constexpr double kConstant = 1.0e-12;  // relative to the largest magnitude: rounding

/// The central 95 % of an estimator over `count` rows drawn with replacement. The estimators of all
/// numbers share the draws. [value, low, high of each number]
template <class Estimator>
void bootstrap(std::uint64_t count, std::uint32_t seed, std::size_t numbers,
               const Estimator& estimator, std::vector<Estimate>& estimates) {
  std::vector<std::uint64_t> rows(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    rows[i] = i;
  }
  const std::vector<double> values = estimator(rows);
  std::vector<std::vector<double>> drawn(numbers);
  std::mt19937_64 random(seed);
  for (int k = 0; k < kResamples; ++k) {
    for (std::uint64_t& row : rows) {
      row = random() % count;
    }
    const std::vector<double> again = estimator(rows);
    for (std::size_t j = 0; j < numbers; ++j) {
      drawn[j].push_back(again[j]);
    }
  }
  for (std::size_t j = 0; j < numbers; ++j) {
    auto& d = drawn[j];
    d.erase(std::remove_if(d.begin(), d.end(), [](double x) { return !std::isfinite(x); }),
            d.end());
    std::sort(d.begin(), d.end());
    const auto at = [&](double part) {
      return d.empty() ? kNaN
                       : d[static_cast<std::size_t>(part * static_cast<double>(d.size() - 1))];
    };
    estimates.push_back({values[j], at(0.025), at(0.975)});
  }
}

/// Rows of `width` points with finite measures, and their row numbers.
struct KnownRows {
  std::vector<double> values;  // [rows * width]
  std::vector<std::uint64_t> number;
};

KnownRows knownRows(const std::vector<double>& measure, std::uint64_t rows, std::size_t width) {
  KnownRows known;
  for (std::uint64_t row = 0; row < rows; ++row) {
    const auto begin = measure.begin() + static_cast<std::ptrdiff_t>(row * width);
    const auto end = begin + static_cast<std::ptrdiff_t>(width);
    if (std::all_of(begin, end, [](double x) { return std::isfinite(x); })) {
      known.values.insert(known.values.end(), begin, end);
      known.number.push_back(row);
    }
  }
  return known;
}

/// An estimator over all rows, and its 95 % interval by the jackknife over replicates; row i is in
/// replicate `part[i]`. [value, low, high of each number]
template <class Estimator>
std::vector<Estimate> jackknife(const std::vector<std::uint64_t>& part, std::uint64_t parts,
                                const Estimator& estimator) {
  std::vector<std::uint64_t> rows(part.size());
  std::iota(rows.begin(), rows.end(), 0);
  const std::vector<double> values = estimator(rows);
  std::vector<std::vector<double>> without;
  for (std::uint64_t left_out = 0; left_out < parts; ++left_out) {
    std::vector<std::uint64_t> others;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(others),
                 [&](std::uint64_t row) { return part[row] != left_out; });
    if (!others.empty() && others.size() < rows.size()) {
      without.push_back(estimator(others));
    }
  }
  const auto count = static_cast<double>(without.size());
  const double within =
      count < 2.0 ? kNaN : boost::math::quantile(boost::math::students_t(count - 1.0), 0.975);
  std::vector<Estimate> estimates;
  for (std::size_t j = 0; j < values.size(); ++j) {
    double mean = 0.0, squares = 0.0;
    for (const std::vector<double>& one : without) {
      mean += one[j] / count;
    }
    for (const std::vector<double>& one : without) {
      squares += (one[j] - mean) * (one[j] - mean);
    }
    const double half = within * std::sqrt((count - 1.0) / count * squares);
    estimates.push_back({values[j], values[j] - half, values[j] + half});
  }
  return estimates;
}

bool isConstant(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return values.empty() ||
         *most - *least <= kConstant * std::max(std::fabs(*most), std::fabs(*least));
}

Estimate unknown() {
  return {kNaN, kNaN, kNaN};
}

}  // namespace

SobolIndices sobolIndices(const Design& design, const std::vector<double>& measure) {
  const std::size_t d = design.dimensions;
  const std::size_t width = d + 2;
  KnownRows known = knownRows(measure, design.base, width);
  std::vector<double>& f = known.values;
  SobolIndices indices;
  indices.rows = f.size() / width;
  indices.left_out = design.base - indices.rows;
  if (indices.rows < kFewest || isConstant(f)) {
    indices.first.assign(d, unknown());
    indices.total.assign(d, unknown());
    return indices;
  }
  double middle = 0.0;
  for (std::uint64_t row = 0; row < indices.rows; ++row) {
    middle += (f[row * width] + f[row * width + 1]) / (2.0 * static_cast<double>(indices.rows));
  }
  for (double& value : f) {
    value -= middle;
  }
  const auto estimator = [&](const std::vector<std::uint64_t>& rows) {
    const auto n = static_cast<double>(rows.size());
    double sum = 0.0;
    double squares = 0.0;
    std::vector<double> both(2 * d);
    for (const std::uint64_t row : rows) {
      const double* const at = f.data() + row * width;
      sum += at[0] + at[1];
      squares += at[0] * at[0] + at[1] * at[1];
      for (std::size_t j = 0; j < d; ++j) {
        const double changed = at[2 + j] - at[0];
        both[j] += at[1] * changed;
        both[d + j] += 0.5 * changed * changed;
      }
    }
    const double mean = sum / (2.0 * n);
    const double variance = squares / (2.0 * n) - mean * mean;
    for (double& index : both) {
      index /= n * variance;
    }
    return both;
  };
  const std::uint64_t parts = replicates(design.base);
  std::vector<std::uint64_t> part = known.number;
  for (std::uint64_t& row : part) {
    row %= parts;
  }
  const std::vector<Estimate> both = jackknife(part, parts, estimator);
  const auto half = both.begin() + static_cast<std::ptrdiff_t>(d);
  indices.first.assign(both.begin(), half);
  indices.total.assign(half, both.end());
  return indices;
}

MorrisEffects morrisEffects(const Design& design, std::uint32_t seed,
                            const std::vector<double>& measure) {
  const std::size_t d = design.dimensions;
  const std::size_t width = d + 1;
  std::vector<double> effects;  // a row per effect
  for (std::uint64_t trajectory = 0; trajectory < design.base; ++trajectory) {
    const double* const f = measure.data() + trajectory * width;
    if (!std::all_of(f, f + width, [](double x) { return std::isfinite(x); })) {
      continue;
    }
    std::vector<double> row(d);
    const std::vector<MorrisStep> steps = morrisSteps(design, seed, trajectory);
    for (std::size_t k = 0; k < d; ++k) {
      row[steps[k].number] =
          (f[k + 1] - f[k]) / (steps[k].up ? morrisStride(design) : -morrisStride(design));
    }
    effects.insert(effects.end(), row.begin(), row.end());
  }
  MorrisEffects found;
  found.trajectories = effects.size() / d;
  found.left_out = design.base - found.trajectories;
  if (found.trajectories < kFewest) {
    found.mean.assign(d, unknown());
    found.mean_magnitude = found.deviation = found.mean;
    return found;
  }
  const auto estimator = [&](const std::vector<std::uint64_t>& rows) {
    const auto n = static_cast<double>(rows.size());
    std::vector<double> all(3 * d);
    for (std::size_t j = 0; j < d; ++j) {
      double sum = 0.0;
      double magnitudes = 0.0;
      for (const std::uint64_t row : rows) {
        sum += effects[row * d + j];
        magnitudes += std::fabs(effects[row * d + j]);
      }
      double squares = 0.0;
      for (const std::uint64_t row : rows) {
        const double off = effects[row * d + j] - sum / n;
        squares += off * off;
      }
      all[j] = sum / n;
      all[d + j] = magnitudes / n;
      all[2 * d + j] = std::sqrt(squares / (n - 1.0));
    }
    return all;
  };
  std::vector<Estimate> all;
  bootstrap(found.trajectories, seed, 3 * d, estimator, all);
  const auto part = [&](std::size_t k) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(k * d);
    return std::vector<Estimate>(begin, begin + static_cast<std::ptrdiff_t>(d));
  };
  found.mean = part(0);
  found.mean_magnitude = part(1);
  found.deviation = part(2);
  return found;
}

namespace {

constexpr double kWithin95 = 1.959963984540054;  // standard deviations of a normal distribution

/// Interval of the p-quantile from sorted values: the r-th value is below the quantile unless fewer
/// than r values are.
std::array<double, 2> intervalOf(const std::vector<double>& sorted, double p) {
  using boost::math::complement;
  const boost::math::binomial_distribution<double> below(static_cast<double>(sorted.size()), p);
  // The largest rank with a probability of at most 2.5 % that fewer are below; searched near the
  // quantile, which Boost rounds.
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
