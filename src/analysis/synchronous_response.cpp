#include "analysis/synchronous_response.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/banded_rotor.h"
#include "analysis/synchronous_poles.h"
#include "analysis/whirl_modes.h"

namespace whirl_twin {

namespace {

constexpr int kSpeedsBesideResonance = 20;  // speeds on each side of a resonance
constexpr double kSpeedSpread = 3.0;        // up to sinh(3) = 10 half-widths away

}  // namespace

bool hasSynchronousForce(const LinearRotor& rotor) {
  return std::any_of(rotor.forces.begin(), rotor.forces.end(), [](const ShaftForce& force) {
    return force.harmonic == 1 && (force.amplitude.array() != 0.0).any();
  });
}

SynchronousResponse synchronousResponse(const LinearRotor& rotor,
                                        const std::vector<Station>& stations, double speed) {
  SynchronousResponse response;
  response.speed = speed;
  response.q = BandedLU<std::complex<double>>(
                   synchronousStiffness(BandedRotor(rotor).matrices(speed), speed))
                   .solve(rotor.synchronousForce(speed));
  response.orbits = orbitsOf(response.q, stations);
  return response;
}

std::vector<SynchronousResponse> synchronousSweep(const LinearRotor& rotor,
                                                  const std::vector<Station>& stations, double from,
                                                  double to, int points) {
  std::vector<double> speeds;
  for (int i = 0; i < points; ++i) {
    speeds.push_back(from + (to - from) * i / (points - 1));
  }
  const double low = std::max(from, 1.0e-3 * to);
  const auto poles = synchronousPoles(rotor, low, to);
  const auto around = speedsToLookAt(poles, low, to, 1);
  speeds.insert(speeds.end(), around.begin(), around.end());
  for (const std::complex<double>& pole : poles) {  // so that the polar plot is round, too
    const double width = std::fabs(pole.imag());
    for (int k = -kSpeedsBesideResonance; k <= kSpeedsBesideResonance; ++k) {
      const double speed =
          pole.real() + width * std::sinh(kSpeedSpread * k / kSpeedsBesideResonance);
      if (speed > from && speed < to && width < pole.real()) {
        speeds.push_back(speed);
      }
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  std::vector<SynchronousResponse> sweep;
  for (const double speed : speeds) {
    sweep.push_back(synchronousResponse(rotor, stations, speed));
  }
  return sweep;
}

double phaseLag(const Orbit& orbit, double phase_mark) {
  return std::arg(std::polar(1.0, phase_mark) * std::conj(orbit.forward));
}

}  // namespace whirl_twin
