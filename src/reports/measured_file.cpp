#include "reports/measured_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <variant>

#include "estimation/measured_run.h"
#include "messages/refusal.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kRowsOfBlock = 100;  // of a table

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
  const LoggedMessages log = readLoggedMessages(
      path, prefix, {&state::Measurement::kKind},
      [&](const Message& message, std::int64_t) {
        const auto& measurement = std::get<state::Measurement>(message);
        if (names.count(measurement.source) > 0) {
          ++file.messages;
          take(measurement);
        }
      },
      advanced);
  if (file.messages == 0) {
    throw Refusal(
        fmt::format("{}: expected measurements of the sensors of '{}' on channels that "
                    "begin with {} (--lcm-prefix), {}",
                    path, scene, prefix, foundElsewhere(log)));
  }
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
