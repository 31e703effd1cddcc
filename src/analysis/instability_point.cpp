#include "analysis/instability_point.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "analysis/cyclic_coordinates.h"
#include "analysis/linearized_motion.h"

namespace whirl_twin {

namespace {

constexpr double kClosedIn = 1.0e-9;  // of the number
constexpr int kMaxBisections = 60;
/// Exact tests of more coordinates take longer than all the rest of a search.
constexpr Eigen::Index kMaxExactHere = 4;
constexpr double kShortest = 1.0e-3;  // of a stride: where shorter ones lead nowhere, nothing does
constexpr double kBeyond = 1.0e-3;    // of a stride: where the root that left is away from the axis

/// A point of the continuation.
struct Passed {
  double value = 0.0;
  SteadyMotion motion;
  LinearizedMotion small;
};

/// The result at the next value.
struct Next {
  bool allowed = false;         ///< the number can have that value
  std::optional<Passed> place;  ///< nothing where no steady motion is near
};

class Way {
 public:
  Way(const SystemOfNumber& system, double value, const SteadyMotion& motion) : system_(system) {
    const std::optional<SystemAtNumber> start = system_(value);
    if (start) {
      momenta_ = start->dynamics->momenta(motion.q, motion.v, {0.0, 0.0, start->speed, 0.0});
      start_ = passed(*start, value, motion);
    }
  }

  const std::optional<Passed>& start() const { return start_; }

  /// Starts the continuation at a point.
  Next follow(const Passed& from, double value) const {
    const std::optional<SystemAtNumber> system = system_(value);
    if (!system) {
      return {};
    }
    if (system->dynamics->linear()) {  // the same wherever it is
      return {true, passed(*system, value, from.motion)};
    }
    const auto motion =
        steadyMotionNear(*system->dynamics, cyclicCoordinates(*system->dynamics, system->speed),
                         from.motion, momenta_, system->speed);
    return {true, motion ? passed(*system, value, *motion, from.small.periodic) : std::nullopt};
  }

 private:
  static std::optional<Passed> passed(const SystemAtNumber& system, double value,
                                      const SteadyMotion& motion,
                                      const std::optional<PeriodicMotion>& near = {}) {
    const CyclicCoordinates cyclic = cyclicCoordinates(*system.dynamics, system.speed);
    auto small = linearizedMotionAbout(*system.dynamics, cyclic, motion, system.speed, near);
    return small ? std::optional<Passed>({value, motion, std::move(*small)}) : std::nullopt;
  }

  const SystemOfNumber& system_;
  Eigen::VectorXd momenta_;
  std::optional<Passed> start_;
};

/// Continues from the last point to a value, with as many shorter steps as Newton's method needs;
/// intermediate points are stored. Stops earlier where the motion is certainly unstable.
Next reach(const Way& way, std::vector<Passed>& passed, double value) {
  const double whole = value - passed.back().value;
  double stride = whole;
  while (true) {
    const double from = passed.back().value;
    const bool last = std::fabs(value - from) <= std::fabs(stride);
    Next next = way.follow(passed.back(), last ? value : from + stride);
    if (next.place && !last && !surelyUnstable(next.place->small)) {
      passed.push_back(std::move(*next.place));
    } else if (next.allowed && !next.place && std::fabs(stride) > kShortest * std::fabs(whole)) {
      stride *= 0.5;
    } else {
      return next;
    }
  }
}

/// Bisection between a stable point and a value beyond which the motion is unstable.
InstabilityPoint closeIn(const Way& way, GrowthTest& test, Passed low, double lost) {
  std::optional<Passed> high = way.follow(low, lost).place;
  double high_value = lost;
  for (int i = 0; i < kMaxBisections; ++i) {
    const double middle = 0.5 * (low.value + high_value);
    const double size = std::fmax(std::fabs(low.value), std::fabs(high_value));
    if (std::fabs(high_value - low.value) <= kClosedIn * size || middle == low.value ||
        middle == high_value) {
      break;
    }
    std::optional<Passed> next = way.follow(low, middle).place;
    if (!next || test.unstable(next->small)) {
      high_value = middle;
      high = std::move(next);
    } else {
      low = std::move(*next);
    }
  }
  InstabilityPoint loss;
  loss.value = 0.5 * (low.value + high_value);
  if (!high) {
    loss.kind = LossKind::kNoMotion;
    return loss;
  }
  // At the threshold itself rounding may split a double zero into a pair.
  const auto beyond = way.follow(*high, high_value + kBeyond * (lost - high_value)).place;
  std::complex<double> root = beyond ? fastestGrowing(beyond->small) : 0.0;
  if (root.real() <= 0.0) {
    root = fastestGrowing(high->small);
  }
  if (root.imag() != 0.0) {
    loss.kind = LossKind::kFlutter;
    const std::complex<double> there = fastestGrowing(high->small);
    loss.frequency = std::fabs((there.imag() != 0.0 ? there : root).imag());
  }
  return loss;
}

bool equal(const LinearizedMotion& a, const LinearizedMotion& b) {
  const Linearization& l = a.matrices;
  const Linearization& m = b.matrices;
  if (a.periodic || b.periodic) {
    return a.periodic && b.periodic && a.periodic->multipliers == b.periodic->multipliers;
  }
  return a.zeros == b.zeros && l.mass.rows() == m.mass.rows() && l.mass == m.mass &&
         l.damping == m.damping && l.gyroscopic == m.gyroscopic && l.stiffness == m.stiffness &&
         l.circulatory == m.circulatory;
}

}  // namespace

std::optional<InstabilityPoint> lossAlong(const SystemOfNumber& system, double value,
                                          const SteadyMotion& motion,
                                          const std::vector<double>& strides) {
  const Way way(system, value, motion);
  if (!way.start()) {
    return std::nullopt;
  }
  std::vector<Passed> passed{*way.start()};
  GrowthTest test(kMaxExactHere);
  for (const double next_value : strides) {
    Next next = reach(way, passed, next_value);
    if (!next.allowed) {
      return std::nullopt;
    }
    if (next.place && !surelyUnstable(next.place->small)) {
      passed.push_back(std::move(*next.place));
      continue;
    }
    // Points with inconclusive slow growth have been passed too: Routh's test removes them.
    double lost = next.place ? next.place->value : next_value;
    while (passed.size() > 1 && test.unstable(passed.back().small)) {
      lost = passed.back().value;
      passed.pop_back();
    }
    return closeIn(way, test, std::move(passed.back()), lost);
  }
  return std::nullopt;
}

bool isWithoutEffect(const SystemOfNumber& system, double value, const SteadyMotion& motion,
                     const std::vector<double>& values) {
  const Way way(system, value, motion);
  return way.start() && std::all_of(values.begin(), values.end(), [&](double other) {
           const Next there = way.follow(*way.start(), other);
           return !there.allowed || (there.place && equal(there.place->small, way.start()->small));
         });
}

}  // namespace whirl_twin
