// Detects duplicate publishers of a node's twin, for its log and its diagnostics: on ROS by the
// master's registrations, on LCM by the loop statistics received.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <memory>
#include <string>

#include "transport/master_watch.h"
#include "transport/refused_payloads.h"
#include "transport/twin_senders.h"

namespace whirl_twin {

/// Identification of this process for operators: node, host and process number.
std::string nameOfThisProcess();

/// Adds the diagnostics "ROS master" with the faults that `master` reports.
void reportMaster(const MasterWatch& master, diagnostic_updater::Updater& diagnostics);

/// Publishers on the LCM channels of a twin.
class DuplicatePublishers {
 public:
  explicit DuplicatePublishers(const std::string& lcm_prefix);

  /// Subscribes by itself, for a node without an LCM subscription.
  void listen(const std::string& lcm_url);
  /// Handles the received statistics; to be called several times a second.
  void receive();

  /// Payloads received by listen() that are not statistics.
  const RefusedPayloads& refused() const { return refused_; }

  /// Adds statistics that the node received by LCM.
  void take(const state::LoopStatistics& loop);

  /// Adds the diagnostics "LCM channels".
  void report(diagnostic_updater::Updater& diagnostics);

 private:
  std::string trouble();

  TwinSenders senders_;
  std::string prefix_;
  std::unique_ptr<ChannelListener> listener_;
  RefusedPayloads refused_;
  std::string logged_;
};

}  // namespace whirl_twin
