#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "reports/csv_table.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"
#include "transport/bag_scan.h"
#include "transport/lcm_event_log.h"

namespace whirl_twin {

namespace {

constexpr const char* kLogDescription =
    "Summarizes an LCM log: channels, number of events, the time they span, gaps in the steps, "
    "and\ncorrupt or invalid events.";

constexpr const char* kLogFooter =
    "A gap is a place where states of a channel are missing. Exit status: 0 no corrupt events,\n1 "
    "corrupt events, 2 the file cannot be read or has no event at all.\n"
    "\n"
    "Examples:\n"
    "  twin simulate demo --output demo.lcmlog && twin log demo.lcmlog\n"
    "  twin log recorded.lcmlog --json";

/// [s]; in double, because a corrupt log may hold any 64 bits.
double span(const LogSummary& log) {
  return (static_cast<double>(log.last_timestamp) - static_cast<double>(log.first_timestamp)) *
         1.0e-6;
}

Json channelJson(const ChannelSummary& channel) {
  Json json;
  json["kind"] = channel.kind;
  json["events"] = channel.events;
  json["bytes"] = channel.bytes;
  json["rejected"] = channel.rejected;
  json["first_time"] = channel.first_time;
  json["last_time"] = channel.last_time;
  json["stride"] = channel.stride;
  json["gaps"] = channel.gaps;
  json["lost"] = channel.lost;
  json["repeated"] = channel.repeated;
  json["late"] = channel.late;
  json["backward"] = channel.backward;
  return json;
}

Json logJson(const LogSummary& log) {
  Json json;
  json["file"] = log.path;
  json["size"] = log.size;
  json["events"] = log.events;
  json["span"] = span(log);
  json["first_timestamp"] = log.first_timestamp;
  json["last_timestamp"] = log.last_timestamp;
  json["continuous"] = log.continuous();
  json["corrupt"] = log.defect_count;
  json["unreadable_bytes"] = log.unreadable_bytes;
  json["truncated"] = log.truncated;
  json["defects"] = Json::array();
  for (const LogDefect& defect : log.defects) {
    json["defects"].push_back({{"offset", defect.offset}, {"what", defect.what}});
  }
  json["channels"] = Json::object();
  for (const ChannelSummary& channel : log.channels) {
    json["channels"][channel.channel] = channelJson(channel);
  }
  return json;
}

CsvTable channelTable(const LogSummary& log) {
  CsvTable table{"",
                 {"channel", "kind", "events", "bytes", "rejected", "first_time", "last_time",
                  "stride", "gaps", "lost", "repeated", "late", "backward"}};
  for (const ChannelSummary& channel : log.channels) {
    Json row = channelJson(channel);
    row["channel"] = channel.channel;
    table.rows.push_back(row);
  }
  return table;
}

std::string channelText(const ChannelSummary& channel) {
  std::string out =
      fmt::format("  {:<28} {:<10} {:>9} events", channel.channel, channel.kind, channel.events);
  if (!std::isnan(channel.first_time)) {
    out += fmt::format(", t = {:g} .. {:g} s", channel.first_time, channel.last_time);
  }
  if (channel.stride > 0) {
    out += fmt::format(", every {} step{}", channel.stride, channel.stride == 1 ? "" : "s");
  }
  if (channel.gaps > 0) {
    out += fmt::format(", {} gap{} ({} lost)", channel.gaps, channel.gaps == 1 ? "" : "s",
                       channel.lost);
  }
  if (channel.repeated > 0) {
    out += fmt::format(", {} repeated", channel.repeated);
  }
  if (channel.late > 0) {
    out += fmt::format(", {} out of order", channel.late);
  }
  if (channel.backward > 0) {
    out += fmt::format(", restarted {} time{}", channel.backward, channel.backward == 1 ? "" : "s");
  }
  if (channel.rejected > 0) {
    out += fmt::format(", {} corrupt", channel.rejected);
  }
  return out + "\n";
}

std::string logText(const LogSummary& log) {
  std::string out = fmt::format("{}: {} events in {:.6g} s, {} bytes\n", log.path, log.events,
                                span(log), log.size);
  for (const ChannelSummary& channel : log.channels) {
    out += channelText(channel);
  }
  const bool complete =
      std::all_of(log.channels.begin(), log.channels.end(), [](const ChannelSummary& channel) {
        return channel.gaps == 0 && channel.repeated == 0 && channel.backward == 0;
      });
  out += log.continuous() ? "no gaps, nothing repeated or out of order\n"
         : complete       ? "nothing lost or repeated, but out of order\n"
                          : "not continuous\n";
  if (log.defect_count == 0) {
    return out + "no corrupt events\n";
  }
  out += fmt::format("{} corrupt event{} or place{}, {} unreadable bytes{}\n", log.defect_count,
                     log.defect_count == 1 ? "" : "s", log.defect_count == 1 ? "" : "s",
                     log.unreadable_bytes, log.truncated ? ", the file ends within an event" : "");
  for (const LogDefect& defect : log.defects) {
    out += fmt::format("  at byte {}: {}\n", defect.offset, defect.what);
  }
  if (log.defect_count > log.defects.size()) {
    out += fmt::format("  and {} more\n", log.defect_count - log.defects.size());
  }
  return out;
}

struct LogRequest {
  std::string file;
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<std::string> csv;
  bool json = false;
};

int summarize(const LogRequest& request) {
  requireCsvName(request.csv);
  requireLcmPrefix(request.lcm_prefix);
  if (BagScan::isBag(request.file)) {
    throw InputError(request.file + ": must be an LCM log, found a rosbag; use `rosbag info`");
  }
  const LogSummary log = readEventLog(request.file, request.lcm_prefix);
  if (log.events == 0) {
    throw InputError(
        log.channels.empty()
            ? fmt::format("{}: expected an LCM log, found no event in {} bytes", request.file,
                          log.size)
            : fmt::format(
                  "{}: no event can be used; the twin's channels must begin with {} (--lcm-prefix)",
                  request.file, request.lcm_prefix));
  }
  if (request.csv) {
    writeCsv(*request.csv, {channelTable(log)});
  }
  if (request.json) {
    printJson(logJson(log));
  } else {
    printText(logText(log));
  }
  return log.defect_count == 0 ? kDone : kFailed;
}

}  // namespace

void addLogCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("log", kLogDescription);
  const auto request = std::make_shared<LogRequest>();
  command.option("FILE", request->file, "LCM log, such as demo.lcmlog").required().type("");
  command
      .option("--lcm-prefix", request->lcm_prefix,
              "prefix of the recorded twin's channels; default: TWIN_")
      .type("PREFIX");
  addCsvOption(command, request->csv);
  addJsonOption(command, request->json);
  command.footer(kLogFooter);
  command.callback([request, &status] { status = summarize(*request); });
}

}  // namespace whirl_twin
