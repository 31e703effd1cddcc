#include "display/twin_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "display/status_text.h"
#include "display/system_display.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kLineOfPanel = 34;  // characters
constexpr double kCharacter = 0.46;       // width of a character relative to its height
constexpr double kCharacters = 40.0;      // width of the column, spacing beside the lines included
constexpr std::size_t kMaxAlarms = 20;

std::vector<std::string> wrapped(const std::vector<std::string>& lines) {
  std::vector<std::string> all;
  for (const std::string& line : lines) {
    const auto pieces = wrapText(line, kLineOfPanel);
    all.insert(all.end(), pieces.begin(), pieces.end());
  }
  return all;
}

/// "12 us", "1.3 ms"
std::string shortTime(double seconds) {
  return seconds < 1.0e-3 ? fmt::format("{:.0f} us", 1.0e6 * seconds)
                          : fmt::format("{:.3g} ms", 1.0e3 * seconds);
}

std::vector<std::string> monitorLines(const MonitorStatus::ConstPtr& monitor,
                                      const std::string& silence) {
  if (!silence.empty()) {
    return {silence};
  }
  if (!monitor) {
    return {"monitor: no message received"};
  }
  double oldest = 0.0;
  std::size_t unjudged = 0;
  for (const double age : monitor->verdict_age) {
    oldest = std::isfinite(age) ? std::max(oldest, age) : oldest;
    unjudged += std::isfinite(age) ? 0 : 1;
  }
  std::vector<std::string> lines = {monitor->paused
                                        ? "monitor: active, simulation paused"
                                        : fmt::format("monitor: oldest verdict {:.2g} s", oldest)};
  if (unjudged > 0) {
    lines.push_back(fmt::format("  {} not evaluated", unjudged));
  }
  for (std::size_t i = 0; i < std::min(monitor->not_ok.size(), monitor->system.size()); ++i) {
    if (!monitor->not_ok[i].empty()) {
      lines.push_back(fmt::format("  {}: {}", monitor->system[i], monitor->not_ok[i]));
    }
  }
  return lines;
}

}  // namespace

void LoopHealth::take(const LoopStatistics& loop, double wall_time) {
  const auto troubles = [](const LoopStatistics& l) {
    return l.overruns + l.skipped_steps + l.dropped_snapshots;
  };
  const std::uint64_t before = loop_ ? troubles(*loop_) : troubles(loop);
  lately_ = troubles(loop) > before ? troubles(loop) - before : 0;  // less: restarted
  loop_ = loop;
  heard_at_ = wall_time;
}

bool LoopHealth::behind() const {
  constexpr double kEnough = 0.95;
  return !loop_->paused && loop_->real_time_factor > 0.0 &&
         loop_->achieved_factor < kEnough * loop_->real_time_factor;
}

int LoopHealth::severity(double wall_time) const {
  return loop_ && (lately_ > 0 || behind() || silent(wall_time)) ? Alert::WARNING : Alert::INFO;
}

std::vector<std::string> LoopHealth::lines(double wall_time) const {
  if (!loop_) {
    return {following_ ? "estimates its machine" : "loop: no message received"};
  }
  const LoopStatistics& loop = *loop_;
  std::vector<std::string> lines;
  if (silent(wall_time)) {
    return {fmt::format("loop: no message for {:.0f} s", wall_time - heard_at_)};
  }
  lines.push_back(loop.step_size > 0.0 ? fmt::format("loop: {:.0f} steps/s", 1.0 / loop.step_size)
                                       : "loop");
  if (loop.paused) {
    lines.emplace_back("  paused");
  } else if (std::isfinite(loop.achieved_factor)) {
    lines.push_back(fmt::format("  {:.2f} of real time{}", loop.achieved_factor,
                                loop.real_time_factor == 0.0 ? " (as fast as possible)"
                                : loop.real_time_factor > 0.0
                                    ? fmt::format(" ({:g} requested)", loop.real_time_factor)
                                    : ""));
  }
  lines.push_back(fmt::format("  overruns {}, skipped {}", loop.overruns, loop.skipped_steps));
  lines.push_back(fmt::format("  unpublished {}", loop.dropped_snapshots));
  if (lately_ > 0) {
    lines.push_back(fmt::format("  {} of them recently", lately_));
  }
  lines.push_back(fmt::format("  wake-up latency {}", shortTime(loop.wakeup_latency_p99)));
  lines.push_back(fmt::format("  step takes {}", shortTime(loop.execution_p99)));
  return lines;
}

AlarmList alarmList(const std::vector<Alert>& alerts, std::size_t most) {
  AlarmList list;
  std::size_t dangers = 0;
  std::size_t shown = 0;
  std::vector<Alert> sorted = alerts;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Alert& a, const Alert& b) { return a.severity > b.severity; });
  for (const Alert& alert : sorted) {
    dangers += alert.severity >= Alert::DANGER ? 1 : 0;
    if (shown == most) {
      continue;
    }
    ++shown;
    auto& lines = alert.severity >= Alert::DANGER    ? list.danger
                  : alert.severity == Alert::WARNING ? list.warning
                                                     : list.info;
    lines.push_back(fmt::format("{} {} {}{}", severityName(alert.severity), alert.system,
                                alert.type, alert.acknowledged ? " (acknowledged)" : ""));
  }
  if (alerts.size() > shown) {
    list.info.push_back(fmt::format("and {} more", alerts.size() - shown));
  }
  list.title = alerts.empty()       ? "no alarms"
               : alerts.size() == 1 ? "1 alarm"
                                    : fmt::format("{} alarms", alerts.size());
  list.title += dangers > 0 ? fmt::format(", {} of them danger", dangers) : "";
  return list;
}

void drawTwin(const std::vector<Alert>& alerts, const LoopHealth& loop,
              const MonitorStatus::ConstPtr& monitor, const std::string& silence, double wall_time,
              const Layout& layout, visualization_msgs::MarkerArray& markers) {
  Eigen::Isometry3d board = Eigen::Isometry3d::Identity();
  board.translation() = layout.column;
  board.linear() = boardAxes();
  MarkerCanvas canvas(markers, "(twin)", board);  // no system's name
  const double height = layout.column_width / (kCharacter * kCharacters);
  const AlarmList list = alarmList(alerts, kMaxAlarms);
  TextStack stack(Eigen::Vector3d::Zero(), canvas);
  const int health = loop.severity(wall_time);
  stack.add("loop", wrapped(loop.lines(wall_time)), height,
            health == Alert::INFO ? kWordsColor : severityColor(health));
  stack.add("monitor", wrapped(monitorLines(monitor, silence)), height,
            silence.empty() ? kWordsColor : severityColor(Alert::WARNING));
  stack.add("alarms", wrapped(list.info), height, severityColor(Alert::INFO));
  stack.add("alarms", wrapped(list.warning), height, severityColor(Alert::WARNING));
  stack.add("alarms", wrapped(list.danger), height, severityColor(Alert::DANGER));
  // After a timeout of the monitor its last alerts may no longer be active.
  stack.add("title", {silence.empty() ? list.title : "alarms unknown, last: " + list.title},
            1.2 * height, severityColor(alerts, kWordsColor));
}

}  // namespace whirl_twin
