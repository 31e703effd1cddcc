#include "independent_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "scene/built_scene.h"

namespace whirl_twin {

namespace {

using Eigen::VectorXd;
/// Extended precision (64-bit significand): the rounding of the reference is far below the twin's.
using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr int kColumns = 8;  // order 16
constexpr double kFine = 1.0e-16;
constexpr double kCoarse = 1.0e-14;
/// Of forces that are not rounded to doubles.
constexpr double kFineByHand = 3.0e-18;
constexpr double kCoarseByHand = 3.0e-16;
/// The two runs take other steps, so that their rounding differs, too.
constexpr double kOtherStep = 0.37;
constexpr double kMinStep = 1.0e-12;  // s
/// If the force has a breakpoint at a step's start, the even and the odd nodes of the midpoint rule
/// follow two different smooth curves, and all columns converge to a wrong motion. Tolerance for
/// the deviation of the rates of two neighbouring nodes from the trapezoidal rule, relative to the
/// largest acceleration.
constexpr Real kRough = 0.25L;

struct State {
  Vector q, v;
};

/// Two point masses on massless rods, written out by hand: chaotic, so that forces rounded to
/// doubles would make its motion another one.
class PlainDoublePendulum {
 public:
  explicit PlainDoublePendulum(const Scene& one) {
    const SystemSpec& spec = one.systems.front();
    const auto coordinates = spec.settings.choices.find("coordinates");
    is_it_ = spec.model == "double_pendulum" &&
             (coordinates == spec.settings.choices.end() || coordinates->second == "absolute");
    const std::map<std::string, Real*> own{
        {"mass1", &m1_}, {"mass2", &m2_}, {"length1", &l1_}, {"length2", &l2_}};
    for (const auto& [name, value] : spec.parameters) {
      if (own.count(name) != 0) {
        *own.at(name) = value;
      }
    }
    // Accepts parameters left out of a scene, or equal to their defaults: masses at the ends, and
    // zero friction, motors and air drag.
    const std::map<std::string, Real> plain{{"center1", l1_}, {"center2", l2_}};
    for (const auto& [name, value] : spec.parameters) {
      if (plain.count(name) != 0) {
        is_it_ = is_it_ && value == plain.at(name);
      } else if (own.count(name) == 0 && name != "coulomb_rate" && name.rfind("gear_ratio") != 0 &&
                 name.rfind("drag_reach") != 0) {
        is_it_ = is_it_ && value == 0.0;
      }
    }
    g_ = one.gravity;
  }
  bool isIt() const { return is_it_; }

  Vector acceleration(const State& y) const {
    const Real a = (m1_ + m2_) * l1_ * l1_;
    const Real b = m2_ * l2_ * l2_;
    const Real coupling = m2_ * l1_ * l2_;
    const Real c = coupling * std::cos(y.q[0] - y.q[1]);
    const Real s = coupling * std::sin(y.q[0] - y.q[1]);
    const Real f1 = -s * y.v[1] * y.v[1] - (m1_ + m2_) * g_ * l1_ * std::sin(y.q[0]);
    const Real f2 = s * y.v[0] * y.v[0] - m2_ * g_ * l2_ * std::sin(y.q[1]);
    const Real determinant = a * b - c * c;
    Vector acceleration(2);
    acceleration << (b * f1 - c * f2) / determinant, (a * f2 - c * f1) / determinant;
    return acceleration;
  }

 private:
  bool is_it_ = false;
  Real m1_ = 0.0L, m2_ = 0.0L, l1_ = 0.0L, l2_ = 0.0L, g_ = 0.0L;
};

class Extrapolation {
 public:
  /// longest: of a step, relative to the interval.
  Extrapolation(const Scene& one, double tolerance, double longest, double evaluations)
      : built_(build(one)),
        dynamics_(*built_.systems.front()->dynamics),
        drive_(built_.drives()[built_.systems.front()->drive]),
        tolerance_(tolerance),
        longest_(longest),
        by_hand_(one),
        left_(evaluations) {}

  Trajectory run(std::int64_t interval, std::size_t samples) {
    const SystemSpec& spec = built_.scene.systems.front();
    const auto n = static_cast<Eigen::Index>(spec.q.size());
    State y{Eigen::Map<const VectorXd>(spec.q.data(), n).cast<Real>(),
            Eigen::Map<const VectorXd>(spec.v.data(), n).cast<Real>()};
    Trajectory t;
    t.interval = 1.0e-9 * static_cast<double>(interval);
    t.dof = spec.q.size();
    for (const CoordinateInfo& c : dynamics_.coordinates()) {
      t.angular.push_back(c.isAngle());
    }
    q_size_ = y.q.cwiseAbs();
    v_size_ = y.v.cwiseAbs();
    step_ = t.interval;
    for (std::size_t k = 0; k < samples; ++k) {
      if (k > 0 && !advance(built_.scene.time + static_cast<std::int64_t>(k - 1) * interval,
                            t.interval, y)) {
        break;
      }
      for (Eigen::Index i = 0; i < n; ++i) {
        t.coordinates.push_back(static_cast<double>(y.q[i]));
        t.rates.push_back(static_cast<double>(y.v[i]));
      }
    }
    return t;
  }

