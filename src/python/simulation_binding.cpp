// Runs of a scene, sampled into arrays.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "python/conversions.h"
#include "python/listening.h"
#include "python/sampled_run.h"
#include "python/scene_object.h"
#include "reports/rotor_systems.h"
#include "requests/simulation.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

/// Those named, in the order of the scene, each once.
std::vector<std::size_t> placesOf(const Scene& scene, const std::vector<std::string>& names) {
  std::set<std::size_t> places;
  for (const std::string& name : names) {
    places.insert(selectedSystems(scene, name).front());
  }
  return {places.begin(), places.end()};
}

/// [signal][sample], owner of the memory.
py::array arrayOf(SampledRun& run) {
  double* const values = run.takeValues().release();
  const py::capsule owner(values, [](void* memory) { std::free(memory); });
  const auto rows = static_cast<py::ssize_t>(run.signals().size());
  const auto samples = static_cast<py::ssize_t>(run.samples());
  return py::array_t<double>({rows, samples},
                             {samples * static_cast<py::ssize_t>(sizeof(double)),
                              static_cast<py::ssize_t>(sizeof(double))},
                             values, owner);
}

py::tuple simulate(const SharedScene& scene, const std::optional<std::vector<std::string>>& systems,
                   const std::optional<std::string>& duration,
                   const std::optional<std::string>& sample, const std::optional<std::string>& step,
                   const std::optional<std::string>& integrator, bool insist,
                   const py::object& progress) {
  SimulationRequest request;
  request.duration = duration;
  request.sample = sample;
  request.step = step;
  request.integrator = integrator;
  request.insist = insist;
  std::unique_ptr<Simulation> simulation;
  std::unique_ptr<SampledRun> run;
  Json json;
  runListening(progress, [&](WorkProgress& work) {
    SimulationPlan plan = planSimulation(scene->scene, request);
    if (systems) {
      plan.systems = placesOf(plan.scene, *systems);
    }
    simulation = std::make_unique<Simulation>(plan);
    run = std::make_unique<SampledRun>(simulation->twin(), plan.systems,
                                       static_cast<std::size_t>(plan.steps / plan.stride + 1),
                                       insist);
    simulation->run(run.get(), work);
    json = simulation->json();
  });
  py::list names;
  py::list units;
  for (const SignalName& signal : run->signals()) {
    names.append(pythonText(signal.name));
    units.append(pythonText(signal.unit));
  }
  return py::make_tuple(names, units, arrayOf(*run), pythonOf(json), simulation->sound());
}

}  // namespace

void bindSimulation(py::module_& module) {
  module.def("simulate", simulate, py::arg("scene"), py::arg("systems"), py::arg("duration"),
             py::arg("sample"), py::arg("step"), py::arg("integrator"), py::arg("insist"),
             py::arg("progress"));
}

}  // namespace whirl_twin
