#include "integration/shaft_spin.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "mechanics/gradient.h"
#include "mechanics/spinning_rotor.h"

namespace whirl_twin {

namespace {

using Eigen::Index;

constexpr double kRoundingOfSpeed = 1.0e-13;  // of the speed

/// Radau IIA: what rates at the nodes add up to until a node. (Hairer & Wanner, Solving Ordinary
/// Differential Equations II, IV.5)
constexpr std::array<std::array<double, 3>, 3> kSums{
    {{(88.0 - 7.0 * kRoot6) / 360.0, (296.0 - 169.0 * kRoot6) / 1800.0,
      (-2.0 + 3.0 * kRoot6) / 225.0},
     {(296.0 + 169.0 * kRoot6) / 1800.0, (88.0 + 7.0 * kRoot6) / 360.0,
      (-2.0 - 3.0 * kRoot6) / 225.0},
     {(16.0 - kRoot6) / 36.0, (16.0 + kRoot6) / 36.0, 1.0 / 9.0}}};

/// The coefficients of tau, tau^2, tau^3 of the cubic that is 0 at 0, 1 at node j and 0 at the
/// others.
std::array<double, 3> cubicAt(std::size_t j) {
  const double a = kRadauNodes[(j + 1) % 3];
  const double b = kRadauNodes[(j + 2) % 3];
  const double size = kRadauNodes[j] * (kRadauNodes[j] - a) * (kRadauNodes[j] - b);
  return {a * b / size, -(a + b) / size, 1.0 / size};
}

/// Solves a small system in place, with pivots; false where it has no solution.
bool solve(std::array<std::array<double, 3>, 3>& m, std::array<double, 3>& b) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 3; ++i) {
      pivot = std::fabs(m[i][k]) > std::fabs(m[pivot][k]) ? i : pivot;
    }
    std::swap(m[k], m[pivot]);
    std::swap(b[k], b[pivot]);
    if (m[k][k] == 0.0) {
      return false;
    }
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double ratio = m[i][k] / m[k][k];
      for (std::size_t j = k; j < 3; ++j) {
        m[i][j] -= ratio * m[k][j];
      }
      b[i] -= ratio * b[k];
    }
  }
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t j = k + 1; j < 3; ++j) {
      b[k] -= m[k][j] * b[j];
    }
    b[k] /= m[k][k];
  }
  return true;
}

}  // namespace

void SpinMotion::set(double total_angle, double speed_now, double acceleration_now) noexcept {
  *this = SpinMotion{};
  const ShaftAngle start = whirl_twin::shaftAngle(total_angle);
  turns = start.turns;
  angle.high = start.remainder;
  speed.high = speed_now;
  acceleration = acceleration_now;
}

ShaftSpin::ShaftSpin(const LinearRotor& rotor, const SpinCoupling& coupling, double h)
    : h_(h),
      inertia_(coupling.polar_inertia),
      motor_(coupling.motor),
      real_(unbalanceOf(rotor).real()),
      imaginary_(unbalanceOf(rotor).imag()),
      circulatory_(coupling.circulatory),
      resistance_(coupling.resistance),
      turns_damping_((circulatory_.array() != 0.0).any() || (resistance_.array() != 0.0).any()) {
  for (std::size_t j = 0; j < kNodes; ++j) {
    powers_[j] = cubicAt(j);
  }
}

double ShaftSpin::lever(double angle, const LinearMotion& motion) const noexcept {
  const auto v = motion.v();
  return -std::sin(angle) * real_.dot(v) - std::cos(angle) * imaginary_.dot(v);
}

double ShaftSpin::freeAcceleration(double speed) const noexcept {
  return (motor_.torque(speed) - motor_.drag * speed) / inertia_;
}

void ShaftSpin::begin(double offset, const SpinMotion& spin, const LinearMotion& motion) noexcept {
  course_ = {};
  course_.start = offset;
  course_.angle = spin.angle.high;
  course_.speed = spin.speed.high;
  start_lever_ = lever(course_.angle, motion);
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double t = kRadauNodes[i] * h_;
    speeds_[i] =
        course_.speed + t * (spin.acceleration + t * (0.5 * spin.jerk + t * (spin.snap / 6.0)));
  }
  size_ = std::fabs(course_.speed) + h_ * std::fabs(spin.acceleration);
  agrees_ = false;
  bend();
}

