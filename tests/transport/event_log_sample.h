// A short recording of a twin, and temporary log files.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "transport/lcm_event_log.h"

namespace whirl_twin {

using Bytes = std::vector<std::uint8_t>;

/// A file name of this process that is gone when the test is over.
class TemporaryLog {
 public:
  TemporaryLog()
      : path_("/tmp/whirl_twin_test_" + std::to_string(::getpid()) + "_" +
              std::to_string(count_++) + ".lcmlog") {}
  ~TemporaryLog() { std::remove(path_.c_str()); }
  TemporaryLog(const TemporaryLog&) = delete;
  TemporaryLog& operator=(const TemporaryLog&) = delete;

  const std::string& path() const { return path_; }

  Bytes read() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  void write(const Bytes& bytes) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

 private:
  static inline int count_ = 0;
  std::string path_;
};

inline state::WhirlState whirlAt(std::int64_t step) {
  state::WhirlState whirl;
  whirl.at = {step, static_cast<double>(step) * 1e-3, step * 1000000};
  whirl.system = "rotor";
  whirl.x = 1e-4;
  return whirl;
}

inline state::PendulumState pendulumAt(std::int64_t step) {
  state::PendulumState pendulum;
  pendulum.at = whirlAt(step).at;
  pendulum.system = "arm";
  pendulum.name = {"theta1", "theta2"};
  pendulum.angle = {0.1, 0.2};
  pendulum.rate = {1.0, 2.0};
  return pendulum;
}

inline state::DriveState driveAt(std::int64_t step) {
  state::DriveState drive;
  drive.at = whirlAt(step).at;
  drive.drive = "shaft";
  drive.speed = 100.0;
  return drive;
}

inline state::StabilityMargin marginAt(std::int64_t step) {
  state::StabilityMargin margin;
  margin.at = whirlAt(step).at;
  margin.system = "rotor";
  margin.model = "jeffcott_rotor";
  margin.verdict_name = "asymptotically_stable";
  margin.coordinate = {"x", "y"};
  margin.operating_point = {0.0, 0.0};
  margin.polynomial = {1.0, 20.0, 1e4};
  margin.left = 2;
  margin.critical_speeds.resize(1);
  margin.critical_speeds[0].direction = "forward";
  return margin;
}

inline state::Alert alertAt(std::int64_t step) {
  state::Alert alert;
  alert.id = 1;
  alert.type = "CRITICAL_SPEED_APPROACH";
  alert.system = "rotor";
  alert.time = alert.raised_time = whirlAt(step).at.time;
  alert.text = "critical speed 100 rad/s in 2 s";
  return alert;
}

/// Steps 0 to steps - 1 of a rotor, its drive and a pendulum; a margin and an alert at step 1.
inline Bytes sampleLog(std::int64_t steps) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  for (std::int64_t step = 0; step < steps; ++step) {
    writer.write(whirlAt(step));
    writer.write(driveAt(step));
    writer.write(pendulumAt(step));
    if (step == 1) {
      writer.write(marginAt(step));
      writer.write(alertAt(step));
    }
  }
  writer.finish();
  return log.read();
}

inline LogSummary summaryOf(const Bytes& bytes) {
  const TemporaryLog log;
  log.write(bytes);
  return readEventLog(log.path());
}

}  // namespace whirl_twin
