#include "reports/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "messages/names.h"
#include "messages/refusal.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

namespace {

bool endsWith(const std::string& path, const std::string& end) {
  return path.size() >= end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
}

/// What was measured by one source: a row for each sample.
struct SourceRows {
  std::vector<std::string> channels;
  std::vector<std::int64_t> instants;  // ns
  std::vector<double> values;          // a row after the other
  std::size_t not_valid = 0;           // samples
};

/// Where the channels that are asked for stand in a block; none where one of them is missing.
std::vector<std::size_t> placesOf(const std::vector<std::string>& columns,
                                  const state::Measurement& block) {
  std::vector<std::size_t> places;
  for (const std::string& column : columns) {
    const auto place =
        std::find_if(block.channel.begin(), block.channel.end(), [&](const std::string& channel) {
          return column == channel || column == block.source + "/" + channel;
        });
    if (place == block.channel.end()) {
      return {};
    }
    places.push_back(static_cast<std::size_t>(place - block.channel.begin()));
  }
  return places;
}

void take(const state::Measurement& block, const std::vector<std::size_t>& places,
          SourceRows& rows) {
  const std::size_t channels = block.channel.size();
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.samples); ++i) {
    const bool valid = std::all_of(places.begin(), places.end(), [&](std::size_t place) {
      return block.valid[i * channels + place] != 0;
    });
    if (!valid) {
      ++rows.not_valid;
      continue;
    }
    rows.instants.push_back(block.period > 0
                                ? block.first_instant + static_cast<std::int64_t>(i) * block.period
                                : block.instant[i]);
    for (const std::size_t place : places) {
      rows.values.push_back(block.value[i * channels + place]);
    }
  }
}

MeasuredRun readMeasuredLog(const std::string& path, const std::string& prefix,
                            const std::vector<std::string>& columns) {
  std::map<std::string, SourceRows> sources;
  std::set<std::string> seen;
  const LoggedMessages log = readLoggedMessages(
      path, prefix, {&state::Measurement::kKind},
      [&](const Message& message, std::int64_t) {
        const auto& block = std::get<state::Measurement>(message);
        for (const std::string& channel : block.channel) {
          seen.insert(block.source + "/" + channel);
        }
        const std::vector<std::size_t> places = placesOf(columns, block);
        if (!places.empty()) {
          take(block, places, sources[block.source]);
        }
      },
      [](std::uint64_t, std::uint64_t) {});
  if (sources.size() != 1) {
    throw Refusal(fmt::format(
        "must have {} of one source, on channels that begin with {} (--lcm-prefix); {}",
        fmt::join(columns, ", "), prefix,
        seen.empty() ? foundElsewhere(log) : fmt::format("found {}", fmt::join(seen, ", "))));
  }
  const SourceRows& rows = sources.begin()->second;
  std::vector<double> time;
  std::vector<MeasuredColumn> read;
  const std::int64_t first =
      rows.instants.empty() ? 0 : *std::min_element(rows.instants.begin(), rows.instants.end());
  for (const std::int64_t instant : rows.instants) {
    time.push_back(1.0e-9 * static_cast<double>(instant - first));
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    read.push_back({columns[k], {}});
    for (std::size_t i = k; i < rows.values.size(); i += columns.size()) {
      read.back().values.push_back(rows.values[i]);
    }
  }
  MeasuredRun run = measuredRun(std::move(time), std::move(read));
  if (log.out_of_order > 0) {
    run.remarks.push_back(outOfOrder(log));
  }
  if (rows.not_valid > 0) {
    run.remarks.push_back(fmt::format("{} {} marked invalid by the sensor, left out",
                                      rows.not_valid, rows.not_valid == 1 ? "row" : "rows"));
  }
  if (log.damaged + log.rejected > 0) {
    run.remarks.push_back(
        fmt::format("{} {} of the file and {} {} left out{}", log.damaged,
                    log.damaged == 1 ? "corrupt place" : "corrupt places", log.rejected,
                    log.rejected == 1 ? "message" : "messages",
                    log.first_damage.empty() ? "" : "; the first: " + log.first_damage));
  }
  return run;
}

}  // namespace

MeasuredRun readRecordedRun(const std::string& path, const std::string& prefix,
                            const std::string& time, const std::vector<std::string>& columns) {
  const bool is_log =
      endsWith(path, ".lcmlog") || endsWith(path, ".bag") || endsWith(path, ".bag.active");
  return is_log ? readMeasuredLog(path, prefix, columns) : readMeasuredRun(path, time, columns);
}

}  // namespace whirl_twin
