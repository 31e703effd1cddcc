#include <algorithm>
#include <cmath>
#include <exception>

#include "algebra/constants.h"
#include "analysis/characteristic_polynomial.h"
#include "analysis/linearized_motion.h"
#include "analysis/routh.h"
#include "analysis/stability.h"
#include "messages/input_error.h"
#include "monitoring/parameter_margins.h"
#include "scene/driven_dynamics.h"
#include "scene/ensemble_draw.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMembers = 1000;
constexpr std::size_t kMaxCorners = 8;      // numbers: 256 corners
constexpr double kDeviationsOfBox = 3.0;    // of a normal spread
constexpr double kFirstStride = 0.5;        // of half a side
constexpr double kLastStride = 1.0 / 64.0;  // likewise

/// A system as some values of its numbers make it.
struct Place {
  double decay_rate = 0.0;  // [1/s]
  LinearizedMotion small;
};

class Box {
 public:
  Box(const BuiltSystem& system, const SteadyMotion& motion, double speed)
      : system_(system), motion_(motion), speed_(speed) {
    momenta_ = system.dynamics->momenta(motion.q, motion.v, {0.0, 0.0, speed, 0.0});
    for (const Spread& spread : system.spec.ensemble.spread) {
      centre_.push_back(centreOf(spread, system.spec, *system.model));
      const bool counts = spread.kind == Spread::Kind::kParameter;
      half_.push_back(counts ? spread.width * (spread.normal ? kDeviationsOfBox : 1.0) : 0.0);
      if (counts) {
        sides_.push_back(half_.size() - 1);
      }
    }
  }

  const std::vector<std::size_t>& sides() const { return sides_; }
  std::size_t numbers() const { return centre_.size(); }

  /// Of a member; nothing where the model cannot have it, or is one of another kind.
  std::optional<Place> at(const SystemSpec& spec) const {
    try {
      const auto dynamics = judgedDynamics(
          system_.model->setUp(spec.parameters, spec.settings, system_.spec.setup->around).dynamics,
          spec);
      if (dynamics->dof() != system_.dynamics->dof()) {
        return std::nullopt;
      }
      const CyclicCoordinates cyclic = cyclicCoordinates(*dynamics, speed_);
      const std::optional<SteadyMotion> motion =
          dynamics->linear() ? motion_
                             : steadyMotionNear(*dynamics, cyclic, motion_, momenta_, speed_);
      if (!motion) {
        return Place{-kInfinity, {}};
      }
      auto small = linearizedMotionAbout(*dynamics, cyclic, *motion, speed_);
      if (!small) {
        return Place{-kInfinity, {}};
      }
      Place place;
      place.small = std::move(*small);
      const double decay = -fastestGrowing(place.small).real();
      place.decay_rate = surelyUnstable(place.small) ? decay : std::fmax(decay, 0.0);
      return place;
    } catch (const std::exception&) {  // numbers that do not fit together, or beyond a double
      return std::nullopt;
    }
  }

  /// At a place of the box, each of its numbers from -1 to 1.
  std::optional<Place> at(const std::vector<double>& place) const {
    std::vector<double> independent(centre_.size(), 0.0);
    for (const std::size_t i : sides_) {
      independent[i] = place[i] * half_[i];
    }
    std::vector<double> values = correlated(system_.spec.ensemble, independent);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] += centre_[i];
    }
    const std::optional<SystemSpec> spec = memberAt(system_.spec, *system_.model, values);
    return spec ? at(*spec) : std::nullopt;
  }

  /// Where these values are; nothing outside.
  std::optional<std::vector<double>> placeOf(const std::vector<double>& values) const {
    std::vector<double> deviations(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      deviations[i] = values[i] - centre_[i];
    }
    const std::vector<double> apart = independent(system_.spec.ensemble, deviations);
    std::vector<double> place(values.size(), 0.0);
    for (const std::size_t i : sides_) {
      place[i] = apart[i] / half_[i];
      if (std::fabs(place[i]) > 1.0) {
        return std::nullopt;
      }
    }
    return place;
  }

 private:
  const BuiltSystem& system_;
  const SteadyMotion& motion_;
  double speed_;
  Eigen::VectorXd momenta_;
  std::vector<double> centre_, half_;  // of all numbers that are spread
  std::vector<std::size_t> sides_;     // those that are numbers of the model
};

/// What the coefficients of characteristic polynomials span.
class CoefficientIntervals {
 public:
  void add(const LinearizedMotion& small) {
    const Eigen::Index coordinates = small.matrices.mass.rows();
    if (small.periodic || small.zeros > 0 || coordinates == 0 ||  // roots that are set aside
        coordinates > kMaxExactCoordinates) {
      usable_ = false;
      return;
    }
    const std::vector<Rational> exact = characteristicPolynomial(small.matrices);
    std::vector<double> polynomial;
    for (const Rational& coefficient : exact) {
      polynomial.push_back(coefficient.convert_to<double>());
      usable_ = usable_ && std::isfinite(polynomial.back());
    }
    if (low_.empty()) {
      low_ = high_ = polynomial;
    }
    usable_ = usable_ && polynomial.size() == low_.size();
    for (std::size_t k = 0; usable_ && k < polynomial.size(); ++k) {
      low_[k] = std::fmin(low_[k], polynomial[k]);
      high_[k] = std::fmax(high_[k], polynomial[k]);
    }
  }
  void spoil() { usable_ = false; }

