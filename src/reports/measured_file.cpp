#include "reports/measured_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <variant>

#include "estimation/measured_run.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

namespace {

/// What channels there are, and of which there are samples.
class ChannelsFound {
 public:
  void take(const state::Measurement& block) {
    Source& source = sources_[block.source];
    const std::size_t count = block.channel.size();
    for (std::size_t c = 0; c < count; ++c) {
      auto& units = source.units[block.channel[c]];
      for (std::size_t i = c; i < block.value.size(); i += count) {
        if (block.valid[i] != 0 && std::isfinite(block.value[i])) {
          units.insert(block.unit[c]);
          break;
        }
      }
    }
    state::Measurement& last = source.last;
    const bool differs = last.channel == block.channel && last.instantOf(0) == block.instantOf(0) &&
                         last.samples == block.samples && last.valid == block.valid &&
                         last.value != block.value;
    if (differs && contradiction_.empty()) {
      contradiction_ = fmt::format("{} has two different messages at {:.9g} s", block.source,
                                   1.0e-9 * static_cast<double>(block.instantOf(0)));
    }
    last = block;
  }

  /// Of messages that are out of order: throws InputError where they cannot be of one run.
  void requireOneRun(const std::string& path) const {
    if (!contradiction_.empty()) {
      throw InputError(
          fmt::format("{}: must have one run, found two: the messages are not in the order of "
                      "their recorded times, and {}",
                      path, contradiction_));
    }
  }

  /// Throws InputError for an input of which there is no sample in its unit.
  void requireInputs(const std::string& path, const std::vector<EstimatorSource>& sources) const {
    for (const EstimatorSource& source : sources) {
      for (const EstimatorSource::Channel& channel : source.channels) {
        if (channel.input && !hasSample(source.name, channel)) {
          throw InputError(fmt::format(
              "{}: {}/{}, an input of the settings, must have a valid sample in {}; there are: {}",
              path, source.name, channel.name, channel.unit, fmt::join(all(), ", ")));
        }
      }
    }
  }

 private:
  struct Source {
    std::map<std::string, std::set<std::string>> units;  // of the valid samples of each channel
    state::Measurement last;
  };

  bool hasSample(const std::string& source, const EstimatorSource::Channel& channel) const {
    const auto found = sources_.find(source);
    if (found == sources_.end() || found->second.units.count(channel.name) == 0) {
      return false;
    }
    const std::set<std::string>& units = found->second.units.at(channel.name);
    return std::any_of(units.begin(), units.end(), [&](const std::string& unit) {
      return unitScale(unit, channel.unit) != 0.0;
    });
  }
  std::vector<std::string> all() const {
    std::vector<std::string> names;
    for (const auto& [name, source] : sources_) {
      for (const auto& [channel, units] : source.units) {
        names.push_back(fmt::format("{}/{}{}", name, channel, units.empty() ? " (no sample)" : ""));
      }
    }
    return names;
  }

  std::map<std::string, Source> sources_;
  std::string contradiction_;
};

/// What was measured by one source: a row for each sample.
struct SourceRows {
  std::vector<std::int64_t> instants;  // ns
  std::vector<double> values;          // a row after the other
  std::size_t not_valid = 0;           // samples
};

/// Places of the columns in a block; none where one of them is missing.
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
    rows.instants.push_back(block.instantOf(static_cast<std::int64_t>(i)));
    for (const std::size_t place : places) {
      rows.values.push_back(block.value[i * channels + place]);
    }
  }
}

MeasuredRun readMeasuredLog(const std::string& path, const std::string& prefix,
                            const std::vector<WantedColumn>& wanted) {
  std::vector<std::string> columns;
  for (const WantedColumn& column : wanted) {
    columns.push_back(column.name);
  }
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
    throw InputError(fmt::format(
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

MeasuredFile readMeasurements(const Recording& recording, const std::string& scene,
                              const std::vector<EstimatorSource>& sources,
                              const std::function<void(const state::Measurement&)>& take,
                              const LogProgress& advanced) {
  std::set<std::string> names;
  for (const EstimatorSource& source : sources) {
    names.insert(source.name);
  }
  MeasuredFile file;
  ChannelsFound channels;
  const std::string& path = recording.path;
  const LoggedMessages log = readRecording(
      recording, sources, {&state::Measurement::kKind},
      [&](const Message& message, std::int64_t) {
        const auto& measurement = std::get<state::Measurement>(message);
        channels.take(measurement);
        if (names.count(measurement.source) > 0) {
          ++file.messages;
          take(measurement);
        }
      },
      advanced);
  if (file.messages == 0) {
    throw InputError(
        fmt::format("{}: must have measurements of the sensors of '{}' on channels that begin with "
                    "{} (--lcm-prefix), {}",
                    path, scene, recording.prefix, foundElsewhere(log)));
  }
  if (log.out_of_order > 0) {
    channels.requireOneRun(path);
    file.remarks.push_back(outOfOrder(log));
  }
  channels.requireInputs(path, sources);
  file.remarks.insert(file.remarks.end(), log.remarks.begin(), log.remarks.end());
  file.rejected = log.rejected;
  file.damaged = log.damaged;
  file.first_damage = log.first_damage;
  return file;
}

MeasuredRun readRecordedRun(const std::string& path, const std::string& prefix,
                            const TableSettings& table, const std::vector<WantedColumn>& columns) {
  return isTable(path) ? readMeasuredRun(path, table, columns)
                       : readMeasuredLog(path, prefix, columns);
}

}  // namespace whirl_twin
