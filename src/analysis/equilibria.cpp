#include "analysis/equilibria.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"
#include "analysis/natural_modes.h"
#include "analysis/steady_motion.h"

namespace whirl_twin {

namespace {

constexpr int kMaxCorrections = 40;   // at a point of the path
constexpr int kMaxRestrictions = 60;  // halvings of a step that leaves the bounds
constexpr int kMaxPathSteps = 2000;
constexpr double kMinPathStep = 1.0e-7;
constexpr double kKept = 0.1;         // minimum fraction of the clearance retained in a step
constexpr double kAtRest = 1.0e-14;   // of the place: a step that is none
constexpr double kOnPath = 1.0e-6;    // likewise, of a point on the way
constexpr double kRounding = 1.0e-7;  // likewise, where rounding lets no step be shorter
constexpr double kStalled = 0.5;      // of the step before: one that is no shorter is rounding

bool inside(const Eigen::VectorXd& room) {
  return room.size() == 0 || room.minCoeff() > 0.0;
}

bool keepsRoom(const Eigen::VectorXd& after, const Eigen::VectorXd& before) {
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    if (std::isfinite(before[i]) && !(after[i] > kKept * before[i])) {
      return false;
    }
  }
  return true;
}

/// From y to where the pull is `left`; nothing where Newton's method does not converge.
std::optional<Eigen::VectorXd> corrected(const RestProblem& problem, Eigen::VectorXd y,
                                         const Eigen::VectorXd& left, double tolerance) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxCorrections; ++i) {
    Eigen::VectorXd step = problem.step(y, problem.pull(y) - left);
    if (!step.allFinite()) {
      return std::nullopt;
    }
    const Eigen::VectorXd room = problem.room(y);
    int halvings = 0;
    while (!keepsRoom(problem.room(y + step), room)) {
      step *= 0.5;
      if (++halvings > kMaxRestrictions) {
        return std::nullopt;
      }
    }
    y += step;
    const double length = step.norm();
    const double place = y.norm();
    if (halvings == 0 && (length <= tolerance * place ||
                          (length <= kRounding * place && length >= kStalled * before))) {
      return y;
    }
    before = halvings == 0 ? length : std::numeric_limits<double>::infinity();
  }
  return std::nullopt;
}

}  // namespace

std::optional<Eigen::VectorXd> restWithinBounds(const RestProblem& problem,
                                                const Eigen::VectorXd& start) {
  if (!inside(problem.room(start))) {
    return std::nullopt;
  }
  const Eigen::VectorXd pull = problem.pull(start);
  if (!pull.allFinite()) {
    return std::nullopt;
  }
  Eigen::VectorXd y = start;
  double share = 0.0;
  double stride = 1.0;
  for (int i = 0; i < kMaxPathSteps && stride >= kMinPathStep; ++i) {
    const double next = std::min(1.0, share + stride);
    const bool last = next == 1.0;
    const auto there = corrected(problem, y, (1.0 - next) * pull, last ? kAtRest : kOnPath);
    if (!there) {
      stride *= 0.25;
      continue;
    }
    if (last) {
      return there;
    }
    y = *there;
    share = next;
    stride *= 2.0;
  }
  return std::nullopt;
}

namespace {

constexpr int kStartsPerTurn = 8;
constexpr double kMaxStarts = 4096.5;  // in all: fewer a turn where there are many coordinates
constexpr int kTurnsOfOneSlide = 8;    // searched where a sliding coordinate is the only one
constexpr double kRatesFirst = 1.0e6;
constexpr double kSameEquilibrium = 1.0e-6;  // rad or lengths: closer ones are one

/// Scaled distance of q from p, angles in the shorter direction, without cyclic coordinates.
double distance(const Dynamics& dynamics, const CyclicCoordinates& cyclic, const Eigen::VectorXd& q,
                const Eigen::VectorXd& p) {
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  const Eigen::VectorXd d = (q - p).cwiseQuotient(naturalUnits(dynamics));
  double squares = 0.0;
  for (const Eigen::Index i : cyclic.shape) {
    const bool angle = coordinates[static_cast<std::size_t>(i)].isAngle();
    const double part = angle ? std::remainder(d[i], 2.0 * kPi) : d[i];
    squares += part * part;
  }
  return std::sqrt(squares);
}

/// Angles into (-pi, pi], noise about zero away.
Eigen::VectorXd tidied(const Dynamics& dynamics, Eigen::VectorXd q) {
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  const Eigen::VectorXd unit = naturalUnits(dynamics);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    if (coordinates[static_cast<std::size_t>(i)].isAngle()) {
      q[i] = std::remainder(q[i], 2.0 * kPi);
      if (q[i] < -kPi + 1.0e-12) {
        q[i] = kPi;
      }
    }
    if (std::fabs(q[i]) < 1.0e-12 * unit[i]) {
      q[i] = 0.0;
    }
  }
  return q;
}