  /// Do Kharitonov's four polynomials decay? From the lowest power on, two low, two high, and so
  /// on, from each of the four beginnings. Not as far as is known where exact numbers become too
  /// long.
  bool decayThroughout() const {
    if (!usable_ || low_.empty()) {
      return false;
    }
    ExactBudget budget(kMaxExactProducts);
    for (std::size_t beginning = 0; beginning < 4; ++beginning) {
      std::vector<Rational> polynomial(low_.size());
      for (std::size_t power = 0; power < low_.size(); ++power) {
        const std::size_t k = low_.size() - 1 - power;
        polynomial[k] = Rational((power + beginning) % 4 < 2 ? low_[k] : high_[k]);
      }
      try {
        if (routh(polynomial, budget).verdict != Verdict::kAsymptoticallyStable) {
          return false;
        }
      } catch (const ExactBudgetSpent&) {
        return false;
      }
    }
    return true;
  }

 private:
  std::vector<double> low_, high_;
  bool usable_ = true;
};

/// From a place on, number by number, to where no stride makes the decay slower.
double lowestNear(const Box& box, std::vector<double> place, double lowest,
                  const std::function<bool()>& given_up) {
  for (double stride = kFirstStride; stride >= kLastStride && !given_up();) {
    bool moved = false;
    for (const std::size_t i : box.sides()) {
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> next = place;
        next[i] = std::clamp(place[i] + sign * stride, -1.0, 1.0);
        const std::optional<Place> there = box.at(next);
        if (there && there->decay_rate < lowest) {
          lowest = there->decay_rate;
          place = next;
          moved = true;
        }
      }
    }
    stride *= moved ? 1.0 : 0.5;
  }
  return lowest;
}

}  // namespace

std::size_t RobustStabilityMargin::beyond(double decay_rate) const {
  return static_cast<std::size_t>(
      std::lower_bound(decay_rates.begin(), decay_rates.end(), decay_rate) - decay_rates.begin());
}

std::optional<RobustStabilityMargin> robustStabilityMargin(const BuiltSystem& system,
                                                           const SteadyMotion& motion, double speed,
                                                           const std::function<bool()>& given_up) {
  const Box box(system, motion, speed);
  if (box.sides().empty() || !isQuickToSearch(system)) {
    return std::nullopt;
  }
  RobustStabilityMargin margin;
  margin.lowest_decay_rate = kInfinity;
  std::vector<double> slowest(box.numbers(), 0.0);
  double slowest_rate = kInfinity;
  const auto compare = [&](const std::vector<double>& place, double decay_rate) {
    margin.lowest_decay_rate = std::fmin(margin.lowest_decay_rate, decay_rate);
    if (decay_rate < slowest_rate) {
      slowest_rate = decay_rate;
      slowest = place;
    }
  };

  for (std::size_t i = 0; i < kMembers; ++i) {
    if (given_up()) {
      return std::nullopt;
    }
    DrawnMember member;
    try {
      member = drawnMember(system.spec, *system.model, i);
    } catch (const InputError&) {  // a change has brought it to the end of its range
      return std::nullopt;
    }
    if (const std::optional<Place> there = box.at(member.spec)) {
      margin.decay_rates.push_back(there->decay_rate);
      if (const auto place = box.placeOf(member.values)) {
        compare(*place, there->decay_rate);
      }
      margin.lowest_decay_rate = std::fmin(margin.lowest_decay_rate, there->decay_rate);
    }
  }
  std::sort(margin.decay_rates.begin(), margin.decay_rates.end());

  CoefficientIntervals intervals;
  if (box.sides().size() > kMaxCorners) {
    intervals.spoil();
  } else {
    for (std::size_t corner = 0; corner < std::size_t{1} << box.sides().size(); ++corner) {
      std::vector<double> place(box.numbers(), 0.0);
      for (std::size_t k = 0; k < box.sides().size(); ++k) {
        place[box.sides()[k]] = (corner >> k & 1U) != 0 ? 1.0 : -1.0;
      }
      const std::optional<Place> there = given_up() ? std::nullopt : box.at(place);
      if (there && there->decay_rate > -kInfinity) {
        intervals.add(there->small);
      } else {
        intervals.spoil();
      }
      if (there) {
        compare(place, there->decay_rate);
      }
    }
  }
  if (!std::isfinite(slowest_rate) || margin.decay_rates.empty()) {
    return slowest_rate == -kInfinity ? std::optional(margin) : std::nullopt;
  }
  margin.lowest_decay_rate =
      std::fmin(margin.lowest_decay_rate, lowestNear(box, slowest, slowest_rate, given_up));
  margin.stable_throughout = margin.lowest_decay_rate > 0.0 && intervals.decayThroughout();
  return given_up() ? std::nullopt : std::optional(margin);
}

}  // namespace whirl_twin
