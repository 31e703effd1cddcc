#include "estimation/mode_pairing.h"

#include <algorithm>
#include <cmath>

namespace whirl_twin {

namespace {

constexpr double kApart = 0.25;         // relative frequency difference
constexpr double kMinAssurance = 0.3;   // modal assurance criterion
constexpr double kSameDirection = 0.1;  // sine of the angle between parallel probes

std::complex<double> turned(double angle) {
  return std::polar(1.0, angle);
}

}  // namespace

std::complex<double> MeasuredStation::z(double first, double second) const {
  if (!whole()) {
    return first * turned(direction[0]);
  }
  // first = Re(z e^(-i a)), second = Re(z e^(-i b)).
  const std::complex<double> i(0.0, 1.0);
  return i * (second * turned(direction[0]) - first * turned(direction[1])) /
         std::sin(direction[1] - direction[0]);
}

std::vector<MeasuredStation> measuredStations(const std::vector<std::size_t>& station,
                                              const std::vector<double>& direction) {
  std::vector<MeasuredStation> all;
  for (std::size_t i = 0; i < station.size(); ++i) {
    if (std::any_of(all.begin(), all.end(),
                    [&](const MeasuredStation& one) { return one.station == station[i]; })) {
      continue;
    }
    MeasuredStation one{station[i], {direction[i]}, {i}};
    double best = kSameDirection;
    for (std::size_t a = i; a < station.size(); ++a) {
      for (std::size_t b = a + 1; b < station.size(); ++b) {
        const double apart = std::fabs(std::sin(direction[b] - direction[a]));
        if (station[a] == station[i] && station[b] == station[i] && apart > best) {
          best = apart;
          one.direction = {direction[a], direction[b]};
          one.probe = {a, b};
        }
      }
    }
    all.push_back(std::move(one));
  }
  return all;
}

SeenMode seenMode(const WhirlMode& mode, const std::vector<MeasuredStation>& stations) {
  SeenMode seen;
  seen.frequency = mode.dampedFrequency();
  const auto count = static_cast<Eigen::Index>(stations.size());
  seen.forward.resize(count);
  seen.backward.resize(count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const MeasuredStation& at = stations[static_cast<std::size_t>(s)];
    const Orbit& orbit = mode.orbits[at.station];
    seen.forward[s] = orbit.forward;
    seen.backward[s] = orbit.backward;
    if (!at.whole()) {  // e^(i a) Re(e^(-i a) z)
      const std::complex<double> mirror = turned(2.0 * at.direction[0]);
      seen.forward[s] = 0.5 * (orbit.forward + mirror * std::conj(orbit.backward));
      seen.backward[s] = 0.5 * (orbit.backward + mirror * std::conj(orbit.forward));
    }
  }
  return seen;
}

std::vector<ModePair> pairModes(const std::vector<AmbientMode>& measured,
                                const std::vector<SeenMode>& modelled) {
  struct PairCandidate : ModePair {
    double likeness;
  };
  std::vector<PairCandidate> candidates;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    for (std::size_t k = 0; k < modelled.size(); ++k) {
      const bool forward = measured[i].frequency > 0.0;
      const Eigen::VectorXcd& shape = forward ? modelled[k].forward : modelled[k].backward;
      const double whole = modelled[k].forward.squaredNorm() + modelled[k].backward.squaredNorm();
      const double frequency = std::fabs(measured[i].frequency);
      const double apart = std::fabs(frequency - modelled[k].frequency) / frequency;
      if (!(shape.squaredNorm() > 1.0e-6 * whole) || apart > kApart) {
        continue;
      }
      const double assurance = modalAssurance(shape, measured[i].shape);
      if (assurance < kMinAssurance) {
        continue;
      }
      const double share = std::sqrt(shape.squaredNorm() / whole);
      candidates.push_back({{i, k, assurance}, assurance * share * (1.0 - apart / kApart)});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const PairCandidate& a, const PairCandidate& b) { return a.likeness > b.likeness; });
  std::vector<ModePair> pairs;
  for (const PairCandidate& candidate : candidates) {
    const bool taken = std::any_of(pairs.begin(), pairs.end(), [&](const ModePair& pair) {
      const bool same_sense =
          measured[pair.measured].frequency * measured[candidate.measured].frequency > 0.0;
      return pair.measured == candidate.measured ||
             (pair.modelled == candidate.modelled && same_sense);
    });
    if (!taken) {
      pairs.push_back(candidate);
    }
  }
  return pairs;
}

}  // namespace whirl_twin