void ShaftSpin::bend() noexcept {
  std::array<double, 3> powers{};
  for (std::size_t j = 0; j < kNodes; ++j) {
    const double rise = speeds_[j] - course_.speed;
    for (std::size_t k = 0; k < 3; ++k) {
      powers[k] += rise * powers_[j][k];
    }
  }
  course_.acceleration = powers[0] / h_;
  course_.jerk = 2.0 * powers[1] / (h_ * h_);
  course_.snap = 6.0 * powers[2] / (h_ * h_ * h_);
}

void ShaftSpin::take(std::size_t node, const LinearMotion& motion) noexcept {
  const double w = speeds_[node];
  const double angle = course_.at(course_.start + kRadauNodes[node] * h_).angle;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const auto q = motion.q();
  const auto v = motion.v();
  const double along = real_.dot(v);
  const double across = imaginary_.dot(v);
  const Gradient<double, 1> motor = motor_.torque(Gradient<double, 1>(w, 0));
  Node& out = nodes_[node];
  out.lever = -sine * along - cosine * across;
  out.torque = motor.value - motor_.drag * w;
  out.slope = motor.slope[0] - motor_.drag;
  for (Index i = 0; turns_damping_ && i < q.size(); ++i) {
    const double resisted = resistance_.col(i).dot(q);
    out.torque -= q[i] * (circulatory_.col(i).dot(v) + w * resisted);
    out.slope -= q[i] * resisted;
  }
  const double turned = sine * across - cosine * along;  // (ds/dtheta) . q'
  out.rate = out.torque + w * turned;
  out.slope += turned;
}

bool ShaftSpin::mend() noexcept {
  std::array<std::array<double, 3>, 3> m;
  std::array<double, 3> change;
  for (std::size_t i = 0; i < kNodes; ++i) {
    double gained = start_lever_ - nodes_[i].lever;
    for (std::size_t j = 0; j < kNodes; ++j) {
      const double share = h_ * kSums[i][j];
      gained += share * nodes_[j].rate;
      m[i][j] = (i == j ? 1.0 : 0.0) - share * nodes_[j].slope / inertia_;
    }
    change[i] = gained / inertia_ - (speeds_[i] - course_.speed);
  }
  if (!solve(m, change)) {
    return false;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < kNodes; ++i) {
    speeds_[i] += change[i];
    if (!(std::fabs(speeds_[i]) < 1.0e300)) {
      return false;
    }
    size_ = std::fmax(size_, std::fabs(speeds_[i]));
    largest = std::fmax(largest, std::fabs(change[i]));
  }
  agrees_ = largest <= kRoundingOfSpeed * size_;
  bend();
  return true;
}

double ShaftSpin::finish(SpinMotion& spin) noexcept {
  double gained = start_lever_ - nodes_[2].lever;
  double work = 0.0;
  for (std::size_t j = 0; j < kNodes; ++j) {
    gained += h_ * kSums[2][j] * nodes_[j].rate;
    work += h_ * kSums[2][j] * speeds_[j] * nodes_[j].torque;
  }
  spin.speed.add(gained / inertia_);
  spin.angle.add(h_ *
                 (course_.speed + h_ * (0.5 * course_.acceleration +
                                        h_ * (course_.jerk / 6.0 + h_ * (course_.snap / 24.0)))));
  if (!(spin.angle.high >= 0.0 && spin.angle.high < ShaftAngle::kTurn)) {
    const ShaftAngle rest = whirl_twin::shaftAngle(spin.angle.high);
    spin.turns += rest.turns;
    spin.angle.high = rest.remainder;
  }
  const ShaftMotion end = course_.at(course_.start + h_);
  spin.acceleration = end.acceleration;
  spin.jerk = end.jerk;
  spin.snap = course_.snap;
  return work;
}

}  // namespace whirl_twin
