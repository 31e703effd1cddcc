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

constexpr double kRoundingAtRest = 1.0e-14;

}  // namespace

LateralExactStep::LateralExactStep(const LateralRotor& rotor, double h)
    : nanoseconds_(std::llround(h * 1e9)), rotor_(rotor), h_(h) {
  if (std::fabs(static_cast<double>(nanoseconds_) - h * 1e9) > 1e-9) {
    nanoseconds_ = 0;
  }
}

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
  const SplitAngle turn = turnIn(speed, nanoseconds_);
  const long double angle = static_cast<long double>(turn.high) + turn.low;
  const long double cosine = std::cos(angle);
  const long double sine = std::sin(angle);
  turn_.set(static_cast<double>(cosine), static_cast<double>(sine));
  turn_low_.set(static_cast<double>(cosine - static_cast<double>(cosine)),
                static_cast<double>(sine - static_cast<double>(sine)));
  const auto column = [](const auto& m, int j, double times) {
    return Numbers{{times * m(0, j), times * m(1, j), times * m(2, j), times * m(3, j)}};
  };
  const auto columns = [](const auto& m) {
    return Columns{{{m(0, 0), m(1, 1), m(2, 2), m(3, 3)}},
                   {{m(0, 2), m(1, 3), m(2, 0), m(3, 1)}},
                   {{m(0, 1), m(1, 0), m(2, 3), m(3, 2)}},
                   {{m(0, 3), m(1, 2), m(2, 1), m(3, 0)}}};
  };
  coupled_ = coupling != 0.0;
  moves_ = columns(increment);
  powers_ = columns(w);
  force_ = {column(increment, 4, 1.0), column(increment, 5, 1.0), column(increment, 6, 1.0)};
  force_power_ = {column(w, 4, 2.0), column(w, 5, 2.0), column(w, 6, 2.0)};
  steady_at_rest_ = 0.5 * (w(4, 4) + w(5, 5)) + w(6, 6);
  at_rest_ = {2.0 * w(4, 6), 2.0 * w(5, 6), 0.5 * (w(4, 4) - w(5, 5)), w(4, 5)};
  turns_at_rest_ = std::any_of(at_rest_.begin(), at_rest_.end(), [&](double part) {
    return std::fabs(part) > kRoundingAtRest * std::fabs(steady_at_rest_);
  });
}

StepStatus LateralExactStep::advance(const Drive& drive, LateralMotion& motion) noexcept {
  constexpr int kTurns = 32;  // until the phasor is recomputed
  const ShaftMotion shaft = drive.at(0.0);
  if (!(shaft.speed == speed_)) {
    prepare(shaft.speed);
  }
  const SineCosine both = sineCosine(shaft.angle);
  phasor_.set(both.cosine, both.sine);
  next_ = drive.nanoseconds();
  piece_ = drive.piece();
  turns_left_ = nanoseconds_ > 0 && drive.constantFor((kTurns + 1) * h_) ? kTurns : 0;
  return take<FourDoubles<2>>(motion);
}

}  // namespace whirl_twin
