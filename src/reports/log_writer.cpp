#include <map>
#include <set>

#include "reports/output.h"
#include "reports/sample_writer.h"
#include "transport/lcm_event_log.h"
#include "twin/ensemble_statistics.h"

namespace whirl_twin {

namespace {

class LogWriter final : public SampleWriter {
 public:
  LogWriter(const Twin& twin, std::vector<std::size_t> systems, const std::string& path)
      : twin_(twin), systems_(std::move(systems)), pending_(path), log_(pending_.path()) {
    for (const std::size_t i : systems_) {
      const std::size_t drive = twin.systems()[i]->drive;
      if (drive < twin.scene().drives.size()) {  // the others are constant speeds, not drives
        drives_.insert(drive);
      }
    }
  }

  void write(const Observer& observer) override {
    for (const std::size_t i : systems_) {
      if (observer.status(i) != StepStatus::kOk) {
        continue;
      }
      if (observer.isRotor(i)) {
        log_.write(observer.whirl(i));
      } else {
        log_.write(observer.pendulum(i));
      }
    }
    for (const std::size_t drive : drives_) {
      log_.write(observer.drive(drive));
      if (twin_.isMotor(drive) && observer.status(twin_.turnedBy(drive)) == StepStatus::kOk) {
        log_.write(observer.motor(drive));
      }
    }
    for (const std::size_t i : systems_) {
      const Ensemble* const ensemble = twin_.ensemble(i);
      if (ensemble != nullptr && observer.step() >= next_ensemble_[i]) {
        writeEnsemble(observer, i);
        next_ensemble_[i] = (observer.step() / ensemble->period() + 1) * ensemble->period();
      }
    }
  }

  void finish() override {
    log_.finish();
    pending_.complete();
  }

 private:
  void writeEnsemble(const Observer& observer, std::size_t system) {
    const Ensemble& ensemble = *twin_.ensemble(system);
    record_.resize(ensemble.recordSize());
    ensemble.write(observer.step(), record_.data());
    state::EnsembleState state = ensembleStatistics(ensemble, record_.data());
    state.at = observer.instant();
    state.system = twin_.systems()[system]->spec.name;
    log_.write(state);
  }

  const Twin& twin_;
  std::vector<std::size_t> systems_;
  std::set<std::size_t> drives_;
  PendingFile pending_;
  EventLogWriter log_;
  std::map<std::size_t, std::int64_t> next_ensemble_;  // step, of each system
  std::vector<double> record_;                         // of an ensemble
};

}  // namespace

std::unique_ptr<SampleWriter> makeLogWriter(const Twin& twin, std::vector<std::size_t> systems,
                                            const std::string& path) {
  return std::make_unique<LogWriter>(twin, std::move(systems), path);
}

}  // namespace whirl_twin
