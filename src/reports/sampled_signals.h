// The signals of a run, a row of values at each sample: for the table of `twin simulate` and for
// Python.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {

struct SignalName {
  std::string name;  ///< "rotor.x"
  std::string unit;
};

class SampledSignals {
 public:
  enum class Energy { kNo, kYes };

  /// Of these systems of the twin, which outlives this: time, then for each system its coordinates,
  /// its rates, for a rotor whirl radius [m] and unwrapped phase [rad] and the displacements x and
  /// y of its stations and its casing [m], where a shaft turns it its speed and angle, and on
  /// request its energies; then what their controllers act with, CONTROLLER.SYSTEM.INPUT.
  SampledSignals(const Twin& twin, const std::vector<std::size_t>& systems, Energy energy);

  const std::vector<SignalName>& names() const { return names_; }
  /// Passes the value of each, in the order of the names, to take(double). Those of a system that
  /// has stopped are NaN.
  template <typename Take>
  void eachOf(const Observer& observer, const Take& take) const;

 private:
  /// Displacement of a place on the shaft: its factors of the coordinates, without zeros.
  struct Place {
    std::vector<std::pair<std::size_t, double>> x, y;
  };
  struct Sampled {
    std::size_t system;
    std::vector<Place> places;
    bool rotor, shaft;
  };

  void addSystem(std::size_t system);
  void addControllers(const std::vector<std::size_t>& systems);
  static double displacement(const std::vector<std::pair<std::size_t, double>>& factors,
                             const double* q);

  const Twin& twin_;
  bool energies_;
  std::vector<Sampled> sampled_;
  std::vector<std::size_t> controllers_;  // that have to do with the systems
  std::vector<SignalName> names_;
};

template <typename Take>
void SampledSignals::eachOf(const Observer& observer, const Take& take) const {
  take(twin_.seconds(observer.step()));
  for (const Sampled& sampled : sampled_) {
    const std::size_t i = sampled.system;
    const bool running = observer.status(i) == StepStatus::kOk;
    const std::size_t n = twin_.systems()[i]->spec.q.size();
    const double* const q = observer.coordinates(i);
    const double* const v = observer.rates(i);
    for (std::size_t k = 0; k < n; ++k) {
      take(running ? q[k] : kNaN);
    }
    for (std::size_t k = 0; k < n; ++k) {
      take(running ? v[k] : kNaN);
    }
    if (sampled.rotor) {
      take(running ? observer.whirlRadius(i) : kNaN);
      take(running ? observer.whirlPhase(i) : kNaN);
    }
    for (const Place& place : sampled.places) {
      take(running ? displacement(place.x, q) : kNaN);
      take(running ? displacement(place.y, q) : kNaN);
    }
    if (sampled.shaft) {
      const EvaluationPoint<double> at = observer.moment(i);
      take(at.speed);
      take(at.angle);
    }
    if (energies_) {
      const Energies e = running ? observer.energies(i) : Energies{kNaN, kNaN, kNaN, kNaN, kNaN};
      take(e.kinetic);
      take(e.potential);
      take(e.jacobi);
    }
  }
  for (const std::size_t i : controllers_) {
    for (const double output : observer.controller(i).output) {
      take(output);
    }
  }
}

}  // namespace whirl_twin
