// Status of the twin as a whole, in a column beside the systems: every active alarm, the timing of
// the simulation loop, and the heartbeat of the monitor.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "display/layout.h"
#include "display/marker_canvas.h"
#include "whirl_twin/Alert.h"
#include "whirl_twin/LoopStatistics.h"
#include "whirl_twin/MonitorStatus.h"

namespace whirl_twin {

/// Timing of the loop, from its statistics once a second.
class LoopHealth {
 public:
  /// @param wall_time [s]
  void take(const LoopStatistics& loop, double wall_time);
  /// No loop statistics are expected: the twin runs as a state estimator.
  void setFollowing() { following_ = true; }

  /// "loop: 1000 steps/s", "1.00 of real time"; the number of deadline misses, the 99th percentile
  /// of the wake-up latency; a timeout.
  std::vector<std::string> lines(double wall_time) const;
  /// Alert::WARNING where steps missed their deadline, were skipped or not published since the
  /// previous message, where the loop is slower than required, or after a timeout; else
  /// Alert::INFO.
  int severity(double wall_time) const;

 private:
  static constexpr double kPatience = 3.0;  // s

  bool silent(double wall_time) const { return wall_time - heard_at_ > kPatience; }
  bool behind() const;

  std::optional<LoopStatistics> loop_;
  bool following_ = false;
  double heard_at_ = 0.0;     // [s]
  std::uint64_t lately_ = 0;  // late, skipped or unpublished since the previous message
};

/// The alarms by severity, one line each, most severe first, at most `most`; the last line counts
/// the omitted ones.
struct AlarmList {
  std::vector<std::string> danger, warning, info;
  std::string title;  ///< "3 alarms, 1 of them danger"; "no alarms"
};
AlarmList alarmList(const std::vector<Alert>& alerts, std::size_t most);

/// @param silence of the monitor; "" without a timeout  @param monitor null: never received
void drawTwin(const std::vector<Alert>& alerts, const LoopHealth& loop,
              const MonitorStatus::ConstPtr& monitor, const std::string& silence, double wall_time,
              const Layout& layout, visualization_msgs::MarkerArray& markers);

}  // namespace whirl_twin
