#include "estimation/residual_watch.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "estimation/alarm_limits.h"

namespace whirl_twin {
namespace {

/// Numbers below which limits are not what they say.
constexpr std::size_t kMinResiduals = 50;

}  // namespace

ResidualWatch::ResidualWatch(std::size_t channels, const ResidualWatchSettings& settings)
    : window_(settings.window), last_(channels, kNaN), begin_(kNaN), newest_(kNaN) {
  const double each = falseAlarmsEach(settings.false_alarms / 4.0, settings.window);
  z_ = normalLimit(std::min(each, 0.5));
}

void ResidualWatch::restart() {
  begin_ = newest_ = kNaN;
  numbers_ = pairs_ = 0;
  squares_ = surest_ = products_ = 0.0;
  std::fill(last_.begin(), last_.end(), kNaN);
}

bool ResidualWatch::take(double time, const double* innovation, std::size_t channels,
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

void ResidualWatch::judge(double time) {
  const auto n = static_cast<double>(numbers_);
  const auto pairs = static_cast<double>(pairs_);
  verdict_.time = time;
  const double mean = squares_ / n;
  verdict_.mismatch = std::max(mean, std::min(surest_ / n, 1.0));
  verdict_.mismatch_least = meanSquareLimit(numbers_, -z_);
  verdict_.mismatch_limit = meanSquareLimit(numbers_, z_);
  // Of as many squares as there are pairs: the correlation, whatever the size.
  verdict_.whiteness = squares_ > 0.0 ? products_ / pairs / mean : 0.0;
  verdict_.whiteness_limit = z_ / std::sqrt(pairs);
}

}  // namespace whirl_twin
