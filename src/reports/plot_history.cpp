#include "reports/plot_history.h"

#include <utility>

#include "algebra/constants.h"
#include "twin/ensemble_observer.h"

namespace whirl_twin {

namespace {

std::vector<CommandHistory> commandsOn(const Twin& twin, std::size_t system) {
  std::vector<CommandHistory> commands;
  const std::vector<ControllerSpec>& controllers = twin.scene().controllers;
  const std::vector<InputInfo> inputs = twin.systems()[system]->dynamics->inputs();
  for (std::size_t c = 0; c < controllers.size(); ++c) {
    for (std::size_t k = 0; k < controllers[c].acts_on.size(); ++k) {
      const ActedInput& acted = controllers[c].acts_on[k];
      if (acted.system == system) {
        const InputInfo& input = inputs[acted.input];
        commands.push_back({c, k, input.name, input.unit, controllers[c].actuator.limit, {}});
      }
    }
  }
  return commands;
}

}  // namespace

PlotHistoryWriter::PlotHistoryWriter(const Twin& twin, std::vector<std::size_t> systems,
                                     std::int64_t ensemble_stride)
    : twin_(twin),
      systems_(std::move(systems)),
      histories_(systems_.size()),
      ensemble_stride_(ensemble_stride) {
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    const std::size_t n = twin_.systems()[systems_[i]]->spec.q.size();
    histories_[i].coordinates.resize(n);
    histories_[i].rates.resize(n);
    histories_[i].commands = commandsOn(twin_, systems_[i]);
  }
}

void PlotHistoryWriter::write(const Observer& observer) {
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    const std::size_t system = systems_[i];
    const bool running = observer.status(system) == StepStatus::kOk;
    PlotHistory& history = histories_[i];
    history.time.push_back(twin_.seconds(observer.step()));
    for (std::size_t k = 0; k < history.coordinates.size(); ++k) {
      history.coordinates[k].push_back(running ? observer.coordinates(system)[k] : kNaN);
      history.rates[k].push_back(running ? observer.rates(system)[k] : kNaN);
    }
    const Energies e = running ? observer.energies(system) : Energies{kNaN, kNaN, kNaN, kNaN, kNaN};
    history.kinetic.push_back(e.kinetic);
    history.potential.push_back(e.potential);
    history.jacobi.push_back(e.jacobi);
    history.moments.push_back(observer.moment(system));
    history.speed.push_back(history.moments.back().speed);
    if (observer.isRotor(system)) {
      history.whirl_x.push_back(running ? observer.whirlOf(system).x : kNaN);
      history.whirl_y.push_back(running ? observer.whirlOf(system).y : kNaN);
      history.whirl_radius.push_back(running ? observer.whirlRadius(system) : kNaN);
      history.whirl_phase.push_back(running ? observer.whirlPhase(system) : kNaN);
    }
    for (CommandHistory& command : history.commands) {
      command.values.push_back(
          running ? observer.controller(command.controller).output[command.output] : kNaN);
    }
    if (twin_.ensemble(system) != nullptr && samples_ % ensemble_stride_ == 0) {
      writeEnsemble(system, history);
    }
  }
  ++samples_;
}

void PlotHistoryWriter::writeEnsemble(std::size_t system, PlotHistory& history) {
  const Ensemble& ensemble = *twin_.ensemble(system);
  record_.resize(ensemble.recordSize());
  ensemble.write(twin_.stepCount(), record_.data());
  history.ensemble.push_back(ensembleStatistics(ensemble, record_.data()));
  history.ensemble.back().at.time = twin_.time();
}

}  // namespace whirl_twin
