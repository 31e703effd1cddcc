// Studies: sweeps and optimizations, and fits to measured runs.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "python/listening.h"
#include "python/scene_object.h"
#include "requests/study_requests.h"
#include "studies/study_reader.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

Document sweepOf(const std::string& path, std::optional<std::string> output,
                 std::optional<std::uint64_t> point, unsigned workers, bool insist,
                 const py::object& progress) {
  SweepRequest request;
  request.output = std::move(output);
  request.point = point;
  request.workers = workers;
  request.insist = insist;
  request.with_points = true;
  Document document;
  runListening(progress, [&](WorkProgress& work) {
    document = sweepDocument(readStudy(path), request, work);
  });
  return document;
}

Document fitOf(const std::string& path, std::optional<std::string> output, bool validate_only,
               bool check, const std::string& lcm_prefix, const py::object& progress) {
  const FitRequest request{std::move(output), lcm_prefix, validate_only, check, true};
  Document document;
  runListening(progress,
               [&](WorkProgress& work) { document = fitDocument(path, request, work); });
  return document;
}

}  // namespace

void bindStudies(py::module_& module) {
  module.def("is_optimization", [](const std::string& path) {
    bool optimization = false;
    runListening(py::none(), [&](WorkProgress&) {
      optimization = readStudy(path).optimization.has_value();
    });
    return optimization;
  }, py::arg("study"));
  module.def("sweep", sweepOf, py::arg("study"), py::arg("output"), py::arg("point"),
             py::arg("workers"), py::arg("insist"), py::arg("progress"));
  module.def("fit", fitOf, py::arg("study"), py::arg("output"), py::arg("validate_only"),
             py::arg("check"), py::arg("lcm_prefix"), py::arg("progress"));
}

}  // namespace whirl_twin
