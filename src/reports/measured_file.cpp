#include "reports/measured_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <variant>

#include "estimation/measured_run.h"
#include "messages/refusal.h"
#include "messages/units.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kRowsOfBlock = 100;  // of a table

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

  /// Of messages that are out of order: throws Refusal where they cannot be of one run.
  void requireOneRun(const std::string& path) const {
    if (!contradiction_.empty()) {
      throw Refusal(
          fmt::format("{}: must have one run, found two: the messages are not in the order of "
                      "their recorded times, and {}",
                      path, contradiction_));
    }
  }

  /// Throws Refusal for an input of which there is no sample in its unit.
  void requireInputs(const std::string& path, const std::vector<FollowedSource>& sources) const {
    for (const FollowedSource& source : sources) {
      for (const FollowedSource::Channel& channel : source.channels) {
        if (channel.input && !hasSample(source.name, channel)) {
          throw Refusal(fmt::format(
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

  bool hasSample(const std::string& source, const FollowedSource::Channel& channel) const {
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

MeasuredFile readMeasuredMessages(const std::string& path, const std::string& scene,
                                  const std::vector<FollowedSource>& sources,
                                  const std::string& prefix,
                                  const std::function<void(const state::Measurement&)>& take,
                                  const LogProgress& advanced) {
  std::set<std::string> names;
  for (const FollowedSource& source : sources) {
    names.insert(source.name);
  }
  MeasuredFile file;
  ChannelsFound channels;
  const LoggedMessages log = readLoggedMessages(
      path, prefix, {&state::Measurement::kKind},
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
    throw Refusal(
        fmt::format("{}: must have measurements of the sensors of '{}' on channels that begin with "
                    "{} (--lcm-prefix), {}",
                    path, scene, prefix, foundElsewhere(log)));
  }
  if (log.out_of_order > 0) {
    channels.requireOneRun(path);
    file.remarks.push_back(outOfOrder(log));
  }
  channels.requireInputs(path, sources);
  file.rejected = log.rejected;
  file.damaged = log.damaged;
  file.first_damage = log.first_damage;
  return file;
}

/// The only one, no keyphasor: rows have one time for all.
const FollowedSource& tableSource(const std::string& scene,
                                  const std::vector<FollowedSource>& sources) {
  if (sources.size() != 1 || sources.front().keyphasor) {
    throw Refusal(
        fmt::format("a table has the rows of one source without a keyphasor; the scene "
                    "'{}' and the settings have {} sources: use an LCM log",
                    scene, sources.size()));
  }
  return sources.front();
}

MeasuredFile readTable(const std::string& path, const FollowedSource& source,
                       const std::function<void(const state::Measurement&)>& take) {
  state::Measurement block;
  block.source = source.name;
  block.channel = source.names();
  block.unit = source.units();
  for (const FollowedSource::Channel& channel : source.channels) {
    block.deviation.push_back(channel.deviation);
  }
  MeasuredFile file;
  const MeasuredRun run = [&] {
    try {
      return readMeasuredRun(path, "time", block.channel);
    } catch (const Refusal& error) {
      throw Refusal(path + ": " + error.what());
    }
  }();
  file.remarks = run.remarks;
  for (std::size_t first = 0; first < run.time.size(); first += kRowsOfBlock) {
    const std::size_t end = std::min(run.time.size(), first + kRowsOfBlock);
    block.instant.clear();
    block.value.clear();
    for (std::size_t row = first; row < end; ++row) {
      const std::int64_t instant = std::llround(run.time[row] * 1.0e9);
      if (!block.instant.empty() && instant <= block.instant.back()) {
        continue;  // less than a nanosecond later
      }
      block.instant.push_back(instant);
      for (const MeasuredColumn& column : run.columns) {
        block.value.push_back(column.values[row]);
      }
    }
    block.samples = static_cast<std::int64_t>(block.instant.size());
    block.first_instant = block.instant.front();
    block.valid.assign(block.value.size(), 1);
    block.at.step = static_cast<std::int64_t>(file.messages++);
    block.at.time = static_cast<double>(block.instant.back()) * 1.0e-9;
    take(block);
  }
  return file;
}

}  // namespace

MeasuredFile readMeasurements(const std::string& path, const std::string& scene,
                              const std::vector<FollowedSource>& sources, const std::string& prefix,
                              const std::function<void(const state::Measurement&)>& take,
                              const LogProgress& advanced) {
  return std::filesystem::path(path).extension() == ".csv"
             ? readTable(path, tableSource(scene, sources), take)
             : readMeasuredMessages(path, scene, sources, prefix, take, advanced);
}

}  // namespace whirl_twin