/// Starts of Newton's method over one coordinate: round the circle, or as far to both sides.
std::vector<double> starts(const Dynamics& dynamics, Eigen::Index coordinate, std::size_t shapes) {
  const int most = static_cast<int>(std::pow(kMaxStarts, 1.0 / static_cast<double>(shapes)));
  const int a_turn = std::clamp(most, 1, kStartsPerTurn);
  const double unit = naturalUnits(dynamics)[coordinate];
  const bool angle = dynamics.coordinates()[static_cast<std::size_t>(coordinate)].isAngle();
  const int turns = !angle && dynamics.dof() == 1 ? kTurnsOfOneSlide : 1;
  std::vector<double> all;
  for (int i = 0; i < turns * a_turn; ++i) {
    // Off the symmetric points, where Newton's method could rest by accident.
    all.push_back(unit * (0.1 + 2.0 * kPi * i / a_turn - turns * kPi));
  }
  return all;
}

/// All combinations of the starts of each coordinate of the shape.
std::vector<Eigen::VectorXd> grid(const Dynamics& dynamics, const CyclicCoordinates& cyclic) {
  std::vector<Eigen::VectorXd> points{Eigen::VectorXd::Zero(dynamics.dof())};
  // A rotor in nonlinear bearings hangs near their line, and so does one on its motor without its
  // unbalance: there is nothing to search further away.
  if (dynamics.linear() ||
      (dynamics.isRotor() && (cyclic.shape.size() > 2 || !cyclic.driven.empty()))) {
    return points;
  }
  for (const Eigen::Index i : cyclic.shape) {
    std::vector<Eigen::VectorXd> finer;
    for (const double start : starts(dynamics, i, cyclic.shape.size())) {
      for (Eigen::VectorXd point : points) {
        point[i] = start;
        finer.push_back(point);
      }
    }
    points = finer;
  }
  return points;
}

template <class Motion>
bool sameMotion(const Dynamics& dynamics, const CyclicCoordinates& cyclic, const Motion& a,
                const Motion& b) {
  const Eigen::VectorXd v = a.v(cyclic.driven);
  const Eigen::VectorXd w = b.v(cyclic.driven);
  return distance(dynamics, cyclic, a.q, b.q) < kSameEquilibrium &&
         (v - w).norm() <= kSameEquilibrium * v.norm();
}

/// By the multipliers of the periodic motions near by, where coefficients repeat.
void judgePeriodic(const Dynamics& dynamics, const CyclicCoordinates& cyclic, double speed,
                   std::vector<Equilibrium>& all) {
  const TimeDependence time = timeDependence(dynamics, speed);
  if (!time.period) {
    if (time.varies && dynamics.linear()) {  // matrices of one moment
      for (Equilibrium& e : all) {
        e.stability = unjudged();
      }
    }
    return;
  }
  for (Equilibrium& e : all) {
    e.periodic = periodicMotionNear(dynamics, speed, *time.period, {e.q, e.v});
    const auto off = [&](const Equilibrium& other) {
      return distance(dynamics, cyclic, e.periodic->q, other.q);
    };
    // Newton's method may lead to the motion about another equilibrium.
    if (e.periodic && std::any_of(all.begin(), all.end(), [&](const Equilibrium& other) {
          return &other != &e && off(other) < off(e);
        })) {
      e.periodic.reset();
    }
    e.stability = e.periodic ? stabilityOf(*e.periodic, e.stability.eigenvalues) : unjudged();
  }
}

std::vector<Equilibrium> allOf(const Dynamics& dynamics, const CyclicCoordinates& cyclic,
                               double speed, const Eigen::VectorXd& near,
                               const Eigen::VectorXd& momenta, const Eigen::VectorXd& rates) {
  std::vector<SteadyMotion> found;
  // Driven coordinates are started at the rates they have, slower and faster.
  const std::vector<double> shares = cyclic.driven.empty()
                                         ? std::vector<double>{1.0}
                                         : std::vector<double>{1.0, 0.3, 3.0, 30.0, 300.0};
  std::vector<Eigen::VectorXd> points = grid(dynamics, cyclic);
  points.push_back(near);
  for (const Eigen::VectorXd& start : points) {
    for (const double share : shares) {
      auto motion = steadyMotionNear(dynamics, cyclic, {start, share * rates}, momenta, speed);
      if (!motion) {
        continue;
      }
      motion->q = tidied(dynamics, motion->q);
      if (std::none_of(found.begin(), found.end(), [&](const SteadyMotion& other) {
            return sameMotion(dynamics, cyclic, *motion, other);
          })) {
        found.push_back(*motion);
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const SteadyMotion& a, const SteadyMotion& b) {
    return std::lexicographical_compare(a.q.data(), a.q.data() + a.q.size(), b.q.data(),
                                        b.q.data() + b.q.size());
  });
  std::vector<Equilibrium> all;
  for (const SteadyMotion& motion : found) {
    const Linearization l = linearizationAbout(dynamics, motion.q, motion.v, speed);
    if (l.mass.diagonal().minCoeff() > 0.0) {
      all.push_back({motion.q, motion.v, reducedStability(l, cyclic)});
    }
  }
  judgePeriodic(dynamics, cyclic, speed, all);
  return all;
}

}  // namespace

