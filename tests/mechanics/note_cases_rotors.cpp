// The Jeffcott rotor against the lecture notes' reference numbers.
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "../integration/running_system.h"
#include "algebra/dense.h"
#include "note_case.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXd;

Vector vector(const Complex& z) {
  return Eigen::Vector2d(z.real(), z.imag());
}

std::shared_ptr<const Dynamics> rotor(const ParameterValues& parameters) {
  const ModelInfo& model = *findModel("jeffcott_rotor");
  return model.setUp(completed(model, parameters), {}, 0.0).dynamics;
}

Linearization linearAt(const Dynamics& rotor, double speed) {
  const Vector zero = Vector::Zero(2);
  return rotor.linearization(zero, zero, zero, {0.0, 0.0, speed, 0.0});
}

/// Amplitude of x in x = Re(X e^(iwt)): the unbalance response of the linearized model.
Complex synchronousWhirl(const Dynamics& rotor, double speed) {
  const Linearization l = linearAt(rotor, speed);
  const Vector zero = Vector::Zero(2);
  const Vector ahead = rotor.residualForce(zero, zero, {0.0, 0.0, speed, 0.0});
  const Vector aside = rotor.residualForce(zero, zero, {0.0, M_PI / 2.0, speed, 0.0});
  const Eigen::Vector2cd force = ahead.cast<Complex>() - Complex(0.0, 1.0) * aside.cast<Complex>();
  const Eigen::Matrix2cd stiffness =
      (l.stiffness + l.circulatory - speed * speed * l.mass).cast<Complex>() +
      Complex(0.0, speed) * (l.damping + l.gyroscopic).cast<Complex>();
  return ComplexLu(stiffness).solve(force)[0];
}

/// r/e, its phase lag and its peak, for p = 1 rad/s and e = 1 m.
std::vector<double> synchronousAnswers(const NoteCase& c) {
  const auto unit = rotor(
      {{"mass", 1.0}, {"stiffness", 1.0}, {"damping", 2.0 * c.at("zeta")}, {"eccentricity", 1.0}});
  if (c.startsWith("jeffcott.r_e.")) {
    return {std::abs(synchronousWhirl(*unit, c.at("w_over_p")))};
  }
  if (c.startsWith("jeffcott.phi.")) {
    return {-std::arg(synchronousWhirl(*unit, c.at("w_over_p")))};
  }
  // (e/r)^2 is a parabola in u = 1/w^2: three points of it give the peak without a search.
  const auto softness = [&](double u) {
    return 1.0 / std::norm(synchronousWhirl(*unit, 1.0 / std::sqrt(u)));
  };
  const double bend = 2.0 * (softness(1.5) - 2.0 * softness(1.0) + softness(0.5));
  const double peak = 1.0 - (softness(1.5) - softness(0.5)) / (2.0 * bend);
  if (c.startsWith("jeffcott.wpeak.")) {
    return {1.0 / std::sqrt(peak)};
  }
  if (c.startsWith("jeffcott.rpeak.")) {
    return {1.0 / std::sqrt(softness(peak))};
  }
  return {};
}

RunningSystem::Setup unbalancedRotor(const NoteCase& c) {
  RunningSystem::Setup setup;
  setup.model = "jeffcott_rotor";
  setup.parameters = {{"mass", c.at("m")},
                      {"stiffness", c.at("k")},
                      {"damping", c.at("c")},
                      {"eccentricity", c.at("e")}};
  setup.speed = c.at("w");
  return setup;
}

/// From rest, in steps of a millisecond, by the exact step and by Gauss-Legendre.
std::vector<double> fromRestAnswers(const NoteCase& c) {
  const auto seconds = std::stol(c.id.substr(c.id.rfind('t') + 1));
  std::vector<double> answers;
  for (const char* method : {"exponential", "gauss_legendre_6"}) {
    RunningSystem system(unbalancedRotor(c), method, 1000000);
    system.run(1000 * seconds);
    answers.push_back(c.contains(".R.")   ? std::hypot(system.q(0), system.q(1))
                      : c.contains(".X.") ? system.q(0)
                                          : system.q(1));
  }
  return answers;
}

/// The motion in x, y seen in polar coordinates, its angle unwrapped step by step.
std::vector<double> polarAnswers(const NoteCase& c) {
  if (c.startsWith("acc.")) {
    const double r = c.at("at_r");
    const double r_rate = c.at("at_r_d");
    const double theta_rate = c.at("at_theta_d");
    const Complex direction = std::polar(1.0, c.at("at_theta"));
    const Vector a = rotor(unbalancedRotor(c).parameters)
                         ->acceleration(vector(r * direction),
                                        vector(Complex(r_rate, r * theta_rate) * direction),
                                        {c.at("t"), c.at("w") * c.at("t"), c.at("w"), 0.0});
    const Complex polar = Complex(a[0], a[1]) / direction;
    return {(polar.imag() - 2.0 * r_rate * theta_rate) / r};
  }
  RunningSystem::Setup setup = unbalancedRotor(c);
  const Complex direction = std::polar(1.0, c.at("ic_theta"));
  const Complex z = c.at("ic_r") * direction;
  const Complex z_rate = Complex(c.at("ic_r_d"), c.at("ic_r") * c.at("ic_theta_d")) * direction;
  setup.q = {z.real(), z.imag()};
  setup.v = {z_rate.real(), z_rate.imag()};
  std::vector<double> answers;
  for (const char* method : {"exponential", "gauss_legendre_6"}) {
    RunningSystem system(setup, method, 1000000);
    double theta = c.at("ic_theta");
    for (long i = 0; i < std::lround(1000.0 * c.time); ++i) {
      system.run(1);
      theta += std::remainder(std::atan2(system.q(1), system.q(0)) - theta, 2.0 * M_PI);
    }
    const double r = std::hypot(system.q(0), system.q(1));
    const Complex rate = Complex(system.v(0), system.v(1)) / std::polar(1.0, theta);
    const std::map<std::string, double> polar{
        {"r", r}, {"theta", theta}, {"r_d", rate.real()}, {"theta_d", rate.imag() / r}};
    answers.push_back(polar.at(c.state));
  }
  return answers;
}

