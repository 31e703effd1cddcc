#include "reports/sampled_signals.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/control_parts.h"

namespace whirl_twin {

namespace {

std::vector<std::pair<std::size_t, double>> factorsOf(const Eigen::VectorXd& along) {
  std::vector<std::pair<std::size_t, double>> factors;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    if (along[k] != 0.0) {
      factors.emplace_back(static_cast<std::size_t>(k), along[k]);
    }
  }
  return factors;
}

}  // namespace

SampledSignals::SampledSignals(const Twin& twin, const std::vector<std::size_t>& systems,
                               Energy energy)
    : twin_(twin), energies_(energy == Energy::kYes), names_{{"time", "s"}} {
  for (const std::size_t system : systems) {
    addSystem(system);
  }
  addControllers(systems);
}

void SampledSignals::addSystem(std::size_t system) {
  const BuiltSystem& built = *twin_.systems()[system];
  const Dynamics& dynamics = *built.dynamics;
  const auto add = [&](const std::string& signal, const std::string& unit) {
    names_.push_back({built.spec.name + "." + signal, unit});
  };
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    add(c.name, c.unit);
  }
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    add(c.name + "_rate", c.unit + "/s");
  }
  Sampled sampled{system, {}, dynamics.isRotor(), dynamics.hasShaft()};
  if (sampled.rotor) {
    add("whirl_radius", "m");
    add("whirl_phase", "rad");
  }
  for (const Station& station : dynamics.places()) {
    sampled.places.push_back({factorsOf(station.along_x), factorsOf(station.along_y)});
    add(station.name + ".x", "m");
    add(station.name + ".y", "m");
  }
  if (sampled.shaft) {
    add("shaft_speed", "rad/s");
    add("shaft_angle", "rad");
  }
  if (energies_) {
    add("kinetic_energy", "J");
    add("potential_energy", "J");
    add("jacobi_energy", "J");
  }
  sampled_.push_back(std::move(sampled));
}

void SampledSignals::addControllers(const std::vector<std::size_t>& systems) {
  const std::vector<ControllerSpec>& controllers = twin_.scene().controllers;
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    if (std::any_of(systems.begin(), systems.end(),
                    [&](std::size_t system) { return involves(controllers[i], system); })) {
      controllers_.push_back(i);
      for (std::size_t k = 0; k < controllers[i].acted_on.size(); ++k) {
        const ActedInput& acted = controllers[i].acts_on[k];
        names_.push_back({fmt::format("{}.{}", controllers[i].name, controllers[i].acted_on[k]),
                          twin_.systems()[acted.system]->dynamics->inputs()[acted.input].unit});
      }
    }
  }
}

double SampledSignals::displacement(const std::vector<std::pair<std::size_t, double>>& factors,
                                    const double* q) {
  double sum = 0.0;
  for (const auto& [k, factor] : factors) {
    sum += factor * q[k];
  }
  return sum;
}

}  // namespace whirl_twin
