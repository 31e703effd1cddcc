#include "integration/lateral_run_up.h"

#include <algorithm>
#include <cmath>

#include "mechanics/sine_cosine.h"

namespace whirl_twin {

namespace {

/// How far sweeps are to come down, and from where twelve of them do.
constexpr double kSwept = 1.0e-15;
constexpr double kMaxCoupling = 0.5;
constexpr int kMaxSweeps = 12;
constexpr int kMaxPartsOfRunUp = 1 << 16;

}  // namespace

LateralRunUp::Set::Set(std::size_t count, double farthest)
    : stretches(count),
      reach(farthest),
      take(lateralGaussStep(count)),
      go_on(lateralGaussContinuation(count)) {
  for (std::size_t j = 0; j < count; ++j) {
    nodes[j] = stretches.nodes.nodes[j];
    weights[j] = stretches.nodes.weights[j];
  }
}

const std::array<LateralRunUp::Set, LateralRunUp::kSets>& LateralRunUp::sets() {
  static const std::array<Set, kSets> all{Set(4, 0.41), Set(8, 4.4), Set(12, 11.0)};
  return all;
}

LateralRunUp::LateralRunUp(const LateralRotor& rotor, double h)
    : rotor_(rotor),
      h_(h),
      alike_(rotor.damping[0] == rotor.damping[1] && rotor.stiffness[0] == rotor.stiffness[1]),
      plain_(alike_ && rotor.coupling == 0.0 && rotor.coupling_slope == 0.0),
      sets_(&sets()),
      fastest_(rotor.fastest()),
      flexibility_(1.0 / std::sqrt(std::min(rotor.stiffness[0], rotor.stiffness[1]))),
      nanoseconds_(std::llround(h * 1e9)) {
  if (std::fabs(static_cast<double>(nanoseconds_) - h * 1e9) > 1e-9) {
    nanoseconds_ = 0;
  }
  for (std::size_t set = 0; set < kSets; ++set) {
    fastest_turn_[set] = (*sets_)[set].reach / h - fastest_;
    whole_[set] = room();
    prepare(*whole_[set], set, h);
  }
  for (std::unique_ptr<Weights>& other : other_) {
    other = room();
  }
}

std::unique_ptr<LateralRunUp::Weights> LateralRunUp::room() const {
  auto weights = std::make_unique<Weights>();
  if (!alike_) {
    weights->second = std::make_unique<LateralGaussWeights>();
  }
  return weights;
}

void LateralRunUp::prepare(LateralGaussWeights& axis, std::size_t of, const Set& set,
                           double length) const noexcept {
  const GaussStretches& stretches = set.stretches;
  const std::size_t count = stretches.nodes.count();
  const auto free = [&](double t) {
    return freeOscillation(rotor_.damping[of], rotor_.stiffness[of], t);
  };
  const auto rate = [&](std::size_t column, std::size_t row) -> double& {
    return axis.rates[column * (count + 4) + row];
  };
  const auto deflection = [&](std::size_t column, std::size_t row) -> double& {
    return axis.deflections[column * count + row];
  };
  axis.rates.fill(0.0);
  axis.deflections.fill(0.0);
  for (std::size_t j = 0; j < count; ++j) {
    const double to_node = stretches.nodes.nodes[j] * length;
    const FreeOscillation moved = free(to_node);
    rate(count, j) = moved.rate_by_place;
    rate(count + 1, j) = 1.0 + moved.by_rate;
    deflection(count, j) = 1.0 + moved.by_place;
    deflection(count + 1, j) = moved.place_by_rate;
    for (std::size_t q = 0; q < stretches.points.count(); ++q) {
      const FreeOscillation rest = free((1.0 - stretches.points.nodes[q]) * to_node);
      for (std::size_t k = 0; k < count; ++k) {
        const double share = to_node * stretches.share(j, q, k);
        rate(k, j) += share * (1.0 + rest.by_rate);
        deflection(k, j) += share * rest.place_by_rate;
      }
    }
    const FreeOscillation rest = free((1.0 - stretches.nodes.nodes[j]) * length);
    const double share = stretches.nodes.weights[j] * length;
    rate(j, count) = share * rest.place_by_rate;
    rate(j, count + 1) = share * (1.0 + rest.by_rate);
  }
  const FreeOscillation moved = free(length);
  rate(count, count) = moved.by_place;
  rate(count, count + 1) = moved.rate_by_place;
  rate(count + 1, count) = moved.place_by_rate;
  rate(count + 1, count + 1) = moved.by_rate;
}

void LateralRunUp::prepare(Weights& weights, std::size_t set, double length) const noexcept {
  weights.length = length;
  weights.set = set;
  prepare(weights.first, 0, (*sets_)[set], length);
  if (!alike_) {
    prepare(*weights.second, 1, (*sets_)[set], length);
  }
}

const LateralRunUp::Weights& LateralRunUp::weightsFor(std::size_t set, double length) noexcept {
  if (length == h_) {
    return *whole_[set];
  }
  for (const std::unique_ptr<Weights>& other : other_) {
    if (other->length == length && other->set == set) {
      return *other;
    }
  }
  Weights& restarted = *other_[oldest_];
  oldest_ = (oldest_ + 1) % other_.size();
  prepare(restarted, set, length);
  return restarted;
}

/// How far the coupling bends what it acts on within a length, in parts of the deflection.
double LateralRunUp::couplingWithin(double highest_speed, double length) const noexcept {
  const double coupling =
      std::fabs(rotor_.coupling) + std::fabs(rotor_.coupling_slope) * highest_speed;
  const double impulse = 0.5 * length < flexibility_ ? 0.5 * length : flexibility_;
  return coupling * length * impulse;
}

/// Of a step of h from the drive's begin(). The first of many does without phasors: steps may not
/// follow one another.
PhasorUse LateralRunUp::beginOrNot(const Drive& drive, const ShaftMotion& start,
                                   std::size_t set) noexcept {
  const bool follow = follows(drive) && nanoseconds_ > 0 && start.jerk == 0.0;
  goTo(drive);
  turns_left_ = 0;
  if (!follow) {
    return PhasorUse::kNone;
  }
  if (!(start.acceleration == begun_.acceleration)) {
    const SineCosine growth = sineCosine(start.acceleration * h_ * h_);
    phasors_.growth_cosine = growth.cosine;
    phasors_.growth_sine = growth.sine;
  }
  begun_ = start;
  of_set_ = set;
  turns_left_ = NodePhasors::kSteps;
  return PhasorUse::kBegin;
}

StepStatus LateralRunUp::advance(const Drive& drive, double offset, double length,
                                 LateralMotion& motion) noexcept {
  const bool whole = offset == 0.0 && length == h_;
  const std::optional<double> speed = whole ? speedAt(drive) : std::nullopt;
  ShaftMotion start = speed ? ShaftMotion{0.0, *speed, begun_.acceleration, 0.0} : drive.at(offset);
  const double fastest_turn =
      std::fabs(start.speed) +
      length * (std::fabs(start.acceleration) + 0.5 * length * std::fabs(start.jerk));
  const double reach = (fastest_ + fastest_turn) * length;
  int parts = 1;
  double coupled = couplingWithin(fastest_turn, length);
  while (!(reach <= parts * sets_->back().reach && coupled <= kMaxCoupling)) {
    parts *= 2;
    if (parts > kMaxPartsOfRunUp) {
      return StepStatus::kOutOfRange;
    }
    coupled = couplingWithin(fastest_turn, length / parts);
  }
  std::size_t set = 0;
  while (reach > parts * (*sets_)[set].reach) {
    ++set;
  }
  int sweeps = 0;
  for (double left = coupled; left > kSwept && sweeps < kMaxSweeps; left *= coupled / sweeps) {
    ++sweeps;
  }
  const Set& nodes = (*sets_)[set];
  const Weights& weights = weightsFor(set, length / parts);
  PhasorUse use = PhasorUse::kNone;
  if (speed && parts == 1 && set == of_set_) {
    use = PhasorUse::kGoOn;
    --turns_left_;
    goTo(drive);
  } else {
    start = drive.at(offset);
    use = whole && parts == 1 ? beginOrNot(drive, start, set) : PhasorUse::kNone;
  }
  for (int i = 0; i < parts; ++i) {
    const LateralGaussStep step{rotor_,
                                nodes.nodes.data(),
                                nodes.weights.data(),
                                {&weights.first, alike_ ? &weights.first : weights.second.get()},
                                weights.length,
                                i == 0 ? start : drive.at(offset + i * weights.length),
                                sweeps,
                                motion.y,
                                use,
                                phasors_};
    LateralGaussResult result;
    nodes.take(step, result);
    motion.advance(result.increment, result.work);
  }
  return StepStatus::kOk;
}

}  // namespace whirl_twin
