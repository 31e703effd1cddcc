// Who else is the twin of a node, for its log and its diagnostics: on ROS by what the master knows,
// on LCM by the loop statistics that arrive there.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <memory>
#include <string>

#include "transport/master_watch.h"
#include "transport/refused_payloads.h"
#include "transport/twin_senders.h"

namespace whirl_twin {

/// How this process is called where another is to be found: node, host and number.
std::string nameOfThisProcess();

/// What the watch says stands in the way, as the diagnostics "ROS master".
void reportMaster(const MasterWatch& master, diagnostic_updater::Updater& diagnostics);

/// Those who send a twin's LCM channels.
class LcmRivals {
 public:
  explicit LcmRivals(const std::string& lcm_prefix);

  /// Listens by itself, in a node that does not.
  void listen(const std::string& lcm_url);
  /// Takes what has arrived since; to be called several times a second.
  void receive();

  /// Payloads that it has received itself and that were no statistics.
  const RefusedPayloads& refused() const { return refused_; }

  /// Statistics that have arrived by LCM.
  void take(const state::LoopStatistics& loop);

  /// As the diagnostics "LCM channels".
  void report(diagnostic_updater::Updater& diagnostics);

 private:
  std::string trouble();

  TwinSenders senders_;
  std::string prefix_;
  std::unique_ptr<ChannelListener> listener_;
  RefusedPayloads refused_;
  std::string told_;
};

}  // namespace whirl_twin
