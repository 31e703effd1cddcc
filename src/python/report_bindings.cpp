// The reports on a scene: analysis, Campbell diagram, response, orbits, modes, stability, loops,
// critical speed map, balancing; and on a polynomial.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/conversions.h"
#include "python/listening.h"
#include "python/scene_object.h"
#include "requests/document.h"
#include "requests/field_balancing.h"
#include "requests/rotor_requests.h"
#include "requests/routh_request.h"
#include "requests/scene_requests.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

using Name = std::optional<std::string>;
using Number = std::optional<double>;

std::vector<Stage> stagesOf(const std::vector<std::array<double, 4>>& centrifugal,
                            const std::vector<std::array<double, 3>>& axial) {
  std::vector<Stage> stages;
  for (const auto& [power, diameter, width, ratio] : centrifugal) {
    stages.push_back({power, diameter, width, ratio, false});
  }
  for (const auto& [power, diameter, height] : axial) {
    stages.push_back({power, diameter, height, 1.0, true});
  }
  return stages;
}

py::list tablesOf(const Document& document) {
  py::list tables;
  for (const CsvTable& table : document.tables) {
    tables.append(pythonOf(table));
  }
  return tables;
}

py::list figuresOf(const Document& document) {
  py::list names;
  for (const Drawing& drawing : document.drawings) {
    names.append(pythonText(drawing.name));
  }
  return names;
}

py::object figureOf(const Document& document, std::size_t index) {
  if (index >= document.drawings.size()) {
    throw py::index_error("no such figure");
  }
  return pythonOf(document.drawings[index].draw());
}

}  // namespace

