#include "nodes/duplicate_publishers.h"

#include <fmt/format.h>
#include <ros/ros.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <variant>

#include "transport/channels.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using Status = diagnostic_updater::DiagnosticStatusWrapper;

double now() {
  return ros::SteadyTime::now().toSec();
}

}  // namespace

std::string nameOfThisProcess() {
  std::array<char, HOST_NAME_MAX + 1> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("{} on {} (process {})", ros::this_node::getName(), host.data(), getpid());
}

void reportMaster(const MasterWatch& master, diagnostic_updater::Updater& diagnostics) {
  diagnostics.add("ROS master", [&master](Status& status) {
    const std::string trouble = master.trouble();
    status.summary(trouble.empty() ? DiagnosticStatus::OK : DiagnosticStatus::ERROR,
                   trouble.empty() ? "this node is registered" : trouble);
  });
}

DuplicatePublishers::DuplicatePublishers(const std::string& lcm_prefix)
    : senders_(fmt::format("the LCM channels {}*", lcm_prefix),
               "give one of them another ~lcm_prefix, or stop it"),
      prefix_(lcm_prefix) {}

void DuplicatePublishers::listen(const std::string& lcm_url) {
  if (!ChannelListener::canListenTo(lcm_url)) {
    return;
  }
  try {
    listener_ = std::make_unique<ChannelListener>(
        lcm_url, channelName(state::LoopStatistics::kKind, "", prefix_));
  } catch (const LcmNotAvailable& problem) {
    ROS_WARN("%s; a duplicate publisher on its channels cannot be detected", problem.what());
  }
}

void DuplicatePublishers::receive() {
  while (listener_) {
    const auto payload = listener_->next();
    if (!payload) {
      return;
    }
    const std::string channel = channelName(state::LoopStatistics::kKind, "", prefix_);
    try {
      take(std::get<state::LoopStatistics>(
          decodeEvent(channel, payload->data(), payload->size(), prefix_)));
    } catch (const RejectedMessage& why) {
      refused_.add(channel, why.what());
    }
  }
}

void DuplicatePublishers::take(const state::LoopStatistics& loop) {
  senders_.take(loop, now());
  trouble();
}

void DuplicatePublishers::report(diagnostic_updater::Updater& diagnostics) {
  diagnostics.add("LCM channels", [this](Status& status) {
    const std::string found = trouble();
    status.summary(found.empty() ? DiagnosticStatus::OK : DiagnosticStatus::ERROR,
                   found.empty() ? "no duplicate publisher" : found);
  });
}

/// The present problem; logged when it changes.
std::string DuplicatePublishers::trouble() {
  std::string found = senders_.trouble(now());
  if (found != logged_) {
    if (found.empty()) {
      ROS_INFO("no duplicate publisher is left on its LCM channels");
    } else {
      ROS_ERROR("%s", found.c_str());
    }
    logged_ = found;
  }
  return found;
}

}  // namespace whirl_twin
