#include "twin/ensemble_observer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "twin/record.h"

namespace whirl_twin {

namespace {

/// A quantity of the running samples, ascending.
std::vector<double> ascending(const double* values, std::size_t count, std::size_t quantities,
                              std::size_t quantity) {
  std::vector<double> sorted;
  sorted.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double value = values[i * quantities + quantity];
    if (!std::isnan(value)) {
      sorted.push_back(value);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : sum / static_cast<double>(values.size());
}

/// Sample standard deviation (n - 1); 0 for a single value.
double standardDeviation(const std::vector<double>& values, double mean) {
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - mean) * (value - mean);
  }
  return values.empty()       ? std::numeric_limits<double>::quiet_NaN()
         : values.size() == 1 ? 0.0
                              : std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

double percentile(const std::vector<double>& ascending, double p) {
  if (ascending.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double place = p / 100.0 * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] +
         (place - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

state::EnsembleState ensembleStatistics(const Ensemble& ensemble, const double* record) {
  state::EnsembleState s;
  s.at.step = ensemble.stepOf(record);
  s.count = static_cast<std::int64_t>(ensemble.count());
  const std::size_t quantities = ensemble.quantities().size();
  const double* const values = ensemble.values(record);
  const double* const peaks = ensemble.peaks(record);
  for (std::size_t k = 0; k < quantities; ++k) {
    s.quantity.push_back(ensemble.quantities()[k].name);
    s.unit.push_back(ensemble.quantities()[k].unit);
    const std::vector<double> now = ascending(values, ensemble.count(), quantities, k);
    s.running = static_cast<std::int64_t>(now.size());
    s.mean.push_back(meanOf(now));
    s.standard_deviation.push_back(standardDeviation(now, s.mean.back()));
    s.smallest.push_back(percentile(now, 0.0));
    s.percentile_5.push_back(percentile(now, 5.0));
    s.percentile_25.push_back(percentile(now, 25.0));
    s.median.push_back(percentile(now, 50.0));
    s.percentile_75.push_back(percentile(now, 75.0));
    s.percentile_95.push_back(percentile(now, 95.0));
    s.largest.push_back(percentile(now, 100.0));
    const std::vector<double> peak = ascending(peaks, ensemble.count(), quantities, k);
    s.peak_mean.push_back(meanOf(peak));
    s.peak_standard_deviation.push_back(standardDeviation(peak, s.peak_mean.back()));
    s.peak_percentile_5.push_back(percentile(peak, 5.0));
    s.peak_median.push_back(percentile(peak, 50.0));
    s.peak_percentile_95.push_back(percentile(peak, 95.0));
    s.peak_largest.push_back(percentile(peak, 100.0));
  }
  return s;
}

EnsembleObserver::EnsembleObserver(Twin& twin) : twin_(twin), last_steps_(twin.systems().size()) {
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    if (twin.ensemble(i) != nullptr) {
      systems_.push_back(i);
      record_.resize(std::max(record_.size(), twin.ensemble(i)->recordSize()));
    }
  }
}

bool EnsembleObserver::take(std::size_t system, const state::Instant& now,
                            state::EnsembleState& out) {
  Ensemble& ensemble = *twin_.ensemble(system);
  if (!ensemble.take(record_.data())) {
    return false;
  }
  out = ensembleStatistics(ensemble, record_.data());
  out.system = twin_.systems()[system]->spec.name;
  out.at.time = twin_.seconds(out.at.step);
  // After a reset that is later than `now` the stamp cannot be computed from the step.
  const bool went_back = out.at.step < last_steps_[system];
  last_steps_[system] = out.at.step;
  out.at.stamp = went_back ? now.stamp : now.stamp + (out.at.step - now.step) * twin_.scene().step;
  return true;
}

}  // namespace whirl_twin
