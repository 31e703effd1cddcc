#include "estimation/innovation_tests.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "estimation/alarm_limits.h"

namespace whirl_twin {

namespace {

/// With fewer numbers the limits are inaccurate.
constexpr std::size_t kMinResiduals = 50;

}  // namespace

InnovationTest::InnovationTest(std::size_t channels, const InnovationTestSettings& settings)
    : window_(settings.window), last_(channels, kNaN), begin_(kNaN), newest_(kNaN) {
  const double each = falseAlarmsEach(settings.false_alarms / 4.0, settings.window);
  z_ = normalLimit(std::min(each, 0.5));
}

void InnovationTest::restart() {
  begin_ = newest_ = kNaN;
  numbers_ = pairs_ = 0;
  squares_ = surest_ = products_ = 0.0;
  std::fill(last_.begin(), last_.end(), kNaN);
}

bool InnovationTest::take(double time, const double* innovation, std::size_t channels,
                          const double* surest) {
  if (time < newest_) {
    restart();
  }
  newest_ = time;
  bool ended = false;
  if (std::isnan(begin_)) {
    begin_ = time;
  } else if (time - begin_ >= window_ && numbers_ >= kMinResiduals && pairs_ >= kMinResiduals / 2) {
    judge(time);
    ended = true;
    begin_ = time;
    numbers_ = pairs_ = 0;
    squares_ = surest_ = products_ = 0.0;
  }
  for (std::size_t i = 0; i < std::min(channels, last_.size()); ++i) {
    const double e = innovation[i];
    if (!std::isnan(e)) {
      ++numbers_;
      squares_ += e * e;
      surest_ += surest == nullptr ? e * e : surest[i] * surest[i];
      if (!std::isnan(last_[i])) {
        ++pairs_;
        products_ += e * last_[i];
      }
    }
    last_[i] = e;
  }
  return ended;
}

void InnovationTest::judge(double time) {
  const auto n = static_cast<double>(numbers_);
  const auto pairs = static_cast<double>(pairs_);
  verdict_.time = time;
  const double mean = squares_ / n;
  verdict_.mismatch = std::max(mean, std::min(surest_ / n, 1.0));
  verdict_.mismatch_least = meanSquareLimit(numbers_, -z_);
  verdict_.mismatch_limit = meanSquareLimit(numbers_, z_);
  // Normalized by the squares of as many numbers as there are pairs: the correlation, for any
  // variance.
  verdict_.whiteness = squares_ > 0.0 ? products_ / pairs / mean : 0.0;
  verdict_.whiteness_limit = z_ / std::sqrt(pairs);
}

namespace {

constexpr double kUpperEnd = 1.645;        // standard deviations, of a 95 % interval
constexpr double kMaxCorrelated = 0.995;   // of samples
constexpr double kMinAllowance = 0.5;      // in standard deviations
constexpr double kBetterKnown = 0.8;       // ratio of deviations: a new reference is learned
constexpr double kHole = 2.5;              // periods; less than a sample a period gives up to 2
constexpr double kSameDeviation = 1.0e-3;  // relative change for which the limits are kept
constexpr std::int64_t kMinSamples = 30;   // of a warm-up
constexpr double kMaxSum = 2.0;            // of a limit: bounds the time to return to normal

}  // namespace

CusumDetector::CusumDetector(std::size_t parameters, const CusumDetectorSettings& settings)
    : settings_(settings),
      samples_(
          std::max(kMinSamples, static_cast<std::int64_t>(settings.warm_up / settings.period))),
      watches_(parameters),
      looked_at_(kNaN) {
  // Two two-sided statistics per parameter.
  const double statistics = 4.0 * static_cast<double>(std::max<std::size_t>(parameters, 1));
  const double each = falseAlarmsEach(settings.false_alarms / statistics, settings.period);
  run_length_ = 1.0 / each;
  z_ = normalLimit(std::min(each, 0.5));
}

bool CusumDetector::take(double time, const double* value, const double* deviation) {
  // Tolerance of half a thousandth, for rounding and periods that are no multiple of the sample
  // time.
  if (time >= looked_at_ && time - looked_at_ < settings_.period * (1.0 - 5.0e-4)) {
    return false;
  }
  // After a gap the learned correlation does not apply.
  const bool whole = time - looked_at_ < kHole * settings_.period && time > looked_at_;
  looked_at_ = time;
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    Watch& watch = watches_[i];
    if (!whole) {
      watch.previous = kNaN;
    }
    if (!std::isfinite(value[i]) || !(deviation[i] > 0.0) || !std::isfinite(deviation[i])) {
      watch.previous = kNaN;
      continue;
    }
    if (watch.learned && deviation[i] < kBetterKnown * watch.deviation) {
      watch = Watch();
    }
    if (watch.learned) {
      compare(watch, time, value[i], deviation[i]);
    } else {
      warmUp(watch, value[i], deviation[i]);
    }
  }
  tell(time);
  return true;
}

void CusumDetector::warmUp(Watch& watch, double value, double deviation) const {
  WarmUp& w = watch.warm_up;
  if (w.count == 0 || deviation < kBetterKnown * w.deviation) {
    w = WarmUp();
    w.first = value;
    w.deviation = deviation;
  }
  const double x = value - w.first;
  w.products += w.count == 0 ? 0.0 : x * w.last;
  w.sum += x;
  w.squares += x * x;
  w.variances += deviation * deviation;
  w.last = x;
  if (++w.count >= samples_) {
    learn(watch);
  }
}

