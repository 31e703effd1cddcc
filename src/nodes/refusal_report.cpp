#include "nodes/refusal_report.h"

#include <fmt/format.h>
#include <ros/ros.h>

#include <string>
#include <utility>

namespace whirl_twin {

namespace {

constexpr double kBetweenLines = 5.0;  // s, between lines of the log

}  // namespace

RefusalReport::RefusalReport(diagnostic_updater::Updater& diagnostics,
                             std::vector<const RefusedPayloads*> all)
    : all_(std::move(all)) {
  diagnostics.add("LCM payloads", this, &RefusalReport::summarize);
}

void RefusalReport::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const double now = ros::SteadyTime::now().toSec();
  std::uint64_t total = 0;
  std::string last;
  for (const RefusedPayloads* const refused : all_) {
    if (refused != nullptr && refused->total() > 0) {
      total += refused->total();
      last = refused->last();
      for (const auto& [channel, count] : refused->channels()) {
        status.add("refused on " + channel, count);
      }
    }
  }
  const std::string text = fmt::format("{} refused, of {}", total, last);
  status.summary(DiagnosticStatus::OK, total > 0 ? text : "none refused");
  if (rising_.roseLately(total, now)) {
    status.summary(DiagnosticStatus::WARN, text);
  }
  if (total > logged_ && now - last_line_ >= kBetweenLines) {
    ROS_WARN("LCM payloads: %s", text.c_str());
    logged_ = total;
    last_line_ = now;
  }
}

}  // namespace whirl_twin
