#include "python/sampled_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "algebra/constants.h"
#include "reports/asked_cost.h"
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

double displacement(const std::vector<std::pair<std::size_t, double>>& factors, const double* q) {
  double sum = 0.0;
  for (const auto& [k, factor] : factors) {
    sum += factor * q[k];
  }
  return sum;
}

}  // namespace

SampledRun::SampledRun(const Twin& twin, std::vector<std::size_t> systems, std::size_t samples,
                       bool insist)
    : twin_(twin), samples_(samples) {
  signals_.push_back({"time", "s"});
  for (const std::size_t system : systems) {
    addSystem(system);
  }
  const std::vector<ControllerSpec>& controllers = twin.scene().controllers;
  for (std::size_t i = 0; i < controllers.size(); ++i) {
    if (std::any_of(systems.begin(), systems.end(), [&](std::size_t system) {
          return involves(controllers[i], system);
        })) {
      controllers_.push_back(i);
      for (std::size_t k = 0; k < controllers[i].acted_on.size(); ++k) {
        const ActedInput& acted = controllers[i].acts_on[k];
        signals_.push_back({fmt::format("{}.{}", controllers[i].name, controllers[i].acted_on[k]),
                            twin.systems()[acted.system]->dynamics->inputs()[acted.input].unit});
      }
    }
  }
  const double size =
      static_cast<double>(signals_.size()) * static_cast<double>(samples_) * sizeof(double);
  tell({0.0, size, fmt::format("sample: {} signals, {} samples", signals_.size(), samples_)},
       insist);
  values_.reset(static_cast<double*>(
      std::malloc(std::max<std::size_t>(1, signals_.size() * samples_) * sizeof(double))));
  if (!values_) {
    throw std::bad_alloc();
  }
}

void SampledRun::addSystem(std::size_t system) {
  const BuiltSystem& built = *twin_.systems()[system];
  const Dynamics& dynamics = *built.dynamics;
  const std::string& name = built.spec.name;
  const auto add = [&](const std::string& signal, const std::string& unit) {
    signals_.push_back({name + "." + signal, unit});
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
  for (const Station& station : dynamics.stations()) {
    sampled.places.push_back({factorsOf(station.along_x), factorsOf(station.along_y)});
    add(station.name + ".x", "m");
    add(station.name + ".y", "m");
  }
  if (sampled.shaft) {
    add("shaft_speed", "rad/s");
    add("shaft_angle", "rad");
  }
  add("kinetic_energy", "J");
  add("potential_energy", "J");
  add("jacobi_energy", "J");
  sampled_.push_back(std::move(sampled));
}

void SampledRun::write(const Observer& observer) {
  if (written_ == samples_) {
    return;
  }
  row_ = 0;
  put(twin_.seconds(observer.step()));
  for (const Sampled& sampled : sampled_) {
    const std::size_t i = sampled.system;
    const bool running = observer.status(i) == StepStatus::kOk;
    const std::size_t n = twin_.systems()[i]->spec.q.size();
    const double* const q = observer.coordinates(i);
    const double* const v = observer.rates(i);
    for (std::size_t k = 0; k < n; ++k) {
      put(running ? q[k] : kNaN);
    }
    for (std::size_t k = 0; k < n; ++k) {
      put(running ? v[k] : kNaN);
    }
    if (sampled.rotor) {
      put(running ? observer.whirlRadius(i) : kNaN);
      put(running ? observer.whirlPhase(i) : kNaN);
    }
    for (const Place& place : sampled.places) {
      put(running ? displacement(place.x, q) : kNaN);
      put(running ? displacement(place.y, q) : kNaN);
    }
    if (sampled.shaft) {
      const EvaluationPoint<double> at = observer.moment(i);
      put(at.speed);
      put(at.angle);
    }
    const Energies e = running ? observer.energies(i) : Energies{kNaN, kNaN, kNaN, kNaN, kNaN};
    put(e.kinetic);
    put(e.potential);
    put(e.jacobi);
  }
  for (const std::size_t i : controllers_) {
    for (const double output : observer.controller(i).output) {
      put(output);
    }
  }
  ++written_;
}

}  // namespace whirl_twin
