// `twin record`.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "messages/message_check.h"
#include "messages/names.h"
#include "reports/output.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/new_output.h"
#include "tools/report_options.h"
#include "transport/channel_counts.h"
#include "transport/channel_tap.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_event_log.h"
#include "transport/log_export.h"
#include "transport/mcap_writer.h"
#include "transport/ros_encode.h"

namespace whirl_twin {

namespace {

constexpr const char* kRecordDescription =
    "Records what a twin sends on LCM, as an LCM log or an MCAP file, until Ctrl-C.";

constexpr const char* kRecordFooter =
    "An LCM log (FILE.lcmlog) has every event as received; an MCAP file (FILE.mcap) the ROS "
    "messages\n"
    "that a bridge would publish. The time of an event is that of its reception. With "
    "--split-size\n"
    "or --split-time the files are FILE-000, FILE-001 and so on. A file gets its name when it is\n"
    "complete; until then it is FILE.PID.part, which after a crash can be read up to its end. At "
    "the\n"
    "end the events received, the events lost (by their step numbers) and the corrupt ones are\n"
    "printed. Exit status: 0 recorded, 1 nothing was received, or it cannot be written, 2 bad "
    "input.\n"
    "\n"
    "Examples:\n"
    "  twin record night.lcmlog --split-size 1000\n"
    "  twin record test.mcap --duration 60 --channel '*_WHIRL'";

struct RecordRequest {
  std::string file;
  std::string url = kDefaultLcmUrl;
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<double> duration, split_time;  // s
  std::optional<double> split_size;            // MB
  ChannelFilter channels;
  bool all = false;
  bool force = false;
  bool json = false;
};

/// One file of a recording.
class LiveRecording {
 public:
  LiveRecording(const std::string& path, const std::string& prefix) : path_(path), pending_(path) {
    if (std::filesystem::path(path).extension() == ".mcap") {
      encoder_.emplace(namespaceOfPrefix(prefix));
      mcap_.emplace(pending_.path());
    } else {
      log_.emplace(pending_.path());
    }
  }

  void write(const std::string& channel, std::int64_t received, const std::uint8_t* data,
             std::size_t size, const Message* message) {
    if (log_) {
      constexpr std::uint64_t kEventHead = 28;
      log_->writeEvent(channel, received, data, size);
      size_ += kEventHead + channel.size() + size;
    } else if (message != nullptr) {
      const LittleEndian& bytes = encoder_->encode(*message);
      mcap_->write(encoder_->topic(), 1'000 * received, bytes.data(), bytes.size());
      size_ = mcap_->size();
    }
  }

  /// Flushes it to the file system.
  void flush() {
    if (log_) {
      log_->finish();
    } else {
      mcap_->flush();
    }
  }

  void finish() {
    if (log_) {
      log_->finish();
    } else {
      mcap_->finish();
    }
    pending_.complete();
  }

  /// Keeps the incomplete file: after a write error the data written before remain useful.
  void keep() { pending_.complete(); }

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }

 private:
  std::string path_;
  PendingFile pending_;
  std::optional<EventLogWriter> log_;
  std::optional<RosEncoder> encoder_;
  std::optional<McapWriter> mcap_;
  std::uint64_t size_ = 0;
};

class Recorder {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Recorder(const RecordRequest& request)
      : request_(request),
        counts_(request.lcm_prefix),
        tap_(openLcm(request.url), request.all ? ".*" : request.lcm_prefix + ".*",
             [this](const std::string& channel, std::int64_t received, const std::uint8_t* data,
                    std::size_t size) { take(channel, received, data, size); }) {
    next();
  }

  void record() {
    const auto begin = Clock::now();
    auto flushed = begin;
    while (!interrupted() && !isOver(begin)) {
      tap_.receive(std::chrono::milliseconds(50));
      if (Clock::now() - flushed > std::chrono::seconds(1)) {
        flushed = Clock::now();
        attempt([this] { file_->flush(); });
      }
      rethrow();
    }
    constexpr int kAll = 100000;
    tap_.receive(std::chrono::microseconds(0), kAll);  // messages that arrived before the end
    attempt([this] { file_->finish(); });
    rethrow();
  }

  const ChannelCounts& counts() const { return counts_; }
  const std::vector<std::string>& files() const { return files_; }

 private:
  void take(const std::string& channel, std::int64_t received, const std::uint8_t* data,
            std::size_t size) {
    if (!selects(request_.channels, channel) || !failure_.empty()) {
      return;
    }
    attempt([&] {
      if (isFull(received)) {
        file_->finish();
        next();
      }
      first_ = first_ ? first_ : received;
      file_->write(channel, received, data, size, counts_.add(channel, received, data, size));
    });
  }

  bool isOver(Clock::time_point begin) const {
    return request_.duration &&
           std::chrono::duration<double>(Clock::now() - begin).count() >= *request_.duration;
  }

  bool isFull(std::int64_t received) const {
    constexpr double kMega = 1.0e6;
    return first_ && ((request_.split_size &&
                       static_cast<double>(file_->size()) >= kMega * *request_.split_size) ||
                      (request_.split_time &&
                       static_cast<double>(received - *first_) >= kMega * *request_.split_time));
  }

