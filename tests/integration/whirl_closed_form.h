// The complete motion of a whirl driven by unbalance, in closed form and extended precision:
//
//   z'' + a z' + b z = f e^(iwt)   =>   z = Z e^(iwt) + A1 e^(s1 t) + A2 e^(s2 t),
//
// with complex a, b, f. An isotropic rotor is z = x + iy; an axis of another one is the real part.
#pragma once

#include <cmath>
#include <complex>

namespace whirl_twin {

class ClosedFormWhirl {
 public:
  using Complex = std::complex<long double>;

  ClosedFormWhirl(Complex a, Complex b, Complex f, long double w, Complex z0, Complex v0) : w_(w) {
    const Complex i(0.0L, 1.0L);
    const Complex stiffness = b - w * w + i * w * a;
    const Complex root = std::sqrt(a * a / 4.0L - b);
    s1_ = -a / 2.0L + root;
    s2_ = -a / 2.0L - root;
    // Driven exactly at an undamped frequency the response grows: Z t e^(iwt).
    resonant_ = std::abs(stiffness) == 0.0L;
    response_ = resonant_ ? f / (2.0L * i * w + a) : f / stiffness;
    const Complex z = z0 - (resonant_ ? Complex(0.0L) : response_);
    const Complex v = v0 - (resonant_ ? response_ : i * w * response_);
    critical_ = std::abs(s1_ - s2_) < 1e-12L * std::abs(s1_);
    first_ = critical_ ? z : (v - s2_ * z) / (s1_ - s2_);
    second_ = critical_ ? v - s1_ * z : z - first_;
  }

  Complex operator()(long double t) const {
    const Complex turn = std::polar(1.0L, w_ * t);
    const Complex forced = response_ * turn * (resonant_ ? t : 1.0L);
    if (critical_) {  // a double root
      return forced + (first_ + second_ * t) * std::exp(s1_ * t);
    }
    return forced + first_ * std::exp(s1_ * t) + second_ * std::exp(s2_ * t);
  }

 private:
  long double w_;
  Complex s1_, s2_, response_, first_, second_;
  bool resonant_ = false;
  bool critical_ = false;
};

}  // namespace whirl_twin