void CusumDetector::learn(Watch& watch) const {
  const WarmUp& w = watch.warm_up;
  const auto n = static_cast<double>(w.count);
  const double mean = w.sum / n;
  const double variance = w.squares / n - mean * mean;
  // The first value (0, less itself) and the last have one neighbour only.
  const double lagged =
      (w.products - mean * (2.0 * w.sum - w.last)) / n + (n - 1.0) / n * mean * mean;
  const double seen = variance > 0.0 ? std::clamp(lagged / variance, -1.0, 1.0) : 1.0;
  // Bias correction: the mean is that of the same samples, which makes the correlation too small
  // (Kendall, Biometrika 41, 1954).
  const double unbiased = std::min(seen + (1.0 + 4.0 * std::max(seen, 0.0)) / n, 1.0);
  const double upper = unbiased + kUpperEnd * std::sqrt((1.0 - unbiased * unbiased) / n);
  watch.correlation = std::clamp(upper, 0.0, kMaxCorrelated);
  watch.reference = w.first + mean;
  watch.deviation = std::sqrt(w.variances / n);
  const double r = watch.correlation;
  const double independent = 0.5 * watch.deviation * watch.deviation * (1.0 - r * r);
  // Variance of the innovations with r above the sample correlation: not less than with the latter.
  const double is_new = std::max(0.0, variance * (1.0 - 2.0 * r * seen + r * r));
  const double upper_end = 1.0 + kUpperEnd / std::sqrt(2.0 * n);
  watch.scatter = std::fmax(1.0, upper_end * std::sqrt(is_new / independent));
  // Bias correction: the scatter about the sample mean is too small by the variance of the mean.
  const double as_seen = std::clamp(unbiased, 0.0, kMaxCorrelated);
  const double of_mean = (1.0 + as_seen) / ((1.0 - as_seen) * n);
  const double wide = variance / std::fmax(1.0 - of_mean, 0.5);
  watch.spread =
      std::sqrt((1.0 + of_mean) * std::fmax(1.0, wide / (watch.deviation * watch.deviation)));
  watch.learned = true;
}

void CusumDetector::prepare(Watch& watch, double deviation) const {
  const double wider = std::fmax(1.0, deviation / watch.deviation);
  const double matters = settings_.matters * std::fabs(watch.reference);
  watch.prepared_for = deviation;
  watch.sigma = watch.spread * wider * watch.deviation;
  watch.distance_limit = std::fmax(z_, 0.5 * matters / watch.sigma);
  // The memory P/q, and with it the logarithm of the correlation, grows with the variance.
  const double r = std::min(std::pow(watch.correlation, 1.0 / (wider * wider)), kMaxCorrelated);
  watch.now_correlated = r;
  watch.news = watch.scatter * wider * watch.deviation * std::sqrt(0.5 * (1.0 - r * r));
  watch.allowance = std::fmax(0.5 * matters * (1.0 - r) / watch.news, kMinAllowance);
  const double wrong = 2.0 / std::sqrt(static_cast<double>(samples_));
  watch.sum_limit =
      std::fmax(cumulativeSumLimit(watch.allowance - wrong, run_length_), watch.allowance);
}

void CusumDetector::compare(Watch& watch, double time, double value, double deviation) const {
  if (std::fabs(deviation - watch.prepared_for) > kSameDeviation * deviation) {
    prepare(watch, deviation);
  }
  const double x = watch.newest = value - watch.reference;
  const double before = watch.previous;
  watch.previous = x;
  watch.distance = std::fabs(x) / watch.sigma;
  if (std::isnan(before)) {
    return;
  }
  const double w = (x - watch.now_correlated * before) / watch.news;
  const auto add = [&](double& total, double& since, double news) {
    if (total <= 0.0) {
      since = time - settings_.period;
    }
    total = std::clamp(total + news - watch.allowance, 0.0, kMaxSum * watch.sum_limit);
  };
  add(watch.up, watch.up_since, w);
  add(watch.down, watch.down_since, -w);
}

void CusumDetector::tell(double time) {
  drift_ = Drift();
  double nearest = -1.0;
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    const Watch& watch = watches_[i];
    if (!watch.learned || watch.distance_limit <= 0.0) {
      continue;  // or no sample since
    }
    const double sum = std::fmax(watch.up, watch.down);
    const double by_sum = sum / watch.sum_limit;
    const double by_distance = watch.distance / watch.distance_limit;
    const double ratio = std::fmax(by_sum, by_distance);
    if (ratio <= nearest) {
      continue;
    }
    nearest = ratio;
    drift_.statistic = by_sum > by_distance ? sum : watch.distance;
    drift_.limit = by_sum > by_distance ? watch.sum_limit : watch.distance_limit;
    if (ratio > 1.0) {
      const bool up = by_sum > 1.0 ? watch.up > watch.down : watch.newest > 0.0;
      drift_.parameter = static_cast<int>(i);
      drift_.from = watch.reference;
      drift_.to = watch.reference + watch.newest;
      drift_.since = (up ? watch.up : watch.down) <= 0.0 ? time
                     : up                                ? watch.up_since
                                                         : watch.down_since;
    }
  }
}

}  // namespace whirl_twin
