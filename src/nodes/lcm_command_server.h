// Executes commands received by LCM by the services of a simulation on ROS, and sends the answers.
// One commander at a time holds the lease of the twin; pause is accepted from any sender.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "nodes/command_channels.h"
#include "realtime/timing_histogram.h"

namespace whirl_twin {

// Lease of the command: the last commander excludes others for a while.

class CommandArbiter {
 public:
  /// duration [s], from the last command of a holder.
  explicit CommandArbiter(double duration) : duration_(duration) {}

  /// A command arrives at `now` [s, a monotonic clock]. Returns "" and gives the lease to its
  /// sender, or returns the holder and the remaining time.
  std::string ask(const std::string& sender, double now);
  /// Ends the lease if the sender holds it.
  void release(const std::string& sender);
  /// The holder; "" without one.
  std::string holder(double now) const { return now < until_ ? holder_ : ""; }

 private:
  double duration_;      // [s]
  double until_ = -1.0;  // [s]
  std::string holder_;
};

struct CommandCounts {
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;
  std::string last_refusal;
  std::string holder;       ///< of the lease; "": none
  TimingHistogram latency;  ///< [ns], from a command's sending to its answer
};

class LcmCommandServer {
 public:
  /// simulation: the node whose services are called. played: accept commands with old times, as
  /// those of a log. `channels` must outlive it.
  LcmCommandServer(CommandChannels& channels, std::string name, std::string simulation,
                   double lease, bool played);
  ~LcmCommandServer();

  CommandCounts counts() const;
  /// Sends the heartbeat on the channel of the answers; to be called once a second.
  void beat();
  /// Other servers that receive the same commands: each command would be executed twice.
  std::vector<std::string> others() const;

 private:
  void take(const twin_command_t& command);
  void hear(const command_answer_t& answer);
  std::string diagnosticOf(const twin_command_t& command);
  void run();
  void carryOut(const twin_command_t& command);
  void refuse(const twin_command_t& command, const std::string& why);
  void answer(const twin_command_t& command, command_answer_t answer);

  CommandChannels& channels_;
  std::string name_;
  std::string simulation_;
  bool played_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable came_;
  CommandArbiter lease_;
  CommandCounts counts_;
  std::deque<twin_command_t> waiting_;
  std::map<std::string, double> heard_;  // [s], last heartbeat of each other server
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace whirl_twin
