#include "estimation/starting_filter.h"

#include <cmath>

namespace whirl_twin {

namespace {

/// Of the numbers' variances, summed: derivatives that are off by less need no second look.
constexpr double kFarOff = 0.0125;
/// Known so much better, they are what a second look is taken with.
constexpr double kNearEnough = 0.0025;
/// Twenty seconds of an arm with two encoders at 100 Hz, four at 500 Hz.
constexpr std::size_t kMostTold = 6000;
constexpr int kMostLooks = 4;
/// Of a standard deviation: derivatives that move by less stay the same.
constexpr double kSame = 0.2;

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
    told_.clear();
    told_.reserve(kMostTold);
  }
}

void StartingFilter::goTo(const ShaftInstant& there, double shaft_deviation) {
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
    if (looksAtItsStart() && (parameterVariance() < kNearEnough || told_.size() >= kMostTold)) {
      lookAgain();
    }
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
  begun_.reset();
  told_.clear();
}

void StartingFilter::keep(const Told& told) {
  if (looksAtItsStart()) {
    told_.push_back(told);
  }
}

void StartingFilter::lookAgain() {
  Eigen::VectorXd found = numbers();
  for (int look = 0; look < kMostLooks; ++look) {
    SystemFilter again = *begun_;
    if (!again.holdModel(found)) {
      break;
    }
    tell(again);
    again.releaseModel();
    if (!again.isFinite()) {
      break;  // what the first look made of it stays
    }
    const Eigen::VectorXd moved = again.numbers() - found;
    found = again.numbers();
    bool same = true;
    for (Eigen::Index i = 0; i < moved.size(); ++i) {
      same = same && std::fabs(moved[i]) <= kSame * again.numberDeviation(i);
    }
    static_cast<SystemFilter&>(*this) = std::move(again);
    if (same) {
      break;
    }
  }
  begun_.reset();
  told_ = {};
}

void StartingFilter::tell(SystemFilter& filter) const {
  for (const Told& told : told_) {
    switch (told.kind) {
      case Told::Kind::kBegin:
        filter.begin(told.shaft, told.to_twin, told.deviation);
        break;
      case Told::Kind::kGoTo:
        filter.goTo(told.shaft, told.deviation);
        break;
      case Told::Kind::kTake:
        filter.take(told.channel, told.value, told.deviation);
        break;
      case Told::Kind::kInput:
        filter.takeInput(told.channel, {told.time, told.value});
        break;
      case Told::Kind::kForget:
        filter.forgetMotion();
        break;
    }
  }
}

}  // namespace whirl_twin
