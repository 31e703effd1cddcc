// Sampled trajectory of a system of a scene, to compare step settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "integration/stepper.h"
#include "scene/scene.h"

namespace whirl_twin {

/// A way to step a system.
struct StepSetting {
  std::string integrator;
  std::int64_t step = 0;  ///< [ns], of the twin
  int substeps = 1;       ///< steps of the method inside one of the twin, or as StepMethod::ahead
};

/// The scene with one of its systems only, and its controllers unless they tie it to others.
Scene sceneOfOne(const Scene& scene, std::size_t system);

/// Substeps in one step of the twin that a scene of one system specifies, for any method.
int ownSubsteps(const Scene& one);

/// A scene of one system with the given step setting.
Scene withSetting(const Scene& one, const StepSetting& setting);

struct Trajectory {
  double interval = 0.0;             ///< [s], from one sample to the next; the first is the start
  std::size_t dof = 0;               ///< numbers of each sample in `coordinates`
  std::vector<bool> angular;         ///< of each coordinate: [rad], not [m]
  std::vector<double> coordinates;   ///< sample by sample
  std::vector<double> rates;         ///< likewise
  std::vector<double> whirl_radius;  ///< [m], of a rotor
  std::vector<double> whirl_phase;   ///< [rad], of a rotor; NaN where there is none
  std::vector<double> energy;        ///< [J], T + V
  double energy_drift = 0.0;         ///< largest energy residual, as the twin publishes it
  /// Largest change of a conserved momentum, relative to the largest of its terms; NaN where a
  /// model from energies has no cyclic coordinate, and for linear ones.
  double momentum_drift = std::numeric_limits<double>::quiet_NaN();
  StepStatus status = StepStatus::kOk;  ///< why the samples end before the duration

  std::size_t samples() const { return dof == 0 ? 0 : coordinates.size() / dof; }
  /// The first so many samples of the coordinates and rates; it has as many or more.
  void keep(std::size_t samples) {
    coordinates.resize(samples * dof);
    rates.resize(samples * dof);
  }
};

/// Of a scene of one system the coordinates and rates alone: `samples` of them, the start the
/// first, an interval [ns], a multiple of the step, apart. A system that stops ends it, and so does
/// `go_on`, asked at every sample, if it is given; one whose steps cannot be prepared has none.
Trajectory motion(const Scene& one, std::int64_t interval, std::size_t samples,
                  const std::function<bool(const Trajectory&)>& go_on = {});

/// Runs a scene of one system from its start, from q + dq if that is given. duration and interval
/// [ns] are multiples of the step. A system that stops ends it.
Trajectory trajectory(const Scene& one, std::int64_t duration, std::int64_t interval,
                      const std::vector<double>& dq = {});

}  // namespace whirl_twin
