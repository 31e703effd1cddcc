#include "reports/measured_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <variant>

#include "estimation/measured_run.h"
#include "messages/refusal.h"
#include "transport/event_scan.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {

namespace {

constexpr std::uint64_t kTell = 256;       // events from one look at the progress to the next
constexpr std::size_t kRowsOfBlock = 100;  // of a table

MeasuredFile readLog(const std::string& path, const Scene& scene, const std::string& prefix,
                     const std::function<void(const state::Measurement&)>& take,
                     const std::function<void(std::uint64_t, std::uint64_t)>& advanced) {
  std::set<std::string> sources;
  for (const SensorSpec& sensor : scene.sensors) {
    sources.insert(sensor.name);
  }
  MeasuredFile file;
  EventScan scan(path);
  RawEvent event;
  std::uint64_t events = 0;
  for (auto found = scan.next(event); found != EventScan::Found::kEnd; found = scan.next(event)) {
    if (++events % kTell == 0) {
      advanced(scan.offset(), scan.size());
    }
    if (found != EventScan::Found::kEvent) {
      ++file.damaged;
      continue;
    }
    const auto channel = parseChannel(event.channel, prefix);
    if (event.data == nullptr || !channel || channel->kind != &state::Measurement::kKind) {
      continue;
    }
    try {
      const Message message = decodeEvent(event.channel, event.data, event.size, prefix);
      const auto& measurement = std::get<state::Measurement>(message);
      if (sources.count(measurement.source) > 0) {
        ++file.messages;
        take(measurement);
      }
    } catch (const RejectedMessage&) {
      ++file.rejected;
    }
  }
  if (file.messages == 0) {
    throw Refusal(
        fmt::format("{}: expected measurements of the sensors of '{}' on channels that "
                    "begin with {} (--lcm-prefix), found none in {} bytes",
                    path, scene.name, prefix, scan.size()));
  }
  return file;
}

/// The only source of the scene that is no keyphasor: rows have one time for all.
const SensorSpec& tableSource(const Scene& scene) {
  const SensorSpec* found = nullptr;
  for (const SensorSpec& sensor : scene.sensors) {
    if (sensor.keyphasor || found != nullptr) {
      throw Refusal(
          fmt::format("a table has the rows of one source without a keyphasor; the scene "
                      "'{}' has {} sources: use an LCM log",
                      scene.name, scene.sensors.size()));
    }
    found = &sensor;
  }
  if (found == nullptr) {
    throw Refusal(fmt::format("the scene '{}' has no sensors", scene.name));
  }
  return *found;
}

MeasuredFile readTable(const std::string& path, const Scene& scene,
                       const std::function<void(const state::Measurement&)>& take) {
  const SensorSpec& source = tableSource(scene);
  state::Measurement block;
  block.source = source.name;
  for (const SensorChannelSpec& channel : source.channels) {
    block.channel.push_back(channel.name);
    block.unit.push_back(channel.signal.unit);
    block.deviation.push_back(channel.sensor.noise);
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

MeasuredFile readMeasurements(const std::string& path, const Scene& scene,
                              const std::string& prefix,
                              const std::function<void(const state::Measurement&)>& take,
                              const std::function<void(std::uint64_t, std::uint64_t)>& advanced) {
  return std::filesystem::path(path).extension() == ".csv"
             ? readTable(path, scene, take)
             : readLog(path, scene, prefix, take, advanced);
}

}  // namespace whirl_twin
