#include <set>

#include "tools/output.h"
#include "tools/sample_writer.h"
#include "transport/lcm_event_log.h"

namespace whirl_twin {

namespace {

class LogWriter final : public SampleWriter {
 public:
  LogWriter(const Twin& twin, std::vector<std::size_t> systems, const std::string& path)
      : systems_(std::move(systems)), pending_(path), log_(pending_.path()) {
    for (const std::size_t i : systems_) {
      const std::size_t drive = twin.members()[i].drive;
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
    }
  }

  void finish() override {
    log_.finish();
    pending_.complete();
  }

 private:
  std::vector<std::size_t> systems_;
  std::set<std::size_t> drives_;
  PendingFile pending_;
  EventLogWriter log_;
};

}  // namespace

std::unique_ptr<SampleWriter> makeLogWriter(const Twin& twin, std::vector<std::size_t> systems,
                                            const std::string& path) {
  return std::make_unique<LogWriter>(twin, std::move(systems), path);
}

}  // namespace whirl_twin