Linearization linearizationAbout(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& v, double speed) {
  return dynamics.atMeanLoad().linearization(q, v, Eigen::VectorXd::Zero(q.size()),
                                             {0.0, 0.0, speed, 0.0});
}

Linearization linearizationAtRest(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                  double speed) {
  return linearizationAbout(dynamics, q, Eigen::VectorXd::Zero(dynamics.dof()), speed);
}

std::optional<Eigen::VectorXd> equilibriumNear(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                               double speed) {
  CyclicCoordinates held;  // none of them may move
  held.basis = Eigen::MatrixXd::Identity(q.size(), q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    held.shape.push_back(i);
  }
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(q.size());
  const auto motion = steadyMotionNear(dynamics, held, {q, rest}, rest, speed);
  return motion ? std::optional<Eigen::VectorXd>(motion->q) : std::nullopt;
}

std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed,
                                    const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  return allOf(dynamics, cyclicCoordinates(dynamics, speed), speed, q,
               dynamics.momenta(q, v, {0.0, 0.0, speed, 0.0}), v);
}

std::vector<Equilibrium> equilibria(const Dynamics& dynamics, double speed) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  return allOf(dynamics, cyclicCoordinates(dynamics, speed), speed, zero, zero, zero);
}

bool isUnsupported(const Dynamics& dynamics, double speed) {
  return dynamics.linear() && equilibria(dynamics, speed).empty();
}

bool same(const Dynamics& dynamics, const CyclicCoordinates& cyclic, const Equilibrium& a,
          const Equilibrium& b) {
  return sameMotion(dynamics, cyclic, a, b);
}

std::optional<Equilibrium> operatingPoint(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                          const Eigen::VectorXd& v, double speed) {
  return operatingPointAmong(dynamics, equilibria(dynamics, speed, q, v), q, v, speed);
}

Stability unjudged() {
  Stability s;
  s.routh.verdict = Verdict::kUncertain;
  s.decay_rate = s.damping_ratio = s.log_decrement = kNaN;
  return s;
}

std::optional<Equilibrium> operatingPointAmong(const Dynamics& dynamics,
                                               std::vector<Equilibrium> known,
                                               const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                               double speed) {
  const CyclicCoordinates cyclic = cyclicCoordinates(dynamics, speed);
  const Eigen::VectorXd momenta = dynamics.momenta(q, v, {0.0, 0.0, speed, 0.0});
  const auto first_unbounded = std::stable_partition(
      known.begin(), known.end(), [](const Equilibrium& e) { return e.stability.bounded(); });
  const bool periodic = std::any_of(known.begin(), known.end(),
                                    [](const Equilibrium& e) { return e.periodic.has_value(); });
  // A rotor that is unstable in its films still whirls about its equilibrium, and an oscillator
  // that excites itself swings about it.
  if (!periodic && (first_unbounded != known.begin() || dynamics.linear())) {
    known.erase(first_unbounded, known.end());
  }
  Eigen::VectorXd from = q;
  if (known.size() > 1) {
    if (const auto settled = creepsTo(dynamics, cyclic, {q, v}, momenta, speed)) {
      from = settled->q;
    }
  }
  std::optional<Equilibrium> nearest;
  double nearest_distance = 0.0;
  for (const Equilibrium& e : known) {
    // Where rates are driven the nearest rate decides, then the shape.
    const Eigen::VectorXd now = v(cyclic.driven);
    const Eigen::VectorXd then = e.v(cyclic.driven);
    const double off = (then - now).norm() / (1.0e-300 + now.norm() + then.norm());
    const double d = distance(dynamics, cyclic, e.q, from) + kRatesFirst * off;
    if (!nearest || d < nearest_distance) {
      nearest = e;
      nearest_distance = d;
    }
  }
  return nearest;
}

}  // namespace whirl_twin
