#include "integration/lateral_exact_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "integration/finite.h"
#include "integration/matrix_exponential.h"

namespace whirl_twin {

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
  increment_ = unscale.head<4>().asDiagonal() * e.topRows<4>() * scale.asDiagonal();
  const Square w =
      r.mass * (scale.asDiagonal() * quadraticIntegral<kAll>(a, power, h_) * scale.asDiagonal());
  speed_ = speed;
  turn_ = std::remainder(speed * h_, kTwoPi);
  const double cosine = std::cos(turn_);
  const double sine = std::sin(turn_);
  turning_ = {{cosine, cosine, cosine, cosine}, {-sine, sine, -sine, sine}};
  turning_across_ = {{-sine, -sine, -sine, -sine}, {-cosine, cosine, -cosine, cosine}};
  work_ = w;
  coupled_ = coupling != 0.0;
  loaded_ = r.load[0] != 0.0 || r.load[1] != 0.0;
  // A number of the complex form is the first column of its block of the real one: of the lines of
  // z and of w.
  const auto factors = [](const auto& m, int column, double times) {
    Factors f;
    for (std::size_t line = 0; line < 2; ++line) {
      const auto row = static_cast<Eigen::Index>(2 * line);
      f.real[2 * line] = f.real[2 * line + 1] = times * m(row, column);
      f.imaginary[2 * line + 1] = times * m(row + 1, column);
      f.imaginary[2 * line] = -f.imaginary[2 * line + 1];
    }
    return f;
  };
  moves_ = {factors(increment_, 0, 1.0), factors(increment_, 2, 1.0)};
  powers_ = {factors(w, 0, 1.0), factors(w, 2, 1.0)};
  force_ = {Complex(increment_(0, 4), increment_(1, 4)),
            Complex(increment_(2, 4), increment_(3, 4))};
  force_power_ = {2.0 * Complex(w(0, 4), w(1, 4)), 2.0 * Complex(w(2, 4), w(3, 4))};
  load_power_ = 2.0 * Complex(w(4, 6), -w(5, 6));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    sag_[i] = increment_(row, 6);
    sag_power_[i] = 2.0 * w(row, 6);
  }
  constant_ = w(4, 4) + w(6, 6);
}

StepStatus LateralExactStep::advance(double angle, double speed, LateralMotion& motion) noexcept {
  constexpr int kTurns = 32;  // until the phasor is made anew
  if (!(speed == speed_)) {
    prepare(speed);
  }
  const SineCosine both = sineCosine(angle);
  if (!rotor_.isotropic) {
    return general(both, motion);
  }
  const LateralRotor::Complex turn(both.cosine, both.sine);
  const auto turned = [&](const std::array<LateralRotor::Complex, 2>& numbers) {
    const LateralRotor::Complex first = numbers[0] * turn;
    const LateralRotor::Complex second = numbers[1] * turn;
    return std::array<double, 4>{first.real(), first.imag(), second.real(), second.imag()};
  };
  forced_ = turned(force_);
  forced_power_ = turned(force_power_);
  loaded_power_ = turned({load_power_, 0.0});
  angle_ = angle;
  turns_left_ = kTurns;
  return whirl<FourDoubles<2>>(motion);
}

StepStatus LateralExactStep::general(const SineCosine& turn, LateralMotion& motion) noexcept {
  All y;
  y << motion.y[0], motion.y[1], motion.y[2], motion.y[3], turn.cosine, turn.sine, 1.0;
  const Eigen::Matrix<double, 4, 1> increment = increment_ * y;
  LateralMotion next = motion;
  next.advance({increment[0], increment[1], increment[2], increment[3]}, y.dot(work_ * y));
  if (!isFinite(next)) {
    return StepStatus::kNotFinite;
  }
  motion = next;
  return StepStatus::kOk;
}

}  // namespace whirl_twin
