// What is said of the twin as a whole, in a column beside the systems: every active alarm, how the
// loop of the simulation keeps its time, and that the monitor is there.
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

/// How the loop keeps its time, from what it tells once a second.
class LoopHealth {
 public:
  /// @param wall_time [s]
  void take(const LoopStatistics& loop, double wall_time);
  /// There is none to be heard: the twin follows its machine.
  void setFollowing() { following_ = true; }

  /// "loop: 1000 steps/s", "1.00 of real time"; how many steps came late, and how late 99 of 100
  /// wake; that it is silent.
  std::vector<std::string> lines(double wall_time) const;
  /// Alert::WARNING where steps were late, left out or not published since the message before,
  /// where it does not keep up, or is silent; else Alert::INFO.
  int severity(double wall_time) const;

 private:
  static constexpr double kPatience = 3.0;  // s

  bool silent(double wall_time) const { return wall_time - heard_at_ > kPatience; }
  bool behind() const;

  std::optional<LoopStatistics> loop_;
  bool following_ = false;
  double heard_at_ = 0.0;     // [s]
  std::uint64_t lately_ = 0;  // late, left out or unpublished since the message before
};

/// The alarms by severity, a line each, most severe first, at most so many; what is left out is
/// counted in the last.
struct AlarmList {
  std::vector<std::string> danger, warning, info;
  std::string title;  ///< "3 alarms, 1 of them danger"; "no alarms"
};
AlarmList alarmList(const std::vector<Alert>& alerts, std::size_t most);

/// @param silence of the monitor; "" while it beats  @param monitor null: never heard
void drawTwin(const std::vector<Alert>& alerts, const LoopHealth& loop,
              const MonitorStatus::ConstPtr& monitor, const std::string& silence, double wall_time,
              const Layout& layout, visualization_msgs::MarkerArray& markers);

}  // namespace whirl_twin
