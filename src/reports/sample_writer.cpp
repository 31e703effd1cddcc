#include "reports/sample_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "algebra/constants.h"
#include "messages/csv_cell.h"
#include "messages/input_error.h"
#include "reports/output.h"
#include "scene/control_parts.h"
#include "transport/lcm_event_log.h"
#include "transport/mcap_writer.h"
#include "twin/ensemble_observer.h"
#include "twin/order_observer.h"
#include "twin/step_messages.h"

namespace whirl_twin {

namespace {

class TableWriter final : public SampleWriter {
 public:
  TableWriter(const Twin& twin, std::vector<std::size_t> systems, const std::string& path)
      : twin_(twin), systems_(std::move(systems)), name_(path.empty() ? "standard output" : path) {
    if (!path.empty()) {
      pending_.emplace(path);
      file_ = std::fopen(pending_->path().c_str(), "wb");
      if (file_ == nullptr) {
        fail();
      }
    }
    for (std::size_t i = 0; i < twin.scene().controllers.size(); ++i) {
      if (std::any_of(systems_.begin(), systems_.end(), [&](std::size_t system) {
            return involves(twin.scene().controllers[i], system);
          })) {
        controllers_.push_back(i);
      }
    }
    put(header());
  }
  ~TableWriter() override {
    if (pending_ && file_ != nullptr) {
      std::fclose(file_);
    }
  }
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;

  void write(const Observer& observer) override {
    row_.clear();
    append(twin_.seconds(observer.step()));
    for (const std::size_t i : systems_) {
      const bool running = observer.status(i) == StepStatus::kOk;
      const std::size_t n = twin_.systems()[i]->spec.q.size();
      for (std::size_t k = 0; k < n; ++k) {
        append(running ? observer.coordinates(i)[k] : kNaN);
      }
      for (std::size_t k = 0; k < n; ++k) {
        append(running ? observer.rates(i)[k] : kNaN);
      }
      if (observer.isRotor(i)) {
        append(running ? observer.whirlRadius(i) : kNaN);
        append(running ? observer.whirlPhase(i) : kNaN);
      }
    }
    for (const std::size_t i : controllers_) {
      for (const double output : observer.controller(i).output) {
        append(output);
      }
    }
    row_.back() = '\n';
    put(row_);
  }

  void finish() override {
    if (!pending_) {
      return;  // standard output is finished by main()
    }
    const int closed = std::fclose(file_);
    file_ = nullptr;
    if (closed != 0) {
      fail();
    }
    pending_->complete();
  }

 private:
  std::string header() const {
    std::string text = "time";
    for (const std::size_t i : systems_) {
      const BuiltSystem& system = *twin_.systems()[i];
      for (const char* suffix : {"", "_rate"}) {
        for (const CoordinateInfo& c : system.dynamics->coordinates()) {
          text += fmt::format(",{}.{}{}", system.spec.name, c.name, suffix);
        }
      }
      if (system.dynamics->isRotor()) {
        text += fmt::format(",{0}.whirl_radius,{0}.whirl_phase", system.spec.name);
      }
    }
    for (const std::size_t i : controllers_) {
      const ControllerSpec& controller = twin_.scene().controllers[i];
      for (const std::string& input : controller.acted_on) {
        text += fmt::format(",{}.{}", controller.name, input);
      }
    }
    return text + "\n";
  }
  void append(double value) {
    if (std::isnan(value)) {
      row_ += "nan,";
      return;
    }
    char text[32];
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::general, 17).ptr;
    row_.append(text, end);
    row_ += ',';
  }
  void put(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) {
      fail();
    }
  }
  [[noreturn]] void fail() const {
    throw RunFailure(fmt::format("{}: cannot be written: {}", name_, std::strerror(errno)));
  }

  const Twin& twin_;
  std::vector<std::size_t> systems_;
  std::vector<std::size_t> controllers_;  // that have to do with them
  std::string name_;
  std::optional<PendingFile> pending_;
  std::FILE* file_ = stdout;
  std::string row_;
};

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

std::unique_ptr<SampleWriter> makeTableWriter(const Twin& twin, std::vector<std::size_t> systems,
                                              const std::string& path) {
  return std::make_unique<TableWriter>(twin, std::move(systems), path);
}

void writeMembers(const Twin& twin, const std::vector<std::size_t>& systems,
                  const std::string& path) {
  const auto system = std::find_if(systems.begin(), systems.end(),
                                   [&](std::size_t i) { return twin.ensemble(i) != nullptr; });
  const Ensemble& ensemble = *twin.ensemble(*system);
  std::string text = "member";
  for (const Spread& spread : twin.systems()[*system]->spec.ensemble.spread) {
    text += "," + csvCell(spread.path);
  }
  for (const EnsembleQuantity& q : ensemble.quantities()) {
    text += fmt::format(",{0},{0}_peak", q.name);
  }
  const std::size_t quantities = ensemble.quantities().size();
  std::vector<double> record(ensemble.recordSize());
  ensemble.write(twin.stepCount(), record.data());
  const double* const values = ensemble.values(record.data());
  const double* const peaks = ensemble.peaks(record.data());
  for (std::size_t i = 0; i < ensemble.count(); ++i) {
    text += fmt::format("\n{}", i);
    for (const double value : ensemble.drawn(i)) {
      text += fmt::format(",{:.17g}", value);
    }
    for (std::size_t k = 0; k < quantities; ++k) {
      text +=
          fmt::format(",{:.17g},{:.17g}", values[i * quantities + k], peaks[i * quantities + k]);
    }
  }
  writeFile(path, text + "\n");
}

std::unique_ptr<SampleWriter> makeLogWriter(const Twin& twin, std::vector<std::size_t> systems,
                                            state::SceneText scene, const std::string& path) {
  if (std::filesystem::path(path).extension() == ".mcap") {
    return std::make_unique<LogWriter<McapLog>>(twin, std::move(systems), std::move(scene), path);
  }
  return std::make_unique<LogWriter<EventLogWriter>>(twin, std::move(systems), std::move(scene),
                                                     path);
}

}  // namespace whirl_twin