  void next() {
    std::filesystem::path path(request_.file);
    if (request_.split_size || request_.split_time) {
      path.replace_filename(fmt::format("{}-{:03}{}", path.stem().string(), files_.size(),
                                        path.extension().string()));
    }
    requireNew("FILE", path, request_.force);
    file_.emplace(path, request_.lcm_prefix);
    files_.push_back(path);
    first_.reset();
  }

  /// LCM's callbacks must not throw: a failure is stored for the loop.
  template <class Write>
  void attempt(Write&& write) {
    try {
      write();
    } catch (const std::exception& why) {
      failure_ = why.what();
    }
  }

  void rethrow() {
    if (!failure_.empty()) {
      file_->keep();
      throw RunFailure(fmt::format("{}; {} has the events before that, {} in all", failure_,
                                   file_->path(), counts_.events()));
    }
  }

  const RecordRequest& request_;
  ChannelCounts counts_;
  std::optional<LiveRecording> file_;
  std::vector<std::string> files_;
  std::optional<std::int64_t> first_;  ///< [us], of the file
  std::string failure_;
  ChannelTap tap_;  // last: it calls take()
};

Json recordJson(const Recorder& recorder) {
  const ChannelCounts& counts = recorder.counts();
  Json json = {{"files", recorder.files()},
               {"events", counts.events()},
               {"lost", counts.lost()},
               {"rejected", counts.rejected()},
               {"channels", Json::object()}};
  for (const auto& [channel, count] : counts.channels()) {
    json["channels"][channel] = {{"kind", count.kind},
                                 {"events", count.events},
                                 {"bytes", count.bytes},
                                 {"lost", count.steps.lost()},
                                 {"repeated", count.steps.repeated()},
                                 {"rejected", count.rejected}};
  }
  return json;
}

std::string recordText(const Recorder& recorder) {
  const ChannelCounts& counts = recorder.counts();
  std::string out;
  for (const std::string& file : recorder.files()) {
    out += file + "\n";
  }
  out += fmt::format("{} events, {} lost, {} corrupt\n", counts.events(), counts.lost(),
                     counts.rejected());
  for (const auto& [channel, count] : counts.channels()) {
    out += fmt::format("  {:<32} {:<10} {:>9} events, {} lost\n", printable(channel), count.kind,
                       count.events, count.steps.lost());
  }
  return out;
}

constexpr OptionQuantity kRecordingTime{"a time", "s", 0.0};
constexpr OptionQuantity kSplitTime{"a time", "s", 0.001};

void requireAbove(const char* option, const std::optional<double>& value, double least,
                  const char* unit) {
  if (value && !(*value >= least && std::isfinite(*value))) {
    throw InputError(
        fmt::format("{}: expected at least {:g} {}, found {:g}", option, least, unit, *value));
  }
}

int record(const RecordRequest& request) {
  requireLcmPrefix(request.lcm_prefix);
  const std::string extension = std::filesystem::path(request.file).extension();
  if (extension != ".lcmlog" && extension != ".mcap") {
    throw InputError(fmt::format("FILE: must end in .lcmlog or .mcap, found '{}'", request.file));
  }
  if (request.all && extension == ".mcap") {
    throw InputError("--all: an MCAP file has the twin's channels only; record FILE.lcmlog");
  }
  requireAbove("--split-size", request.split_size, 0.001, "MB");
  catchInterrupts();
  Recorder recorder(request);
  complain(fmt::format("twin record: listening to {} for {}\n", request.url,
                       request.all ? "all channels" : request.lcm_prefix + "*"));
  recorder.record();
  if (request.json) {
    printJson(recordJson(recorder));
  } else {
    printText(recordText(recorder));
  }
  return recorder.counts().events() > 0 ? kDone : kFailed;
}

}  // namespace

void addRecordCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("record", kRecordDescription);
  const auto request = std::make_shared<RecordRequest>();
  command.option("FILE", request->file, "FILE.lcmlog or FILE.mcap").required().type("");
  command.quantity("--duration", request->duration, kRecordingTime, "wall time", "until Ctrl-C")
      .type("S");
  command.option("--split-size", request->split_size, "MB per file; a new one is started then")
      .type("MB");
  command
      .quantity("--split-time", request->split_time, kSplitTime,
                "time per file; a new one is started then")
      .type("S");
  addChannelOption(command, request->channels);
  command.flag("--all", request->all, "record every LCM channel, not only the twin's");
  command.option("--lcm-url", request->url, std::string("default: ") + kDefaultLcmUrl).type("URL");
  command
      .option("--lcm-prefix", request->lcm_prefix, "prefix of the twin's channels; default: TWIN_")
      .type("PREFIX");
  command.flag("--force", request->force, "overwrite existing files");
  addJsonOption(command, request->json);
  command.footer(kRecordFooter);
  command.callback([request, &status] { status = record(*request); });
}

}  // namespace whirl_twin