void bindReports(py::module_& module) {
  py::class_<Document>(module, "Document")
      .def("to_dict", [](const Document& d) { return pythonOf(d.json); })
      .def_property_readonly("text", [](const Document& d) { return pythonText(d.text); })
      .def_readonly("done", &Document::done)
      .def_property_readonly("failure", [](const Document& d) { return pythonText(d.failure); })
      .def("tables", tablesOf)
      .def("figures", figuresOf)
      .def("figure", figureOf, py::arg("index"));

  module.def(
      "analyze",
      [](const SharedScene& scene, Name system, Number speed, Name at, bool all_parameters,
         const std::string& modes, bool insist) {
        AnalyzeRequest request{std::move(system), speed, std::move(at),
                               all_parameters,    modes, insist};
        Document document;
        runListening(py::none(), [&](WorkProgress& work) {
          document = analyzeDocument(scene->scene, request, work);
        });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("speed"), py::arg("at"),
      py::arg("all_parameters"), py::arg("modes"), py::arg("insist"));
  module.def(
      "campbell",
      [](const SharedScene& scene, Name system, Number from, Number to, int points,
         std::vector<double> harmonics, int modes, bool insist, const py::object& progress) {
        const CampbellReportRequest request{
            std::move(system), {from, to, points}, std::move(harmonics), modes, insist};
        Document document;
        runListening(progress, [&](WorkProgress& work) {
          document = campbellDocument(scene->scene, request, work);
        });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("start"), py::arg("stop"), py::arg("points"),
      py::arg("harmonics"), py::arg("modes"), py::arg("insist"), py::arg("progress"));
  module.def(
      "response",
      [](const SharedScene& scene, Name system, Name station, Number from, Number to, int points,
         const Name& force, const std::string& along, std::vector<std::string> at, Number speed,
         bool insist) {
        ResponseRequest request{
            std::move(system), std::move(station), {from, to, points}, std::nullopt, insist};
        if (force) {
          request.force.emplace();
          request.force->force = *force;
          request.force->along = along;
          request.force->at = std::move(at);
          request.force->speed = speed;
        }
        Document document;
        runListening(py::none(),
                     [&](WorkProgress&) { document = responseDocument(scene->scene, request); });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("station"), py::arg("start"), py::arg("stop"),
      py::arg("points"), py::arg("force"), py::arg("along"), py::arg("at"), py::arg("speed"),
      py::arg("insist"));
  module.def(
      "orbit",
      [](const SharedScene& scene, const Name& system, double speed) {
        Document document;
        runListening(py::none(),
                     [&](WorkProgress&) { document = orbitDocument(scene->scene, system, speed); });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("speed"));
  module.def(
      "modes",
      [](const SharedScene& scene, Name system, Name measured, Number speed, Number limit,
         int modes, const std::string& lcm_prefix, Name import) {
        const ModesRequest request{std::move(system), std::move(measured), speed, limit, modes,
                                   lcm_prefix,        std::move(import)};
        Document document;
        runListening(py::none(),
                     [&](WorkProgress&) { document = modesDocument(scene->scene, request); });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("measured"), py::arg("speed"), py::arg("limit"),
      py::arg("modes"), py::arg("lcm_prefix"), py::arg("import_settings"));
  module.def(
      "stability",
      [](const SharedScene& scene, const Name& system, Number speed, Name at,
         const std::vector<std::array<double, 4>>& stages,
         const std::vector<std::array<double, 3>>& axial_stages) {
        const LevelOneRequest request{speed, std::move(at), stagesOf(stages, axial_stages)};
        Document document;
        runListening(py::none(), [&](WorkProgress&) {
          document = stabilityDocument(scene->scene, system, request);
        });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("speed"), py::arg("at"), py::arg("stages"),
      py::arg("axial_stages"));
  module.def(
      "critical_map",
      [](const SharedScene& scene, const Name& system, Number from, Number to, int points,
         int modes, std::vector<int> nodes) {
        const CriticalMapRequest request{from, to, points, modes, std::move(nodes)};
        Document document;
        runListening(py::none(),
                     [&](WorkProgress&) { document = mapDocument(scene->scene, system, request); });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("start"), py::arg("stop"), py::arg("points"),
      py::arg("modes"), py::arg("bearings"));
  module.def(
      "balance",
      [](const SharedScene& scene, Name system, std::string measured,
         std::vector<std::string> planes, Number from, Number to, bool run_out_known,
         std::string lcm_prefix, Name import) {
        MeasuredBalanceRequest request{
            std::move(system), std::move(measured), {}, std::move(lcm_prefix), std::move(import)};
        request.unbalance.planes = std::move(planes);
        request.unbalance.run_out_known = run_out_known;
        request.unbalance.from = from.value_or(request.unbalance.from);
        request.unbalance.to = to.value_or(request.unbalance.to);
        Document document;
        runListening(py::none(),
                     [&](WorkProgress&) { document = balanceDocument(scene->scene, request); });
        return document;
      },
      py::arg("scene"), py::arg("system"), py::arg("measured"), py::arg("planes"), py::arg("start"),
      py::arg("stop"), py::arg("run_out_known"), py::arg("lcm_prefix"), py::arg("import_settings"));
  module.def(
      "balance_job",
      [](const py::object& job) {
        const BalancingJob read = py::isinstance<py::str>(job)
                                      ? readBalancingJob(job.cast<std::string>())
                                      : readBalancingJob(treeOf(job), "job");
        return fieldBalancingDocument(read);
      },
      py::arg("job"));
  module.def(
      "loop",
      [](const SharedScene& scene, Number speed) {
        Document document;
        runListening(py::none(),
                     [&](WorkProgress&) { document = loopDocument(scene->scene, speed); });
        return document;
      },
      py::arg("scene"), py::arg("speed"));
  module.def(
      "routh",
      [](std::vector<std::string> coefficients, Name parameter, bool insist) {
        const RouthRequest request{std::move(coefficients), std::move(parameter), insist};
        Document document;
        runListening(py::none(), [&](WorkProgress&) { document = routhDocument(request); });
        return document;
      },
      py::arg("coefficients"), py::arg("parameter"), py::arg("insist"));
}

}  // namespace whirl_twin
