#include "integration/lateral_exact_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "integration/matrix_exponential.h"
#include "mechanics/sine_cosine.h"

namespace whirl_twin {

namespace {

/// x, y and x', y' (over a frequency); cos, sin; 1.
constexpr int kAll = 7;
using All = Eigen::Matrix<double, kAll, 1>;
using Square = Eigen::Matrix<double, kAll, kAll>;
using Increment = Eigen::Matrix<double, 4, kAll>;

constexpr double kRounding = 1.0e-14;

}  // namespace

void LateralExactStep::prepare(double speed) noexcept {
  using Complex = LateralRotor::Complex;
  const LateralRotor& r = rotor_;
  const std::array<Complex, 2> force{speed * speed * r.eccentricity[0] + r.bow_force[0],
                                     speed * speed * r.eccentricity[1] + r.bow_force[1]};
  const double coupling = r.couplingAt(speed);
  // Rates in parts of the frequency, forces as the deflections they cause: the norm of h A is then
  // frequency times step.
  const double square = std::max({r.stiffness[0], r.stiffness[1], std::fabs(coupling)});
  const double rate = powerOfTwo(std::sqrt(square));
  const double bent = powerOfTwo(std::max(std::abs(force[0]), std::abs(force[1])) / square);
  const double sag = powerOfTwo(std::max(std::fabs(r.load[0]), std::fabs(r.load[1])) / square);
  All scale;
  scale << 1.0, 1.0, 1.0 / rate, 1.0 / rate, bent, bent, sag;

  Square a = Square::Zero();
  Square power = Square::Zero();  // dh/dt over the mass, in the scaled y
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const int v = 2 + axis;
    const double along = axis == 0 ? -coupling : coupling;
    const double phasors[2] = {force[i].real(), -force[i].imag()};
    a(axis, v) = rate;
    a(v, axis) = -r.stiffness[i] / rate;
    a(v, 1 - axis) = along / rate;
    a(v, v) = -r.damping[i];
    a(v, 6) = r.load[i] / (rate * sag);
    power(v, v) = -r.damping[i] * rate * rate;
    power(v, 1 - axis) = power(1 - axis, v) = 0.5 * along * rate;
    for (int k = 0; k < 2; ++k) {
      a(v, 4 + k) = phasors[k] / (rate * bent);
      power(v, 4 + k) = power(4 + k, v) = 0.5 * phasors[k] * rate / bent;
    }
  }
  a(4, 5) = -speed;
  a(5, 4) = speed;

  const Square e = exponentialLessIdentity<kAll>(Square(h_ * a));
  const All unscale = scale.cwiseInverse();
  const Increment increment = unscale.head<4>().asDiagonal() * e.topRows<4>() * scale.asDiagonal();
  const Square w =
      r.mass * (scale.asDiagonal() * quadraticIntegral<kAll>(a, power, h_) * scale.asDiagonal());
  speed_ = speed;
  turn_ = std::remainder(speed * h_, kTwoPi);
  cosine_ = std::cos(turn_);
  sine_ = std::sin(turn_);
  const auto column = [](const auto& m, int j, double times) {
    return Numbers{{times * m(0, j), times * m(1, j), times * m(2, j), times * m(3, j)}};
  };
  for (int j = 0; j < 4; ++j) {
    moves_[static_cast<std::size_t>(j)] = column(increment, j, 1.0);
    powers_[static_cast<std::size_t>(j)] = column(w, j, 1.0);
  }
  force_.ahead = column(increment, 4, 1.0);
  force_.aside = column(increment, 5, 1.0);
  force_power_.ahead = column(w, 4, 2.0);
  force_power_.aside = column(w, 5, 2.0);
  sag_ = column(increment, 6, 1.0);
  sag_power_ = column(w, 6, 2.0);
  steady_at_rest_ = 0.5 * (w(4, 4) + w(5, 5)) + w(6, 6);
  turning_at_rest_.ahead = {{2.0 * w(4, 6), 0.5 * (w(4, 4) - w(5, 5)), 0.0, 0.0}};
  turning_at_rest_.aside = {{2.0 * w(5, 6), w(4, 5), 0.0, 0.0}};
  const double rounding = kRounding * std::fabs(steady_at_rest_);
  turns_at_rest_ = false;
  for (const Numbers* part : {&turning_at_rest_.ahead, &turning_at_rest_.aside}) {
    turns_at_rest_ =
        turns_at_rest_ || std::fabs(part->all[0]) > rounding || std::fabs(part->all[1]) > rounding;
  }
}

void LateralExactStep::Turning::turnTo(double cosine, double sine) noexcept {
  for (std::size_t i = 0; i < 4; ++i) {
    now.all[i] = cosine * ahead.all[i] + sine * aside.all[i];
    slope.all[i] = cosine * aside.all[i] - sine * ahead.all[i];
  }
}

StepStatus LateralExactStep::advance(double angle, double speed, LateralMotion& motion) noexcept {
  constexpr int kTurns = 32;  // until all is made anew
  if (!(speed == speed_)) {
    prepare(speed);
  }
  const SineCosine both = sineCosine(angle);
  force_.turnTo(both.cosine, both.sine);
  force_power_.turnTo(both.cosine, both.sine);
  at_rest_ = steady_at_rest_;
  if (turns_at_rest_) {
    turning_at_rest_.now = turning_at_rest_.ahead;
    turning_at_rest_.slope = turning_at_rest_.aside;
    turnAtRest(both.cosine, both.sine);
  }
  angle_ = angle;
  turns_left_ = kTurns;
  return take<FourDoubles<2>>(motion);
}

}  // namespace whirl_twin
