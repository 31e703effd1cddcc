// `twin export`.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/output.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/new_output.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"
#include "transport/bag_writer.h"
#include "transport/log_export.h"
#include "transport/mcap_writer.h"
#include "transport/table_folder.h"

namespace whirl_twin {

namespace {

constexpr const char* kExportDescription =
    "Writes an LCM log or a rosbag as an MCAP file, for PlotJuggler, Foxglove and Lichtblick; as "
    "a\n"
    "rosbag; or as tables of comma-separated values, one file per topic. No ROS is needed.";

constexpr const char* kExportFooter =
    "Messages of an LCM log become the ROS messages that a bridge publishes, on /twin/rotor/whirl\n"
    "for TWIN_ROTOR_WHIRL, with the time of the event: received or, in a log of twin simulate,\n"
    "simulated. Those of a bag are copied unchanged. Corrupt messages are left out, counted "
    "and\nlisted with their byte offset; channels of other programs are left out. Exit status: 0 "
    "done,\n1 it cannot be written, 2 a file that cannot be read or has nothing to export.\n"
    "\n"
    "Examples:\n"
    "  twin export night.lcmlog --mcap night.mcap\n"
    "  twin export night.bag --csv night --channel '/twin/rotor/*'";

constexpr std::size_t kMaxTopic = 255;  // bytes that are shown

struct ExportRequest {
  std::string file;
  std::optional<std::string> csv, bag, mcap;
  std::optional<std::string> compress;
  std::string profile = "ros1";
  std::string lcm_prefix = kDefaultLcmPrefix;
  ChannelFilter channels;
  bool force = false;
  bool json = false;
};

/// Throws InputError if there are no messages.
void requireMessages(const ExportRequest& request, const LogExport& log) {
  if (log.messages > 0) {
    return;
  }
  std::string why =
      fmt::format("{}: found no message to export in {} bytes", request.file, log.size);
  if (log.not_selected > 0) {
    why += fmt::format("; {} on channels that --channel leaves out", log.not_selected);
  }
  if (!log.foreign.empty()) {
    why += fmt::format(
        "; channel {} does not belong to a twin whose channels begin with {} "
        "(--lcm-prefix)",
        log.foreign.begin()->first, request.lcm_prefix);
  }
  if (!log.defects.empty()) {
    why += fmt::format("; at byte {}: {}", log.defects.front().offset, log.defects.front().what);
  }
  throw InputError(why);
}

std::uint64_t foreignIn(const LogExport& log) {
  std::uint64_t events = 0;
  for (const auto& [channel, count] : log.foreign) {
    events += count;
  }
  return events;
}

std::string exportText(const ExportRequest& request, const LogExport& log,
                       const std::string& output) {
  std::string out = fmt::format("{}: {} messages of {} topics written to {}\n", request.file,
                                log.messages, log.topics.size(), output);
  for (const auto& [topic, count] : log.topics) {
    out += fmt::format("  {:<40} {:>9}\n", printable(topic, kMaxTopic), count);
  }
  if (log.not_selected > 0) {
    out += fmt::format("{} not selected\n", log.not_selected);
  }
  if (!log.foreign.empty()) {
    out += fmt::format("{} left out on {} channel{} of other programs, such as {}\n",
                       foreignIn(log), log.foreign.size(), log.foreign.size() == 1 ? "" : "s",
                       log.foreign.begin()->first);
  }
  if (log.rejected + log.damaged > 0) {
    out += fmt::format("left out: {} corrupt message{}, {} corrupt place{}\n", log.rejected,
                       log.rejected == 1 ? "" : "s", log.damaged, log.damaged == 1 ? "" : "s");
  }
  for (const LogDefect& defect : log.defects) {
    out += fmt::format("  at byte {}: {}\n", defect.offset, defect.what);
  }
  if (log.rejected + log.damaged > log.defects.size()) {
    out += fmt::format("  and {} more\n", log.rejected + log.damaged - log.defects.size());
  }
  return out;
}

Json exportJson(const ExportRequest& request, const LogExport& log, const std::string& output) {
  Json json = {{"file", request.file},
               {"output", output},
               {"messages", log.messages},
               {"topics", Json::object()},
               {"not_selected", log.not_selected},
               {"foreign", Json::object()},
               {"rejected", log.rejected},
               {"damaged", log.damaged},
               {"defects", Json::array()}};
  for (const auto& [topic, count] : log.topics) {
    json["topics"][topic] = count;
  }
  for (const auto& [channel, count] : log.foreign) {
    json["foreign"][channel] = count;
  }
  for (const LogDefect& defect : log.defects) {
    json["defects"].push_back({{"offset", defect.offset}, {"what", defect.what}});
  }
  return json;
}

class Export {
 public:
  explicit Export(const ExportRequest& request) : request_(request) {}

