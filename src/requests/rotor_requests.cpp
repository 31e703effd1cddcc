#include "requests/rotor_requests.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/campbell_report.h"
#include "reports/figure.h"
#include "reports/modes_report.h"
#include "reports/rotor_record.h"

namespace whirl_twin {

namespace {

constexpr double kFastestMode = 1.0e6;  // rad/s

/// Kept as long as a figure can be drawn of them: reports point at them.
struct SceneRotors {
  SceneRotors(const Scene& read, const std::optional<std::string>& system)
      : scene(build(read)), rotors(rotorSystems(scene, system)) {}

  BuiltScene scene;
  std::vector<RotorSystem> rotors;
};

std::shared_ptr<const SceneRotors> rotorsOf(const Scene& scene,
                                            const std::optional<std::string>& system) {
  return std::make_shared<const SceneRotors>(scene, system);
}

/// `make` gives the report of a rotor that json(), text() and tables() take, `draw` its figure.
template <class Make, class Draw>
Document rotorDocument(const std::shared_ptr<const SceneRotors>& of, const ShownUnits& units,
                       const Make& make, const Draw& draw) {
  Document document;
  document.json["scene"] = of->scene.scene.name;
  for (const RotorSystem& rotor : of->rotors) {
    const auto report = std::make_shared<const decltype(make(rotor))>(make(rotor));
    document.json["systems"][rotor.name] = json(*report);
    append(document.tables, rotor.name, tables(*report));
    document.text += (document.text.empty() ? "" : "\n") + text(*report, units);
    document.drawings.push_back(
        {rotor.name, [of, report, draw] { return figureJson(draw(*report)); }});
  }
  return document;
}

template <class Make>
Document rotorDocument(const std::shared_ptr<const SceneRotors>& of, const ShownUnits& units,
                       const Make& make) {
  return rotorDocument(of, units, make,
                       [units](const auto& report) { return figure(report, units); });
}

void requireNumbers(const CampbellReportRequest& request) {
  for (const double harmonic : request.harmonics) {
    if (!(harmonic > 0.0 && harmonic <= 100.0)) {
      throw InputError("--harmonic: expected multiples of the speed above 0 and up to 100, found " +
                       std::to_string(harmonic));
    }
  }
  if (request.modes < 1 || request.modes > 1000) {
    throw InputError("--modes: expected from 1 to 1000, found " + std::to_string(request.modes));
  }
}

void requireModesUse(const ModesRequest& request) {
  if (request.speed && !(*request.speed >= 0.0 && *request.speed <= kFastestMode)) {
    throw InputError("--speed: expected a shaft speed from 0 to 1e+06 rad/s");
  }
  if (request.limit && !request.measured) {
    throw InputError("--to: needs --measured LOG");
  }
  if (request.modes < 1 || request.modes > 100) {
    throw InputError("--modes: expected from 1 to 100, found " + std::to_string(request.modes));
  }
  requireLcmPrefix(request.lcm_prefix);
}

}  // namespace

Document campbellDocument(const Scene& scene, const CampbellReportRequest& request,
                          WorkProgress& progress, const ShownUnits& units) {
  requireNumbers(request);
  const auto of = rotorsOf(scene, request.system);
  AskedCost cost;
  for (const RotorSystem& rotor : of->rotors) {
    cost += costOfCampbell(rotor.name, rotor.dynamics->dof(), request.range.points);
  }
  tell(cost, request.insist);
  const auto speeds = static_cast<std::int64_t>(of->rotors.size()) * request.range.points;
  progress.begin(cost.cause, speeds, request.insist);
  std::int64_t before = 0;  // speeds of the rotors that are done
  Document document = rotorDocument(of, units, [&](const RotorSystem& rotor) {
    CampbellReport one = campbellReport(
        rotor, request.range.of(rotor), request.harmonics, static_cast<std::size_t>(request.modes),
        [&](std::size_t done) { progress.show(before + static_cast<std::int64_t>(done)); });
    before += request.range.points;
    return one;
  });
  progress.clear();
  return document;
}

Document responseDocument(const Scene& scene, const ResponseRequest& request,
                          const ShownUnits& units) {
  const auto of = rotorsOf(scene, request.system);
  if (request.force) {
    ForcedRequest force = *request.force;
    force.from = request.range.from;
    force.to = request.range.to;
    force.points = request.range.points;
    return rotorDocument(of, units,
                         [&](const RotorSystem& rotor) { return forcedReport(rotor, force); });
  }
  return rotorDocument(of, units, [&](const RotorSystem& rotor) {
    tell(costOfResponse(rotor.name, rotor.dynamics->dof(), request.range.points), request.insist);
    return responseReport(rotor, request.range.of(rotor), request.station);
  });
}

Document orbitDocument(const Scene& scene, const std::optional<std::string>& system, double speed,
                       const ShownUnits& units) {
  return rotorDocument(rotorsOf(scene, system), units,
                       [&](const RotorSystem& rotor) { return orbitReport(rotor, speed); });
}

Document modesDocument(const Scene& scene, const ModesRequest& request, const ShownUnits& units) {
  requireModesUse(request);
  const auto of = rotorsOf(scene, request.system);
  if (request.measured && of->rotors.size() > 1) {
    throw InputError("--system: missing; must name the rotor that the log belongs to");
  }
  const auto report = [&](const RotorSystem& rotor) {
    return request.measured
               ? modesReport(rotor,
                             RotorRecord(of->scene, rotor,
                                         {*request.measured, request.lcm_prefix, request.import},
                                         ProbesRead::kAtSameInstants),
                             request.speed, request.limit)
               : modesReport(rotor, request.speed.value_or(rotor.highest_speed));
  };
  const auto count = static_cast<std::size_t>(request.modes);
  Document document = rotorDocument(
      of, units, report, [=](const ModesReport& modes) { return figure(modes, count, units); });
  if (request.measured) {  // the shapes drawn are those of the model
    document.drawings.clear();
  }
  return document;
}

Document stabilityDocument(const Scene& scene, const std::optional<std::string>& system,
                           const LevelOneRequest& request, const ShownUnits& units) {
  return rotorDocument(rotorsOf(scene, system), units,
                       [&](const RotorSystem& rotor) { return levelOneReport(rotor, request); });
}

Document mapDocument(const Scene& scene, const std::optional<std::string>& system,
                     const CriticalMapRequest& request, const ShownUnits& units) {
  return rotorDocument(rotorsOf(scene, system), units,
                       [&](const RotorSystem& rotor) { return criticalMapReport(rotor, request); });
}

Document balanceDocument(const Scene& scene, const MeasuredBalanceRequest& request) {
  const UnbalanceRequest& unbalance = request.unbalance;
  if (!(unbalance.from >= 0.0 && unbalance.from < unbalance.to)) {
    throw InputError(fmt::format("--from, --to: --from must be < --to, found {:g} and {:g} rad/s",
                                 unbalance.from, unbalance.to));
  }
  requireLcmPrefix(request.lcm_prefix);
  const SceneRotors of(scene, request.system);
  if (of.rotors.size() > 1) {
    throw InputError("--system: missing; must name the rotor that the log belongs to");
  }
  const RotorSystem& rotor = of.rotors.front();
  const UnbalanceReport report = unbalanceReport(
      rotor, RotorRecord(of.scene, rotor, {request.measured, request.lcm_prefix, request.import}),
      unbalance);
  Document document;
  document.json = json(report);
  document.text = text(report);
  document.tables = tables(report);
  return document;
}

}  // namespace whirl_twin
