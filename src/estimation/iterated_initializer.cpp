#include "estimation/iterated_initializer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace whirl_twin {

namespace {

/// Sum of the numbers' variances; below it the linearization needs no iteration.
constexpr double kFarOff = 0.0125;
/// Below it the last pass has been made.
constexpr double kNearEnough = 0.0025;
/// Stored calls before the first pass: a second of two encoders at 1 kHz.
constexpr std::size_t kFirstLook = 3000;
/// Stored calls at most: 24 s of two encoders at 500 Hz, 3 MB.
constexpr std::size_t kMaxStored = 36'000;
/// The initialization ends before the drift detector has learned its references
/// (estimator_track.cpp), which a step of the estimate would falsify.
constexpr std::int64_t kMaxStart = 100'000'000'000;  // ns
/// Change of a number beyond which its straight-line extrapolation is invalid (holdModelHere()).
constexpr double kStraight = 0.3;
/// Fraction of the samples used before: a pass that rejects more has lost the motion.
constexpr double kMaxRefused = 0.01;
/// Stored calls processed by a pass per new call.
constexpr std::size_t kPace = 8;
/// Relative to a standard deviation, or a change of the number if that is larger: smaller changes
/// keep the linearization point.
constexpr double kSame = 0.2;
constexpr double kSameNumber = 0.005;
/// Likewise: after a larger change the filter linearizes at its own estimate.
constexpr double kStill = 1.0;

}  // namespace

void IteratedInitializer::begin(const ShaftInstant& at, std::int64_t to_twin,
                                double shaft_deviation) {
  ExtendedKalmanFilter::begin(at, to_twin, shaft_deviation);
  if (looksAtItsStart()) {
    StoredStep stored{StoredStep::Kind::kBegin, at};
    stored.to_twin = to_twin;
    stored.deviation = shaft_deviation;
    keep(stored);
  } else if (!model().system()->dynamics->linear() && parameterVariance() > kFarOff) {
    begun_ = std::make_shared<const ExtendedKalmanFilter>(*this);
    start_ = at.time;
    next_look_ = kFirstLook;
    looked_ = false;
  }
}

void IteratedInitializer::goTo(const ShaftInstant& there, double shaft_deviation) {
  if (there.time <= shaft().time) {
    return;
  }
  ExtendedKalmanFilter::goTo(there, shaft_deviation);
  StoredStep stored{StoredStep::Kind::kGoTo, there};
  stored.deviation = shaft_deviation;
  keep(stored);
}

Innovation IteratedInitializer::take(std::size_t channel, double value, double deviation) {
  const Innovation innovation = ExtendedKalmanFilter::take(channel, value, deviation);
  if (innovation.used) {
    StoredStep stored{StoredStep::Kind::kTake};
    stored.channel = channel;
    stored.value = value;
    stored.deviation = deviation;
    keep(stored);
  }
  return innovation;
}

void IteratedInitializer::takeInput(std::size_t channel, const InputSample& sample) {
  ExtendedKalmanFilter::takeInput(channel, sample);
  StoredStep stored{StoredStep::Kind::kInput};
  stored.channel = channel;
  stored.value = sample.value;
  stored.time = sample.time;
  keep(stored);
}

void IteratedInitializer::forgetMotion() {
  ExtendedKalmanFilter::forgetMotion();
  keep({StoredStep::Kind::kForget});
}

void IteratedInitializer::startOver() {
  ExtendedKalmanFilter::startOver();
  endStart();
}

void IteratedInitializer::endStart() {
  begun_.reset();
  look_.reset();
  stored_ = {};
}

/// Also continues a pass under way.
void IteratedInitializer::keep(const StoredStep& stored) {
  if (!looksAtItsStart()) {
    if (holdsModel() && !stays(*this, kStill)) {
      releaseModel();
    }
    return;
  }
  stored_.push_back(stored);
  if (!look_ && isDue()) {
    beginLook();
  }
  for (std::size_t k = 0; k < kPace && look_ && seen_ < stored_.size(); ++k) {
    replay(stored_[seen_++]);
  }
  if (look_ && seen_ == stored_.size()) {
    endLook();
  }
}

bool IteratedInitializer::isDue() const {
  return stored_.size() >= next_look_ ||
         (holdsModel() ? !stays(*this, kSame) : !looked_ && parameterVariance() < kNearEnough);
}

/// Are a filter's numbers within a fraction of their standard deviations of the linearization
/// point?
bool IteratedInitializer::stays(const ExtendedKalmanFilter& filter, double part) const {
  const Eigen::VectorXd moved = filter.numbers() - looked_at_;
  for (Eigen::Index i = 0; i < moved.size(); ++i) {
    if (!(std::fabs(moved[i]) <= std::max(kSameNumber, part * filter.numberDeviation(i)))) {
      return false;
    }
  }
  return true;
}

void IteratedInitializer::beginLook() {
  look_.emplace(*begun_);
  looked_ = true;
  seen_ = taken_ = refused_ = 0;
  looked_at_ = numbers();
  if (!look_->holdModel(looked_at_)) {  // invalid for the system
    look_.reset();
    next_look_ = 2 * stored_.size();
  }
}

void IteratedInitializer::endLook() {
  const bool same = stays(*look_, kSame);
  const bool far = (look_->numbers() - looked_at_).maxCoeff() > kStraight;
  // Otherwise the estimate is kept.
  const bool found =
      look_->isFinite() && refused_ <= kMaxRefused * taken_ && (!far || look_->holdModelHere());
  if (found) {
    static_cast<ExtendedKalmanFilter&>(*this) = std::move(*look_);
    looked_at_ = far ? numbers() : looked_at_;
  }
  look_.reset();
  next_look_ = same || !found ? 2 * stored_.size() : stored_.size();
  if ((same && found && parameterVariance() < kNearEnough) || stored_.size() >= kMaxStored ||
      std::llabs(shaft().time - start_) > kMaxStart) {
    endStart();
  }
}

void IteratedInitializer::replay(const StoredStep& stored) {
  ExtendedKalmanFilter& filter = *look_;
  switch (stored.kind) {
    case StoredStep::Kind::kBegin:
      filter.begin(stored.shaft, stored.to_twin, stored.deviation);
      break;
    case StoredStep::Kind::kGoTo:
      filter.goTo(stored.shaft, stored.deviation);
      break;
    case StoredStep::Kind::kTake:
      ++taken_;
      refused_ += filter.take(stored.channel, stored.value, stored.deviation).used ? 0 : 1;
      break;
    case StoredStep::Kind::kInput:
      filter.takeInput(stored.channel, {stored.time, stored.value});
      break;
    case StoredStep::Kind::kForget:
      filter.forgetMotion();
      break;
  }
}

}  // namespace whirl_twin
