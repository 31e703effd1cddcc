#include "requests/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "messages/input_error.h"
#include "realtime/denormals.h"
#include "twin/ensemble_observer.h"
#include "twin/stop_text.h"

namespace whirl_twin {

namespace {

constexpr auto kSavePeriod = std::chrono::seconds(5);
constexpr std::int64_t kStepsAtOnce = 16;  // between two polls for an interrupt

}  // namespace

Simulation::Simulation(const SimulationPlan& plan)
    : plan_(plan),
      twin_(plan.scene),
      observer_(twin_),
      measurements_(plan.sensors, twin_.built(), observer_),
      validity_(twin_, plan_.systems),
      accuracy_(twin_, plan_.systems),
      stopped_(plan.scene.systems.size()) {
  twin_.buildEnsembles();
  if (plan_.checkpoint || plan_.resume) {
    checkpoint_.scene = sceneLines(plan_.tree, twin_);
  }
  if (plan_.resume) {
    resumeFrom(*plan_.resume);
  }
}

void Simulation::resumeFrom(const std::string& path) {
  const Checkpoint from = readCheckpoint(path);
  requireScene(from, checkpoint_.scene, path);
  if (from.live["changes"]) {
    throw InputError(
        fmt::format("{}: parameters were changed live; resume it with simulation_node", path));
  }
  if (from.step >= plan_.steps) {
    throw InputError(fmt::format("--duration: must be more than the {} steps of {}, found {} steps",
                                 from.step, path, plan_.steps));
  }
  restore(from, twin_, path);
  restore(from, observer_, path);
  for (std::size_t i = 0; i < stopped_.size(); ++i) {
    if (twin_.status(i) != StepStatus::kOk) {
      const YAML::Node stopped = from.live["stopped"][plan_.scene.systems[i].name];
      stopped_[i] = stopped ? stopped.as<std::int64_t>(from.step) : from.step;
    }
  }
}

void Simulation::save() {
  checkpoint_.step = twin_.stepCount();
  checkpoint_.twin = imageOf(twin_);
  checkpoint_.observer = imageOf(observer_);
  for (std::size_t i = 0; i < stopped_.size(); ++i) {
    if (stopped_[i]) {
      checkpoint_.live["stopped"][plan_.scene.systems[i].name] = *stopped_[i];
    }
  }
  writeCheckpoint(*plan_.checkpoint, bytesOf(checkpoint_));
}

void Simulation::run(SampleWriter* writer, WorkProgress& progress) {
  const DenormalsToZero denormals_to_zero;  // as in the real-time loop: identical numbers
  progress.begin(plan_.asked(), plan_.steps, plan_.insist);
  std::vector<double> record(twin_.layout().size);
  warn(progress);
  const bool every_step = !plan_.sensors.empty() || validity_.watches();
  const bool followed = writer != nullptr && writer->followsSteps();
  if (writer != nullptr) {
    writer->write(observer_);
  }
  if (followed) {
    twin_.write(record.data());
    writer->follow(record.data(), observer_);
  }
  std::int64_t i = twin_.stepCount();
  std::int64_t next_sample =
      writer != nullptr ? (i / plan_.stride + 1) * plan_.stride : plan_.steps;
  std::int64_t next_bar = i + 1;
  auto next_save = std::chrono::steady_clock::now() + kSavePeriod;
  while (i < plan_.steps) {
    const std::int64_t passed = every_step || i == 0 ? 1 : observer_.mostPassed();
    const std::int64_t due = std::min({i + passed, next_sample, plan_.steps});
    i = followed ? stepFollowed(due, *writer, record, progress) : stepUnseen(due, progress);
    twin_.write(record.data());
    observer_.observe(record.data());
    noteStops(progress);
    warn(progress);
    if (writer != nullptr && i == next_sample) {
      writer->write(observer_);
      next_sample += plan_.stride;
    }
    if (followed) {
      writer->follow(record.data(), observer_);
    }
    if (!plan_.sensors.empty()) {
      for (const state::Measurement& block : measurements_.observe(observer_)) {
        writer->write(block);
      }
    }
    if (i >= next_bar) {
      next_bar = i + progress.show(i);
    }
    const bool asked_to_end = progress.interrupted();
    if (plan_.checkpoint && (asked_to_end || std::chrono::steady_clock::now() >= next_save)) {
      save();
      next_save = std::chrono::steady_clock::now() + kSavePeriod;
    }
    if (asked_to_end) {
      throw RunFailure(fmt::format("interrupted after {} of {} steps", i, plan_.steps));
    }
  }
  if (plan_.checkpoint) {
    save();
  }
  progress.clear();
  for (const state::Measurement& block : measurements_.finish()) {
    writer->write(block);
  }
}

/// Advances by at least a step, to one that must be observed: the one due or one before it.
std::int64_t Simulation::stepUnseen(std::int64_t due, WorkProgress& progress) {
  const std::int64_t at_once = observer_.looks() ? 1 : kStepsAtOnce;
  std::int64_t i = twin_.stepCount();
  while (true) {
    i += twin_.steps(std::min(due - i, at_once));
    if (i == due || progress.interrupted() || stopsNow() || !observer_.look(twin_)) {
      return i;
    }
  }
}

/// As stepUnseen(), with every record passed to the writer.
std::int64_t Simulation::stepFollowed(std::int64_t due, SampleWriter& writer,
                                      std::vector<double>& record, WorkProgress& progress) {
  std::int64_t i = twin_.stepCount();
  while (true) {
    twin_.step();
    ++i;
    if (i == due || progress.interrupted() || stopsNow() || writer.hasToSee(i)) {
      return i;
    }
    twin_.write(record.data());
    if (!observer_.look(record.data())) {
      return i;
    }
    writer.follow(record.data(), observer_);
  }
}

bool Simulation::sound() const {
  for (const std::size_t i : plan_.systems) {
    if (twin_.status(i) != StepStatus::kOk) {
      return false;
    }
  }
  return true;
}

/// Has a system stopped that has not been reported?
bool Simulation::stopsNow() const {
  return std::any_of(plan_.systems.begin(), plan_.systems.end(), [&](std::size_t i) {
    return twin_.status(i) != StepStatus::kOk && !stopped_[i];
  });
}

void Simulation::noteStops(WorkProgress& progress) {
  for (const std::size_t i : plan_.systems) {
    if (twin_.status(i) != StepStatus::kOk && !stopped_[i]) {
      stopped_[i] = observer_.step();
      progress.clear();
      complain(fmt::format("twin: {}\n", observer_.stopReason(i)));
    }
  }
}

void Simulation::warn(WorkProgress& progress) {
  std::vector<std::string> warnings = validity_.look(observer_);
  for (std::string& warning : accuracy_.look(observer_)) {
    warnings.push_back(std::move(warning));
  }
  for (const std::string& warning : warnings) {
    progress.clear();
    complain(fmt::format("twin: {}\n", warning));
  }
}

Json Simulation::systemJson(std::size_t system) const {
  const BuiltSystem& built = *twin_.systems()[system];
  Json json;
  json["model"] = built.spec.model;
  json["integrator"] = built.integrator;
  json["substeps"] = built.spec.substeps;
  json["status"] = stopped_[system] ? describe(twin_.status(system)) : "ok";
  json["steps"] = stopped_[system] ? *stopped_[system] - 1 : observer_.step();
  Json& state = json["state"];
  const std::vector<CoordinateInfo> coordinates = built.dynamics->coordinates();
  for (std::size_t k = 0; k < built.spec.q.size(); ++k) {
    const std::string name = coordinates[k].name;
    state[name] = observer_.coordinates(system)[k];
    state[name + "_rate"] = observer_.rates(system)[k];
  }
  if (built.dynamics->isRotor()) {
    json["whirl_radius"] = observer_.whirlRadius(system);
    json["whirl_phase"] = observer_.whirlPhase(system);
  }
  if (stopped_[system]) {
    json["energy"] = nullptr;  // the shaft has continued without it
  } else {
    const Energies e = observer_.energies(system);
    json["energy"] = {{"kinetic", e.kinetic}, {"potential", e.potential}, {"jacobi", e.jacobi}};
  }
  json["energy_residual"] = observer_.energyResidual(system);
  json["error_estimate"] = observer_.errorEstimate(system);
  const std::optional<double> lost = accuracy_.lostAt(system);
  json["accuracy_lost"] = lost ? Json(*lost) : Json();
  json["invalid"] = validity_.json(system);
  if (twin_.ensemble(system) != nullptr) {
    json["ensemble"] = ensembleJson(*twin_.ensemble(system));
  }
  return json;
}

Json Simulation::ensembleJson(const Ensemble& ensemble) const {
  std::vector<double> record(ensemble.recordSize());
  ensemble.write(twin_.stepCount(), record.data());
  const state::EnsembleState s = ensembleStatistics(ensemble, record.data());
  Json json;
  json["count"] = s.count;
  json["running"] = s.running;
  for (std::size_t k = 0; k < s.quantity.size(); ++k) {
    json[s.quantity[k]] = {{"unit", s.unit[k]},
                           {"mean", s.mean[k]},
                           {"standard_deviation", s.standard_deviation[k]},
                           {"smallest", s.smallest[k]},
                           {"percentile_5", s.percentile_5[k]},
                           {"percentile_25", s.percentile_25[k]},
                           {"median", s.median[k]},
                           {"percentile_75", s.percentile_75[k]},
                           {"percentile_95", s.percentile_95[k]},
                           {"largest", s.largest[k]},
                           {"peak",
                            {{"mean", s.peak_mean[k]},
                             {"standard_deviation", s.peak_standard_deviation[k]},
                             {"percentile_5", s.peak_percentile_5[k]},
                             {"median", s.peak_median[k]},
                             {"percentile_95", s.peak_percentile_95[k]},
                             {"largest", s.peak_largest[k]}}}};
  }
  return json;
}

Json Simulation::json() const {
  Json json;
  json["scene"] = plan_.scene.name;
  json["step"] = plan_.scene.stepSeconds();
  json["duration"] = static_cast<double>(plan_.steps * plan_.scene.step) / 1.0e9;
  json["steps"] = plan_.steps;
  json["time"] = twin_.seconds(plan_.steps);
  Json& systems = json["systems"];
  for (const std::size_t i : plan_.systems) {
    systems[plan_.scene.systems[i].name] = systemJson(i);
  }
  return json;
}

}  // namespace whirl_twin
