// A twin stepped from Python.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "messages/input_error.h"
#include "python/conversions.h"
#include "python/listening.h"
#include "python/scene_object.h"
#include "python/stepped_twin.h"
#include "scene/parameter_paths.h"
#include "twin/stop_text.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

py::array_t<double> arrayOf(const double* values, std::size_t count) {
  return py::array_t<double>(static_cast<py::ssize_t>(count), values);
}

py::dict stateOf(const SteppedTwin& stepped, const std::string& system) {
  const std::size_t i = stepped.systemNamed(system);
  const Observer& observer = stepped.observer();
  const BuiltSystem& built = *stepped.twin().systems()[i];
  const std::size_t n = built.spec.q.size();
  const auto dof = static_cast<Eigen::Index>(n);
  py::dict state;
  state["q"] = arrayOf(observer.coordinates(i), n);
  state["v"] = arrayOf(observer.rates(i), n);
  if (built.dynamics->hasShaft()) {
    const EvaluationPoint<double> at = observer.moment(i);
    state["shaft_speed"] = at.speed;
    state["shaft_angle"] = at.angle;
  }
  if (built.dynamics->isRotor()) {
    state["whirl_radius"] = observer.whirlRadius(i);
    state["whirl_phase"] = observer.whirlPhase(i);
  }
  const std::vector<Station> stations = built.dynamics->places();
  if (!stations.empty()) {
    const Eigen::Map<const Eigen::VectorXd> q(observer.coordinates(i), dof);
    std::vector<double> x, y;
    for (const Station& station : stations) {
      x.push_back(station.along_x.dot(q));
      y.push_back(station.along_y.dot(q));
    }
    state["x"] = arrayOf(x.data(), x.size());
    state["y"] = arrayOf(y.data(), y.size());
  }
  const Energies energies = observer.energies(i);
  state["kinetic_energy"] = energies.kinetic;
  state["potential_energy"] = energies.potential;
  return state;
}

py::dict namesOf(const SteppedTwin& stepped, const std::string& system) {
  const Dynamics& dynamics = *stepped.twin().systems()[stepped.systemNamed(system)]->dynamics;
  py::list coordinates, inputs, stations;
  for (const CoordinateInfo& c : dynamics.coordinates()) {
    coordinates.append(pythonText(c.name));
  }
  for (const InputInfo& input : dynamics.inputs()) {
    inputs.append(pythonText(input.name));
  }
  for (const Station& station : dynamics.places()) {
    stations.append(pythonText(station.name));
  }
  py::dict names;
  names["coordinates"] = coordinates;
  names["inputs"] = inputs;
  names["stations"] = stations;
  return names;
}

std::string statusOf(const SteppedTwin& stepped, const std::string& system) {
  const StepStatus status = stepped.twin().status(stepped.systemNamed(system));
  return status == StepStatus::kOk ? "ok" : describe(status);
}

/// In the unit of the input; an unknown input is an error of setInput().
void putInput(SteppedTwin& stepped, const std::string& system, const std::string& input,
              const py::handle& value, std::optional<double> duration) {
  std::string unit = "-";
  const BuiltSystem& built = *stepped.twin().systems()[stepped.systemNamed(system)];
  for (const InputInfo& info : built.dynamics->inputs()) {
    if (info.name == input) {
      unit = info.unit;
    }
  }
  stepped.setInput(system, input, quantityOf(system + "." + input, value, unit), duration);
}

/// In the unit of the parameter; an unknown path is an error of setParameter().
void putParameter(SteppedTwin& stepped, const std::string& system, const std::string& path,
                  const py::handle& value) {
  const BuiltSystem& built = *stepped.twin().systems()[stepped.systemNamed(system)];
  const std::string unit = unitAt(path, *built.model, built.spec);
  stepped.setParameter(system, path,
                       quantityOf(system + "." + path, value, unit.empty() ? "-" : unit));
}

std::unique_ptr<SteppedTwin> made(const SharedScene& scene) {
  std::unique_ptr<SteppedTwin> twin;
  runListening(py::none(),
               [&](WorkProgress&) { twin = std::make_unique<SteppedTwin>(scene->scene); });
  return twin;
}

void stepBy(SteppedTwin& stepped, std::int64_t count) {
  if (count < 0) {
    throw InputError(fmt::format("step: must be 0 steps or more, found {}", count));
  }
  stepped.requireIdle();
  stepped.stepping = true;
  try {
    const py::gil_scoped_release release;
    stepped.step(count, requireNoSignal);
  } catch (...) {
    stepped.stepping = false;
    throw;
  }
  stepped.stepping = false;
}

}  // namespace

void bindTwin(py::module_& module) {
  py::class_<SteppedTwin>(module, "Twin")
      .def(py::init(&made), py::arg("scene"))
      .def("step", stepBy, py::arg("count"))
      .def("reset", &SteppedTwin::reset)
      .def_property_readonly("time", [](const SteppedTwin& s) { return s.twin().time(); })
      .def_property_readonly("steps", [](const SteppedTwin& s) { return s.twin().stepCount(); })
      .def("state", stateOf, py::arg("system"))
      .def("names", namesOf, py::arg("system"))
      .def("status", statusOf, py::arg("system"))
      .def("set_input", putInput, py::arg("system"), py::arg("input"), py::arg("value"),
           py::arg("duration"))
      .def("set_parameter", putParameter, py::arg("system"), py::arg("path"), py::arg("value"))
      .def("parameter", &SteppedTwin::parameter, py::arg("system"), py::arg("path"))
      .def("save", [](SteppedTwin& s) { return py::bytes(s.save()); })
      .def(
          "restore", [](SteppedTwin& s, const py::bytes& bytes) { s.restore(bytes); },
          py::arg("state"));
}

}  // namespace whirl_twin