 private:
  /// Advances from an instant [ns] by a duration [s], from breakpoint to breakpoint of the drive.
  bool advance(std::int64_t from, double duration, State& y) {
    drive_.begin(from);
    time_ = 1.0e-9 * static_cast<double>(from);
    double offset = 0.0;
    while (offset < duration) {
      const double corner = std::min(duration, drive_.nextCorner(offset));
      const double h = std::min({step_, longest_ * duration, corner - offset});
      const bool last = h >= (corner - offset) * (1.0 - 1.0e-12);
      State next = y;
      const double error = extrapolated(offset, h, next);
      if (left_ < 0.0 || h < kMinStep) {
        return false;
      }
      const double factor = std::clamp(0.9 * std::pow(error, -1.0 / (2 * kColumns - 1)), 0.1, 3.0);
      if (!(error <= 1.0)) {
        step_ = h * (std::isfinite(error) ? factor : 0.1);
        continue;
      }
      y = next;
      q_size_ = q_size_.cwiseMax(y.q.cwiseAbs());
      v_size_ = v_size_.cwiseMax(y.v.cwiseAbs());
      offset = last ? std::nextafter(corner, 2.0 * duration) : offset + h;
      step_ = last ? std::max(step_, h * factor) : h * factor;
    }
    return true;
  }

  Vector acceleration(const State& y, double offset) {
    left_ -= 1.0;
    if (by_hand_.isIt()) {
      return by_hand_.acceleration(y);
    }
    const ShaftMotion shaft = drive_.at(offset);
    return dynamics_
        .acceleration(y.q.cast<double>(), y.v.cast<double>(),
                      {time_ + offset, shaft.angle, shaft.speed, shaft.acceleration})
        .cast<Real>();
  }

  /// Returns the error relative to the tolerance.
  double extrapolated(double offset, double h, State& y) {
    std::array<State, kColumns> row;
    const State start = y;
    const Vector a0 = acceleration(start, offset);
    double error = 0.0;
    for (int k = 0; k < kColumns; ++k) {
      const int n = 2 * (k + 1);
      State next = midpoint(start, a0, offset, static_cast<Real>(h) / n, n);
      for (int j = 0; j < k; ++j) {  // row[j]: column j of the row before
        const Real part = static_cast<Real>(n) / (2 * (k - j));
        const Real ratio = part * part;
        const State better{next.q + (next.q - row[static_cast<std::size_t>(j)].q) / (ratio - 1.0L),
                           next.v + (next.v - row[static_cast<std::size_t>(j)].v) / (ratio - 1.0L)};
        row[static_cast<std::size_t>(j)] = next;
        next = better;
      }
      if (k + 1 == kColumns) {
        error =
            rough_ ? std::numeric_limits<double>::infinity() : distance(next, row[kColumns - 2]);
        y = next;
      }
      row[static_cast<std::size_t>(k)] = next;
    }
    return error / tolerance_;
  }

  State midpoint(const State& start, const Vector& a0, double offset, Real h, int n) {
    State before = start;
    State now{start.q + h * start.v, start.v + h * a0};
    Vector a_before = a0;
    Real jump = 0.0L;
    Real size = a0.cwiseAbs().maxCoeff();
    const auto look = [&](const Vector& a) {
      jump = std::max<Real>(
          jump, (now.v - before.v - 0.5L * h * (a_before + a)).cwiseAbs().maxCoeff() / h);
      size = std::max<Real>(size, a.cwiseAbs().maxCoeff());
      a_before = a;
    };
    for (int i = 1; i < n; ++i) {
      const Vector a = acceleration(now, offset + static_cast<double>(i * h));
      look(a);
      const State next{before.q + 2.0L * h * now.v, before.v + 2.0L * h * a};
      before = now;
      now = next;
    }
    const Vector a = acceleration(now, offset + static_cast<double>(n * h));
    look(a);
    rough_ = jump > kRough * size;
    return {0.5L * (now.q + before.q + h * now.v), 0.5L * (now.v + before.v + h * a)};
  }

  /// Relative to the largest value so far, over all coordinates and rates of a unit.
  double distance(const State& a, const State& b) const {
    double largest = 0.0;
    const Real q = std::max(q_size_.maxCoeff(), a.q.cwiseAbs().maxCoeff());
    const Real v = std::max(v_size_.maxCoeff(), a.v.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < a.q.size(); ++i) {
      const Real off_q = std::fabs(a.q[i] - b.q[i]);
      const Real off_v = std::fabs(a.v[i] - b.v[i]);
      if (!std::isfinite(off_q) || !std::isfinite(off_v)) {
        return std::numeric_limits<double>::infinity();
      }
      const Real part =
          std::max(off_q == 0.0L ? 0.0L : off_q / q, off_v == 0.0L ? 0.0L : off_v / v);
      largest = std::max(largest, static_cast<double>(part));
    }
    return largest;
  }

  BuiltScene built_;
  const Dynamics& dynamics_;
  Drive drive_;
  double tolerance_;
  double longest_;
  PlainDoublePendulum by_hand_;
  double left_;        // evaluations
  double time_ = 0.0;  // [s], of the drive's begin()
  double step_ = 0.0;
  bool rough_ = false;  // the last row of midpoints
  Vector q_size_, v_size_;
};

}  // namespace

IndependentMotion independentMotion(const Scene& one, std::int64_t interval, std::size_t samples,
                                    double evaluations) {
  IndependentMotion m;
  const bool by_hand = PlainDoublePendulum(one).isIt();
  m.trajectory =
      Extrapolation(one, by_hand ? kFineByHand : kFine, 1.0, evaluations).run(interval, samples);
  const Trajectory coarse =
      Extrapolation(one, by_hand ? kCoarseByHand : kCoarse, kOtherStep, evaluations)
          .run(interval, samples);
  m.own = ErrorCurve(coarse, m.trajectory);
  return m;
}

}  // namespace whirl_twin
