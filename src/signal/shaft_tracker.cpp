#include "signal/shaft_tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "signal/outliers.h"

namespace whirl_twin {

namespace {

constexpr double kGate = 5.0;            // standard deviations, beyond which a pulse is refused
constexpr double kKnown = 0.5 * kTwoPi;  // [rad], that two standard deviations stay below

// Doubt that a shaft is followed at all: half or double its speed fits some of its pulses too.
constexpr int kByRefused = 2;
constexpr int kByMissed = 3;
constexpr int kByTaken = -1;
constexpr int kMaxDoubt = 20;

// Four pulses in a row that a constant acceleration explains: they are marks, none missing.
constexpr double kMaxChange = 1.4;         // of intervals, from one to the next
constexpr double kMisfit = 0.01 * kTwoPi;  // [rad], besides jitter
constexpr double kMaxMisfit = 0.05 * kTwoPi;

// As stated, unless the pulses scatter this many times more.
constexpr double kClearlyMore = 1.5;
constexpr std::size_t kMinMisfits = 8;
// Variance that white jerk of density 1 leaves over four instants a second apart, in angle: that of
// a third difference, 11/20, over the sum of its squared weights, 20.
constexpr double kWanderOfFour = 11.0 / 400.0;

double seconds(std::int64_t from, std::int64_t to) {
  return 1.0e-9 * static_cast<double>(to - from);
}

/// State after a time [s] of a constant acceleration.
Eigen::Matrix3d transition(double t) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 1) = f(1, 2) = t;
  f(0, 2) = 0.5 * t * t;
  return f;
}

/// What white jerk of density 1 adds in a time [s].
Eigen::Matrix3d wandered(double t) {
  Eigen::Matrix3d q;
  q << t * t * t * t * t / 20.0, t * t * t * t / 8.0, t * t * t / 6.0,  //
      t * t * t * t / 8.0, t * t * t / 3.0, t * t / 2.0,                //
      t * t * t / 6.0, t * t / 2.0, t;
  return q;
}

}  // namespace

ShaftTrackerSettings trackerOf(const KeyphasorSettings& keyphasor, double phase, double least) {
  ShaftTrackerSettings settings;
  settings.mark = shaftAngle(keyphasor.mark + phase).remainder;
  settings.jitter =
      std::max(least, std::hypot(keyphasor.jitter, keyphasor.resolution / std::sqrt(12.0)));
  return settings;
}

ShaftTracker::ShaftTracker(const ShaftTrackerSettings& settings)
    : settings_(settings), jitter_(settings.jitter) {}

void ShaftTracker::clear() {
  kept_ = 0;
  refused_.reset();
  doubt_ = 0;
  lost_ = {};
  after_.reset();
}

double ShaftTracker::deviationOf(const State& state) {
  return std::sqrt(state.covariance(0, 0));
}

double ShaftTracker::pulseVariance(double speed) const {
  const double deviation = jitter_ * speed;
  return deviation * deviation;
}

ShaftTracker::State ShaftTracker::predicted(const State& from, std::int64_t time) const {
  const double t = seconds(from.time, time);
  const Eigen::Matrix3d f = transition(t);
  State to = from;
  to.time = time;
  to.mean = f * from.mean;
  if (from.mean[1] >= 0.0 && to.mean[1] < 0.0) {
    // Slowing down it has come to rest meanwhile.
    to.mean[0] = from.mean[0] - 0.5 * from.mean[1] * from.mean[1] / from.mean[2];
    to.mean[1] = to.mean[2] = 0.0;
  }
  to.covariance = f * from.covariance * f.transpose() + settings_.white_jerk * wandered(t);
  return to;
}

