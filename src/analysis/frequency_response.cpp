#include "analysis/frequency_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "analysis/banded_rotor.h"
#include "analysis/natural_modes.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kSingularReturn = 1e-13;  // a few hundred roundings of terms of size 1

}  // namespace

Eigen::MatrixXcd receptance(const Linearization& system, double frequency) {
  const double w = frequency;
  if (!std::isfinite(w)) {
    throw InputError("frequency response: expected a finite frequency [rad/s]");
  }
  Eigen::MatrixXcd dynamic_stiffness(system.mass.rows(), system.mass.cols());
  dynamic_stiffness.real() = system.stiffness + system.circulatory - w * w * system.mass;
  dynamic_stiffness.imag() = w * (system.damping + system.gyroscopic);
  // Scaled by the largest term of each coordinate, the answer does not depend on units.
  const Eigen::ArrayXd terms = system.stiffness.diagonal().array().abs() +
                               w * w * system.mass.diagonal().array().abs() +
                               std::abs(w) * system.damping.diagonal().array().abs();
  const Eigen::VectorXd scale =
      (terms > 0.0).select(terms.max(1e-300).rsqrt(), Eigen::ArrayXd::Ones(terms.size()));
  const Eigen::MatrixXcd scaled = scale.asDiagonal() * dynamic_stiffness * scale.asDiagonal();
  const Eigen::VectorXd singular = singularValues(scaled);
  if (!(singular.minCoeff() > kSingularReturn)) {
    if (w == 0.0) {
      throw RunFailure(
          "frequency response: a constant force has no steady response: the stiffness is singular, "
          "and the force accelerates the system instead of deflecting it");
    }
    throw RunFailure(
        fmt::format("frequency response: undamped resonance at {:.6g} rad/s: the response grows "
                    "with time and has no steady amplitude",
                    w));
  }
  return scale.asDiagonal() * ComplexLu(scaled).inverse() * scale.asDiagonal();
}

Eigen::VectorXcd steadyResponse(const Linearization& system, const Eigen::VectorXcd& force,
                                double frequency) {
  if (force.size() != system.mass.rows()) {
    throw InputError(fmt::format("frequency response: expected a force of {} entries, found {}",
                                 system.mass.rows(), force.size()));
  }
  return receptance(system, frequency) * force;
}

namespace {

using Complex = std::complex<double>;

constexpr int kFrequenciesBesideResonance = 20;  // frequencies on each side of a resonance
constexpr double kFrequencySpread = 4.0;         // up to sinh(4) = 27 half-widths away
constexpr double kMinResonanceWidth = 1.0e-4;    // of the frequency, half a width
/// Beside the response to the stiffness of the force's place.
constexpr double kSingularResponse = 1.0e13;

}  // namespace

std::vector<ForcedResponse> forcedResponse(const LinearRotor& rotor,
                                           const std::vector<Station>& stations, double speed,
                                           const Eigen::VectorXd& direction,
                                           const std::vector<double>& frequencies) {
  const BandedLinearization l = BandedRotor(rotor).matrices(speed);
  BandedMatrix<Complex> place(l.size(), 0);
  place.add(1.0, l.byPlace());
  const Eigen::VectorXcd force = direction.cast<Complex>();
  const double stiffest = place.largest();
  std::vector<ForcedResponse> all;
  for (const double frequency : frequencies) {
    BandedMatrix<Complex> dynamic = place;
    dynamic.add(Complex(0.0, frequency), l.byRate());
    dynamic.add(-frequency * frequency, l.mass);
    const BandedLU<Complex> factors(dynamic);
    if (factors.singular()) {
      continue;
    }
    const Eigen::VectorXcd x = factors.solve(force);
    if (x.allFinite() &&
        x.cwiseAbs().maxCoeff() * stiffest < kSingularResponse * direction.norm()) {
      all.push_back({frequency, orbitsOf(x, stations)});
    }
  }
  return all;
}

std::vector<double> frequenciesAround(const std::vector<WhirlMode>& modes, double from, double to,
                                      int points) {
  std::vector<double> all;
  for (int i = 0; i < points; ++i) {
    all.push_back(from + (to - from) * i / (points - 1));
  }
  for (const WhirlMode& mode : modes) {
    const double at = mode.dampedFrequency();
    const double width = std::max(std::fabs(mode.eigenvalue.real()), kMinResonanceWidth * at);
    for (int k = -kFrequenciesBesideResonance; k <= kFrequenciesBesideResonance; ++k) {
      const double frequency =
          at + width * std::sinh(kFrequencySpread * k / kFrequenciesBesideResonance);
      if (frequency > from && frequency < to) {
        all.push_back(frequency);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Eigen::MatrixXd influenceCoefficients(const Eigen::MatrixXd& stiffness) {
  const Eigen::Index free = rigidBodyModes(stiffness).cols();
  if (free > 0) {
    throw RunFailure(
        fmt::format("influence coefficients: the stiffness is singular, with {} rigid-body mode{}: "
                    "without supports a unit force accelerates the system instead of deflecting it",
                    free, free > 1 ? "s" : ""));
  }
  const ScaledForm scaled = unitDiagonal(stiffness);
  const Eigen::MatrixXd inverse =
      Cholesky(scaled.form).solve(Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols()));
  const Eigen::MatrixXd a = scaled.scale.asDiagonal() * inverse * scaled.scale.asDiagonal();
  return 0.5 * (a + a.transpose());
}

}  // namespace whirl_twin
