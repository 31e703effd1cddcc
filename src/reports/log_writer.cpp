// Samples of a run as the messages of a node, in a log.
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reports/output.h"
#include "reports/sample_writer.h"
#include "transport/lcm_event_log.h"
#include "transport/mcap_writer.h"
#include "twin/ensemble.h"
#include "twin/ensemble_observer.h"
#include "twin/order_observer.h"
#include "twin/step_messages.h"

namespace whirl_twin {

namespace {

/// Log: EventLogWriter or McapLog.
template <class Log>
class LogWriter final : public SampleWriter {
 public:
  LogWriter(const Twin& twin, std::vector<std::size_t> systems, state::SceneText scene,
            const std::string& path)
      : twin_(twin),
        messages_(twin.built(), std::move(systems)),
        orders_(twin),
        scene_(std::move(scene)),
        pending_(path),
        log_(pending_.path()) {}

  void write(const Observer& observer) override {
    if (!scene_.line.empty()) {  // before the first state
      scene_.at = observer.instant();
      log_.write(scene_);
      scene_.line.clear();
    }
    messages_.tell(observer, true, sinkAt(observer));
    const auto take = [this](std::size_t system, const state::Instant& now,
                             state::EnsembleState& ensemble) {
      return takeEnsemble(system, now, ensemble);
    };
    messages_.tellEnsembles(observer, take, sinkAt(observer));
  }

  bool followsSteps() const override { return true; }
  bool hasToSee(std::int64_t step) const override { return orders_.dueAt(step); }
  void follow(const double* record, const Observer& observer) override {
    orders_.take(record, observer);
    if (RecordLayout::step(record) == observer.step()) {
      messages_.tellOrders(observer, orders_, sinkAt(observer));
    }
  }

  void write(const state::Measurement& measurement) override { log_.write(measurement); }

  void write(const state::FollowState& state) override { log_.write(state); }

  void finish() override {
    log_.finish();
    pending_.complete();
  }

 private:
  struct Sink {
    Log& log;
    double now;  // [s]

    template <class Make>
    void operator()(const std::string&, Make make) {
      log.write(make());
    }
    void change(const state::ParameterChange& change) { log.write(change); }
    void again(const state::ParameterChange& change) { log.writeAt(now, change); }
  };

  Sink sinkAt(const Observer& observer) { return {log_, observer.instant().time}; }

  /// As often as a live twin has one, at the samples.
  bool takeEnsemble(std::size_t system, const state::Instant& now, state::EnsembleState& out) {
    const Ensemble& ensemble = *twin_.ensemble(system);
    if (now.step < next_ensemble_[system]) {
      return false;
    }
    next_ensemble_[system] = (now.step / ensemble.period() + 1) * ensemble.period();
    record_.resize(ensemble.recordSize());
    ensemble.write(now.step, record_.data());
    out = ensembleStatistics(ensemble, record_.data());
    out.at = now;
    out.system = twin_.systems()[system]->spec.name;
    return true;
  }

  const Twin& twin_;
  StepMessages messages_;
  OrderObserver orders_;
  state::SceneText scene_;  // without lines once it is written
  PendingFile pending_;
  Log log_;
  std::map<std::size_t, std::int64_t> next_ensemble_;  // step, of each system
  std::vector<double> record_;                         // of an ensemble
};

}  // namespace

std::unique_ptr<SampleWriter> makeLogWriter(const Twin& twin, std::vector<std::size_t> systems,
                                            state::SceneText scene, const std::string& path) {
  if (std::filesystem::path(path).extension() == ".mcap") {
    return std::make_unique<LogWriter<McapLog>>(twin, std::move(systems), std::move(scene), path);
  }
  return std::make_unique<LogWriter<EventLogWriter>>(twin, std::move(systems), std::move(scene),
                                                     path);
}

}  // namespace whirl_twin