ShaftTracker::State ShaftTracker::corrected(const State& predicted, double innovation,
                                            double variance) {
  State state = predicted;
  const Eigen::Vector3d gain =
      predicted.covariance.col(0) / (predicted.covariance(0, 0) + variance);
  state.mean += gain * innovation;
  // Joseph's form stays positive definite.
  Eigen::Matrix3d left = Eigen::Matrix3d::Identity();
  left.col(0) -= gain;
  state.covariance =
      left * predicted.covariance * left.transpose() + variance * gain * gain.transpose();
  return state;
}

bool ShaftTracker::take(std::int64_t instant) {
  const bool taken = judge(instant);
  refused_ <<= 1;
  refused_[0] = !taken;
  return taken;
}

bool ShaftTracker::judge(std::int64_t instant) {
  if (kept_ > 0 && instant <= pulses_.back()) {
    ++counts_.refused;
    return false;
  }
  std::rotate(pulses_.begin(), pulses_.begin() + 1, pulses_.end());
  pulses_.back() = instant;
  kept_ = std::min(kept_ + 1, static_cast<int>(pulses_.size()));
  learnJitter();
  if (!after_) {
    return lock();
  }
  const State now = predicted(*after_, instant);
  if (2.0 * deviationOf(now) >= kKnown) {
    return lock();
  }
  const double marks = std::round(now.mean[0] / kTwoPi);
  const double innovation = marks * kTwoPi - now.mean[0];
  const double variance = pulseVariance(now.mean[1]);
  if (marks < 1.0) {
    return refuse();
  }
  if (std::fabs(innovation) > kGate * std::sqrt(now.covariance(0, 0) + variance)) {
    // The shaft may have deviated from the prediction: doubles the standard deviation.
    after_->covariance *= 4.0;
    return refuse();
  }
  doubt_ = std::max(0, doubt_ + kByTaken + (marks > 1.0 ? kByMissed : 0));
  counts_.missed += std::llround(marks) - 1;
  take(now, innovation, variance);
  return doubt_ < kMaxDoubt || lock();
}

void ShaftTracker::take(const State& predicted, double innovation, double variance) {
  ++counts_.taken;
  before_ = after_;
  expected_ = predicted;
  after_ = corrected(predicted, innovation, variance);
  const double marks = std::round((predicted.mean[0] + innovation) / kTwoPi);
  after_->mean[0] -= marks * kTwoPi;
  after_->turns += std::llround(marks);
}

bool ShaftTracker::refuse() {
  ++counts_.refused;
  doubt_ += kByRefused;
  // The one before this and the two before that: of four, with this one, two were refused.
  const bool surprising = refused_[0] || refused_[1] || refused_[2];
  const bool moves_otherwise = surprising && agreement();
  return (moves_otherwise || doubt_ >= kMaxDoubt) && lock();
}

/// Instants [s] of the last four pulses from the first of them, and the angle [rad] by which they
/// miss a constant acceleration, as one standard deviation of a pulse would have it; infinite where
/// they are not those of four turns in a row.
double ShaftTracker::intervals(std::array<double, 4>& t) const {
  if (kept_ < static_cast<int>(pulses_.size())) {
    return std::numeric_limits<double>::infinity();
  }
  for (std::size_t i = 0; i < 4; ++i) {
    t[i] = seconds(pulses_[0], pulses_[i]);
  }
  for (std::size_t i = 2; i < 4; ++i) {
    const double change = (t[i] - t[i - 1]) / (t[i - 1] - t[i - 2]);
    if (change > kMaxChange || change * kMaxChange < 1.0) {
      return std::numeric_limits<double>::infinity();
    }
  }
  // Third divided difference of the angle over time: nothing but noise is in it.
  double difference = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double product = 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      product *= k == i ? 1.0 : t[i] - t[k];
    }
    difference += static_cast<double>(i) * kTwoPi / product;
    squares += 1.0 / (product * product);
  }
  return std::fabs(difference) / std::sqrt(squares);
}