/// s^4 + A3 s^3 + A2 s^2 + A1 s + A0 of the whirl, highest first: {A3, A2, A1, A0}.
Eigen::Vector4d whirlPolynomial(const Linearization& l) {
  const Eigen::Matrix2d d = l.mass.inverse() * (l.damping + l.gyroscopic);
  const Eigen::Matrix2d k = l.mass.inverse() * (l.stiffness + l.circulatory);
  return {d.trace(), d.determinant() + k.trace(),
          d(0, 0) * k(1, 1) + k(0, 0) * d(1, 1) - d(0, 1) * k(1, 0) - k(0, 1) * d(1, 0),
          k.determinant()};
}

/// [1/s]
double largestRealPart(const Linearization& l) {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a.topRightCorner<2, 2>().setIdentity();
  a.bottomLeftCorner<2, 2>() = -l.mass.inverse() * (l.stiffness + l.circulatory);
  a.bottomRightCorner<2, 2>() = -l.mass.inverse() * (l.damping + l.gyroscopic);
  return Eigen::EigenSolver<Eigen::Matrix4d>(a).eigenvalues().real().maxCoeff();
}

/// The motion in x, y seen from the turning shaft: z = zeta e^(iwt).
std::vector<double> rotatingFrameAnswers(const NoteCase& c) {
  const double m = c.at("m");
  const double e = c.at("e", 0.0);
  const double w = c.at("w", 0.0);
  const auto damped = rotor({{"mass", m},
                             {"stiffness", c.at("k")},
                             {"damping", c.at("ce")},
                             {"internal_damping", c.at("ci")},
                             {"eccentricity", e}});
  const auto zRate = [&](const Complex& zeta, const Complex& rate, const Complex& turn) {
    return (rate + Complex(0.0, w) * zeta) * turn;
  };
  if (c.startsWith("acc.")) {
    const Complex zeta(c.at("at_xi"), c.at("at_eta"));
    const Complex rate(c.at("at_xi_d"), c.at("at_eta_d"));
    const Complex turn = std::polar(1.0, w * c.at("t"));
    const Vector a = damped->acceleration(vector(zeta * turn), vector(zRate(zeta, rate, turn)),
                                          {c.at("t"), w * c.at("t"), w, 0.0});
    const Complex seen = Complex(a[0], a[1]) / turn - Complex(0.0, 2.0 * w) * rate + w * w * zeta;
    return {c.contains(".xi") ? seen.real() : seen.imag()};
  }
  if (c.startsWith("inv.h0.")) {
    // The Jacobi integral of the rotating frame is T + V - w H, H the moment of momentum.
    const Complex zeta(c.at("ic_xi"), c.at("ic_eta"));
    const Complex rate = zRate(zeta, {c.at("ic_xi_d"), c.at("ic_eta_d")}, 1.0);
    const Energies energies = damped->energies(vector(zeta), vector(rate), {0.0, 0.0, w, 0.0});
    const Complex centre = zeta + e;
    const Complex centre_rate = rate + Complex(0.0, w * e);
    return {energies.kinetic + energies.potential -
            w * m * (std::conj(centre) * centre_rate).imag()};
  }
  if (c.startsWith("whirl.internal.growth.")) {
    return {largestRealPart(linearAt(*damped, w))};
  }
  if (c.startsWith("routh.internal.")) {
    const Eigen::Vector4d a = whirlPolynomial(linearAt(*damped, w));
    return {a[2] * a[1] * a[0] - a[2] * a[2] - a[0] * a[0] * a[3]};
  }
  if (c.startsWith("whirl.internal.wcrit.")) {
    double stable = 0.0;
    double unstable = 1000.0;
    while (unstable - stable > 1e-13 * unstable) {
      const double speed = 0.5 * (stable + unstable);
      (largestRealPart(linearAt(*damped, speed)) > 0.0 ? unstable : stable) = speed;
    }
    return {stable};
  }
  return {};
}

}  // namespace

std::vector<double> rotorAnswers(const NoteCase& c) {
  if (c.system == "jeffcott") {
    return synchronousAnswers(c);
  }
  if (c.system == "jeffcott_xy") {
    return fromRestAnswers(c);
  }
  return c.system == "jeffcott_polar" ? polarAnswers(c) : rotatingFrameAnswers(c);
}

}  // namespace whirl_twin