  LogExport run() {
    if (!request_.csv) {
      return toFile();
    }
    TableShapes shapes;
    pass(shapes);
    PendingFolder folder(*request_.csv);
    TableFolder tables(folder.path(), shapes.shapes());
    const LogExport log = pass(tables);
    tables.finish();
    folder.complete();
    return log;
  }

 private:
  static constexpr std::int64_t kParts = 1000;

  LogExport toFile() {
    PendingFile pending(request_.mcap ? *request_.mcap : *request_.bag);
    std::unique_ptr<RecordingWriter> writer;
    if (request_.mcap) {
      writer = std::make_unique<McapWriter>(
          pending.path(),
          request_.compress ? McapWriter::Compression::kLz4 : McapWriter::Compression::kNone,
          request_.profile == "ros2" ? McapWriter::Profile::kRos2 : McapWriter::Profile::kRos1);
    } else {
      writer = std::make_unique<BagWriter>(pending.path());
    }
    const LogExport log = pass(*writer);
    writer->finish();
    pending.complete();
    return log;
  }

  /// Through the file once.
  LogExport pass(RecordingWriter& to) {
    const LogExport log = exportLog(
        request_.file, request_.lcm_prefix,
        [&](const std::string& channel) { return selects(request_.channels, channel); }, to,
        [&](std::uint64_t bytes, std::uint64_t all) {
          bar_.show(
              static_cast<std::int64_t>(static_cast<double>(kParts) * static_cast<double>(bytes) /
                                        static_cast<double>(std::max<std::uint64_t>(1, all))));
        });
    bar_.clear();
    requireMessages(request_, log);
    return log;
  }

  const ExportRequest& request_;
  ProgressBar bar_{request_.file, kParts, false, true};
};

int exportLogFile(const ExportRequest& request) {
  requireLcmPrefix(request.lcm_prefix);
  const std::vector<std::pair<const char*, const std::optional<std::string>*>> outputs = {
      {"--csv", &request.csv}, {"--bag", &request.bag}, {"--mcap", &request.mcap}};
  std::string output;
  int asked = 0;
  for (const auto& [option, path] : outputs) {
    if (*path) {
      ++asked;
      output = **path;
      requireNew(option, output, request.force);
      std::error_code none;
      if (std::filesystem::equivalent(output, request.file, none)) {
        throw InputError(fmt::format("{}: must differ from {}", option, request.file));
      }
    }
  }
  if (asked != 1) {
    throw InputError(fmt::format("expected one of --csv, --bag and --mcap, found {}", asked));
  }
  if (request.compress && (*request.compress != "lz4" || !request.mcap)) {
    throw InputError(
        fmt::format("--compress: must be lz4, with --mcap; found '{}'", *request.compress));
  }
  if (request.profile != "ros1" && !request.mcap) {
    throw InputError("--profile: must be with --mcap");
  }
  if (request.compress && !McapWriter::has(McapWriter::Compression::kLz4)) {
    throw InputError(
        "--compress: built without lz4 (liblz4-dev): run `scripts/setup`, then build again");
  }
  const LogExport log = Export(request).run();
  return printReport(request.json, exportJson(request, log, output),
                     exportText(request, log, output));
}

}  // namespace

void addExportCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("export", kExportDescription);
  const auto request = std::make_shared<ExportRequest>();
  command.option("LOG", request->file, "LCM log or rosbag, such as demo.lcmlog, night.bag")
      .required()
      .type("");
  command.option("--csv", request->csv, "write tables to this folder").type("FOLDER");
  command.option("--bag", request->bag, "write a rosbag").type("FILE");
  command.option("--mcap", request->mcap, "write an MCAP file").type("FILE");
  command.option("--compress", request->compress, "lz4: the chunks of the MCAP file").type("lz4");
  command
      .option("--profile", request->profile,
              "messages of the MCAP file: ros1, or ros2 for the programs of ROS 2; default: ros1")
      .among({"ros1", "ros2"});
  addChannelOption(command, request->channels);
  command
      .option("--lcm-prefix", request->lcm_prefix,
              "prefix of the recorded twin's channels; default: TWIN_")
      .type("PREFIX");
  command.flag("--force", request->force, "overwrite existing files");
  addJsonOption(command, request->json);
  command.footer(kExportFooter);
  command.callback([request, &status] { status = exportLogFile(*request); });
}

}  // namespace whirl_twin
