#include "analysis/forced_response.h"

#include <algorithm>
#include <cmath>

#include "analysis/banded_rotor.h"

namespace whirl_twin {

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

}  // namespace whirl_twin
