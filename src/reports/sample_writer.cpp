#include "reports/sample_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "messages/csv_cell.h"
#include "messages/input_error.h"
#include "reports/output.h"
#include "reports/sampled_signals.h"
#include "twin/ensemble.h"

namespace whirl_twin {

namespace {

class TableWriter final : public SampleWriter {
 public:
  TableWriter(const Twin& twin, const std::vector<std::size_t>& systems, const std::string& path)
      : signals_(twin, systems, SampledSignals::Energy::kNo),
        name_(path.empty() ? "standard output" : path) {
    if (!path.empty()) {
      pending_.emplace(path);
      file_ = std::fopen(pending_->path().c_str(), "wb");
      if (file_ == nullptr) {
        fail();
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
    signals_.eachOf(observer, [this](double value) { append(value); });
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
    std::string text;
    for (const SignalName& signal : signals_.names()) {
      text += (text.empty() ? "" : ",") + signal.name;
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

  SampledSignals signals_;
  std::string name_;
  std::optional<PendingFile> pending_;
  std::FILE* file_ = stdout;
  std::string row_;
};

}  // namespace

std::unique_ptr<SampleWriter> makeTableWriter(const Twin& twin,
                                              const std::vector<std::size_t>& systems,
                                              const std::string& path) {
  return std::make_unique<TableWriter>(twin, systems, path);
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

}  // namespace whirl_twin
