// `twin spy`.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/live_lines.h"
#include "reports/output.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "transport/channel_counts.h"
#include "transport/channel_tap.h"
#include "transport/lcm_connection.h"

namespace whirl_twin {

namespace {

constexpr const char* kSpyDescription =
    "Shows live what is on LCM: channels, rates, sizes, losses and the newest message of each.";

constexpr const char* kSpyFooter =
    "A terminal is refreshed five times a second, until Ctrl-C; to a file or a pipe a table is\n"
    "written every second. Of the twin's own types the newest message is shown field by field, of\n"
    "others the size; `lost` is the number of missing steps. Rates are those of the last second,\n"
    "with --json and --once of the whole time. Another twin's fields: --lcm-prefix PLANT_. Exit\n"
    "status: 0 something was received, 1 nothing, 2 bad input.\n"
    "\n"
    "Examples:\n"
    "  twin spy\n"
    "  twin spy --channel '*_WHIRL' --once\n"
    "  twin spy --duration 10 --json";

using Clock = std::chrono::steady_clock;

struct SpyRequest {
  std::string url = kDefaultLcmUrl;
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<double> duration;  // s
  ChannelFilter channels;
  bool once = false;
  bool json = false;
};

/// Number of messages and bytes on a channel, in total or per second.
struct Flow {
  double events = 0.0;
  double bytes = 0.0;
};

using Flows = std::map<std::string, Flow>;

class Spy {
 public:
  explicit Spy(const SpyRequest& request)
      : request_(request),
        counts_(request.lcm_prefix),
        tap_(openLcm(request.url), ".*",
             [this](const std::string& channel, std::int64_t received, const std::uint8_t* data,
                    std::size_t size) {
               if (selects(request_.channels, channel)) {
                 counts_.add(channel, received, data, size);
               }
             }) {}

  void watch() {
    const bool live = !request_.json && !request_.once;
    const double between = lines_.onTerminal() ? 0.2 : 1.0;  // s
    auto drawn = begin_;
    while (!interrupted() && !isOver()) {
      tap_.receive(std::chrono::milliseconds(50));
      if (secondsSince(measured_) >= 1.0) {
        measure();
      }
      if (live && secondsSince(drawn) >= between) {
        drawn = Clock::now();
        lines_.show(table(rates_));
      }
    }
    // Messages sent before the end: on a busy machine they may still be in the socket buffer.
    constexpr int kAll = 100000;
    constexpr double kLongest = 0.5;  // s
    const auto ended = Clock::now();
    std::uint64_t before = 0;
    do {
      before = counts_.events();
      tap_.receive(std::chrono::milliseconds(interrupted() ? 150 : 0), kAll);
    } while (interrupted() && counts_.events() != before && secondsSince(ended) < kLongest);
    if (request_.json) {
      printJson(json());
    } else {
      lines_.show(table(live ? rates_ : meanRates()));
    }
  }

  const ChannelCounts& counts() const { return counts_; }

 private:
  bool isOver() const {
    const std::optional<double> duration =
        request_.once && !request_.duration ? 1.0 : request_.duration;
    return duration && secondsSince(begin_) >= *duration;
  }

  Flows totals() const {
    Flows all;
    for (const auto& [channel, count] : counts_.channels()) {
      all[channel] = {static_cast<double>(count.events), static_cast<double>(count.bytes)};
    }
    return all;
  }

  void measure() {
    const double time = secondsSince(measured_);
    measured_ = Clock::now();
    const Flows now = totals();
    for (const auto& [channel, total] : now) {
      const Flow before = before_[channel];
      rates_[channel] = {(total.events - before.events) / time,
                         (total.bytes - before.bytes) / time};
    }
    before_ = now;
  }

  Flows meanRates() const {
    Flows all = totals();
    for (auto& [channel, flow] : all) {
      flow.events /= secondsSince(begin_);
      flow.bytes /= secondsSince(begin_);
    }
    return all;
  }

  std::vector<std::string> table(const Flows& rates) const {
    Flow sum;
    for (const auto& [channel, rate] : rates) {
      sum.events += rate.events;
      sum.bytes += rate.bytes;
    }
    std::vector<std::string> lines{
        fmt::format("{:.1f} s: {} events, {} lost, {} corrupt; now {:.1f} /s, {:.1f} kB/s",
                    secondsSince(begin_), counts_.events(), counts_.lost(), counts_.rejected(),
                    sum.events, 1.0e-3 * sum.bytes),
        fmt::format("{:<28} {:<10} {:>8} {:>8} {:>7} {:>6}  {}", "channel", "kind", "1/s", "kB/s",
                    "bytes", "lost", "last")};
    for (const auto& [channel, count] : counts_.channels()) {
      const auto found = rates.find(channel);
      const Flow rate = found == rates.end() ? Flow{} : found->second;
      std::string last = count.newest ? messageText(*count.newest) : "";
      if (count.rejected > 0) {
        last = fmt::format("{} corrupt; {}", count.rejected, last);
      }
      lines.push_back(fmt::format("{:<28} {:<10} {:>8.1f} {:>8.1f} {:>7} {:>6}  {}",
                                  printable(channel, kMaxChannelLength), count.kind, rate.events,
                                  1.0e-3 * rate.bytes, count.bytes / count.events,
                                  count.steps.lost(), last));
    }
    return lines;
  }

  Json json() const {
    Json json = {{"duration", secondsSince(begin_)},
                 {"events", counts_.events()},
                 {"lost", counts_.lost()},
                 {"rejected", counts_.rejected()},
                 {"channels", Json::object()}};
    const Flows rates = meanRates();
    for (const auto& [channel, count] : counts_.channels()) {
      json["channels"][printable(channel, kMaxChannelLength)] = {
          {"kind", count.kind},
          {"events", count.events},
          {"bytes", count.bytes},
          {"rate", rates.at(channel).events},
          {"lost", count.steps.lost()},
          {"repeated", count.steps.repeated()},
          {"rejected", count.rejected},
          {"last", count.newest ? messageJson(*count.newest) : Json()}};
    }
    return json;
  }

  const SpyRequest& request_;
  LiveLines lines_;
  ChannelCounts counts_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point measured_ = begin_;
  Flows before_, rates_;
  ChannelTap tap_;  // last: it calls counts_
};

int spy(const SpyRequest& request) {
  requireLcmPrefix(request.lcm_prefix);
  catchInterrupts();
  Spy spy(request);
  complain(fmt::format("twin spy: listening to {}\n", request.url));
  spy.watch();
  return spy.counts().events() > 0 ? kDone : kFailed;
}

}  // namespace

void addSpyCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("spy", kSpyDescription);
  const auto request = std::make_shared<SpyRequest>();
  command.quantity("--duration", request->duration, kListeningTime, "wall time", "until Ctrl-C")
      .type("S");
  command.flag("--once", request->once, "print one table, of one second or of --duration");
  addChannelOption(command, request->channels);
  command.option("--lcm-url", request->url, std::string("default: ") + kDefaultLcmUrl).type("URL");
  command
      .option("--lcm-prefix", request->lcm_prefix, "prefix of the twin's channels; default: TWIN_")
      .type("PREFIX");
  command.flag("--json", request->json, "print one JSON object at the end");
  command.footer(kSpyFooter);
  command.callback([request, &status] { status = spy(*request); });
}

}  // namespace whirl_twin