void ShaftTracker::learnJitter() {
  std::array<double, 4> t{};
  const double misfit = intervals(t);
  if (misfit > kMaxMisfit) {
    return;
  }
  const double wander = kWanderOfFour * settings_.white_jerk * std::pow(t[3] / 3.0, 5);
  const double speed = 3.0 * kTwoPi / t[3];
  misfits_[misfits_taken_++ % misfits_.size()] =
      std::sqrt(std::max(0.0, misfit * misfit - wander)) / speed;
  const std::size_t count = std::min(misfits_taken_, misfits_.size());
  if (count < kMinMisfits) {
    return;
  }
  const double shown = robustScale(misfits_, count);
  jitter_ = shown > kClearlyMore * settings_.jitter ? shown : settings_.jitter;
}

/// The misfit of the last four pulses [rad], where that is noise.
std::optional<double> ShaftTracker::agreement() const {
  std::array<double, 4> t{};
  const double misfit = intervals(t);
  if (misfit > kMaxMisfit) {
    return std::nullopt;
  }
  const double wander = std::sqrt(settings_.white_jerk * wandered(t[1])(0, 0));
  const double noise = std::sqrt(pulseVariance(3.0 * kTwoPi / t[3])) + wander;
  return misfit <= kMisfit + kGate * noise ? std::optional<double>(misfit) : std::nullopt;
}

bool ShaftTracker::lock() {
  if (after_) {
    lost_ = {after_->time, after_->turns};
    after_.reset();
  }
  const std::optional<double> agreed = agreement();
  if (!agreed) {
    return false;
  }
  const double misfit = *agreed;
  const double speed = 3.0 * kTwoPi / seconds(pulses_[0], pulses_[3]);
  const double variance = pulseVariance(speed) + misfit * misfit;
  State first;
  first.time = pulses_[0];
  // Turns without a pulse are not known to have been; those counted before are not counted again.
  const auto counted = std::find(pulses_.begin(), pulses_.end(), lost_.time);
  first.turns = lost_.turns + (counted == pulses_.end() ? 1 : pulses_.begin() - counted);
  first.mean = {0.0, kTwoPi / seconds(pulses_[0], pulses_[1]), 0.0};
  // Of speed and acceleration nothing is known but their size.
  first.covariance.diagonal() << variance, speed * speed, std::pow(speed * speed / kTwoPi, 2);
  after_ = first;
  for (std::size_t i = 1; i < 4; ++i) {
    const State now = predicted(*after_, pulses_[i]);
    take(now, kTwoPi - now.mean[0], variance);
  }
  ++counts_.taken;  // the first
  ++counts_.locked;
  doubt_ = 0;
  return true;
}

ShaftTracker::State ShaftTracker::smoothed(std::int64_t time) const {
  State then = predicted(*before_, time);
  const Eigen::Matrix3d gain = then.covariance *
                               transition(seconds(time, after_->time)).transpose() *
                               expected_->covariance.inverse();
  Eigen::Vector3d found = after_->mean - expected_->mean;
  found[0] += kTwoPi * static_cast<double>(after_->turns - expected_->turns);
  then.mean += gain * found;
  then.covariance += gain * (after_->covariance - expected_->covariance) * gain.transpose();
  return then;
}

ShaftEstimate ShaftTracker::at(std::int64_t instant) const {
  ShaftEstimate shaft;
  if (!after_ || instant < before_->time) {
    shaft.angle.turns = after_ ? after_->turns : lost_.turns;
    shaft.angle.remainder = settings_.mark;
    shaft.deviation = kTwoPi;
    return shaft;
  }
  const State state = instant < after_->time ? smoothed(instant) : predicted(*after_, instant);
  shaft.angle = shaftAngle(settings_.mark + state.mean[0]);
  shaft.angle.turns += state.turns;
  shaft.speed = state.mean[1];
  shaft.acceleration = state.mean[2];
  shaft.deviation = std::sqrt(std::max(0.0, state.covariance(0, 0)));
  shaft.known = 2.0 * shaft.deviation < kKnown;
  return shaft;
}

}  // namespace whirl_twin
