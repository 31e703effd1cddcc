#include "estimation/starting_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace whirl_twin {

namespace {

/// Of the numbers' variances, summed: derivatives that are off by less need no second look.
constexpr double kFarOff = 0.0125;
/// Known so much better, they have had their last look.
constexpr double kNearEnough = 0.0025;
/// Of what it was told: a second of two encoders at 1 kHz.
constexpr std::size_t kFirstLook = 3000;
/// 24 s of two encoders at 500 Hz, 3 MB.
constexpr std::size_t kMostTold = 36'000;
/// A start ends before the references of the drift watch are learned (followed_track.cpp), which a
/// step of an estimate would mislead.
constexpr std::int64_t kLongestStart = 100'000'000'000;  // ns
/// A number that has grown by more has left the straight line on which it was held.
constexpr double kStraight = 0.3;
/// Of the samples that were used before: a look that refuses more has lost the motion.
constexpr double kMostRefused = 0.01;
/// Calls that a look goes through at each that comes.
constexpr std::size_t kPace = 8;
/// Of a standard deviation, or of the number itself where that is more: derivatives that move by
/// less stay the same.
constexpr double kSame = 0.2;
constexpr double kSameNumber = 0.005;
/// Likewise: by more, and those of where the filter is are better.
constexpr double kStill = 1.0;

}  // namespace

void StartingFilter::begin(const ShaftInstant& at, std::int64_t to_twin, double shaft_deviation) {
  SystemFilter::begin(at, to_twin, shaft_deviation);
  if (looksAtItsStart()) {
    Told told{Told::Kind::kBegin, at};
    told.to_twin = to_twin;
    told.deviation = shaft_deviation;
    keep(told);
  } else if (!model().system()->dynamics->linear() && parameterVariance() > kFarOff) {
    begun_ = std::make_shared<const SystemFilter>(*this);
    start_ = at.time;
    next_look_ = kFirstLook;
    looked_ = false;
  }
}

void StartingFilter::goTo(const ShaftInstant& there, double shaft_deviation) {
  if (there.time <= shaft().time) {
    return;
  }
  SystemFilter::goTo(there, shaft_deviation);
  Told told{Told::Kind::kGoTo, there};
  told.deviation = shaft_deviation;
  keep(told);
}

Innovation StartingFilter::take(std::size_t channel, double value, double deviation) {
  const Innovation innovation = SystemFilter::take(channel, value, deviation);
  if (innovation.used) {
    Told told{Told::Kind::kTake};
    told.channel = channel;
    told.value = value;
    told.deviation = deviation;
    keep(told);
  }
  return innovation;
}

void StartingFilter::takeInput(std::size_t channel, const InputSample& sample) {
  SystemFilter::takeInput(channel, sample);
  Told told{Told::Kind::kInput};
  told.channel = channel;
  told.value = sample.value;
  told.time = sample.time;
  keep(told);
}

void StartingFilter::forgetMotion() {
  SystemFilter::forgetMotion();
  keep({Told::Kind::kForget});
}

void StartingFilter::startOver() {
  SystemFilter::startOver();
  endStart();
}

void StartingFilter::endStart() {
  begun_.reset();
  look_.reset();
  told_ = {};
}

/// And goes on with the look that is under way.
void StartingFilter::keep(const Told& told) {
  if (!looksAtItsStart()) {
    if (holdsModel() && !stays(*this, kStill)) {
      releaseModel();
    }
    return;
  }
  told_.push_back(told);
  if (!look_ && isDue()) {
    beginLook();
  }
  for (std::size_t k = 0; k < kPace && look_ && seen_ < told_.size(); ++k) {
    tell(told_[seen_++]);
  }
  if (look_ && seen_ == told_.size()) {
    endLook();
  }
}

bool StartingFilter::isDue() const {
  return told_.size() >= next_look_ ||
         (holdsModel() ? !stays(*this, kSame) : !looked_ && parameterVariance() < kNearEnough);
}

/// Are a filter's numbers within so much of their deviations those whose derivatives it takes?
bool StartingFilter::stays(const SystemFilter& filter, double part) const {
  const Eigen::VectorXd moved = filter.numbers() - looked_at_;
  for (Eigen::Index i = 0; i < moved.size(); ++i) {
    if (!(std::fabs(moved[i]) <= std::max(kSameNumber, part * filter.numberDeviation(i)))) {
      return false;
    }
  }
  return true;
}

void StartingFilter::beginLook() {
  look_.emplace(*begun_);
  looked_ = true;
  seen_ = taken_ = refused_ = 0;
  looked_at_ = numbers();
  if (!look_->holdModel(looked_at_)) {  // of a system that cannot be
    look_.reset();
    next_look_ = 2 * told_.size();
  }
}

void StartingFilter::endLook() {
  const bool same = stays(*look_, kSame);
  const bool far = (look_->numbers() - looked_at_).maxCoeff() > kStraight;
  // Else what was made of it before stays.
  const bool found =
      look_->isFinite() && refused_ <= kMostRefused * taken_ && (!far || look_->holdModelHere());
  if (found) {
    static_cast<SystemFilter&>(*this) = std::move(*look_);
    looked_at_ = far ? numbers() : looked_at_;
  }
  look_.reset();
  next_look_ = same || !found ? 2 * told_.size() : told_.size();
  if ((same && found && parameterVariance() < kNearEnough) || told_.size() >= kMostTold ||
      std::llabs(shaft().time - start_) > kLongestStart) {
    endStart();
  }
}

void StartingFilter::tell(const Told& told) {
  SystemFilter& filter = *look_;
  switch (told.kind) {
    case Told::Kind::kBegin:
      filter.begin(told.shaft, told.to_twin, told.deviation);
      break;
    case Told::Kind::kGoTo:
      filter.goTo(told.shaft, told.deviation);
      break;
    case Told::Kind::kTake:
      ++taken_;
      refused_ += filter.take(told.channel, told.value, told.deviation).used ? 0 : 1;
      break;
    case Told::Kind::kInput:
      filter.takeInput(told.channel, {told.time, told.value});
      break;
    case Told::Kind::kForget:
      filter.forgetMotion();
      break;
  }
}

}  // namespace whirl_twin
