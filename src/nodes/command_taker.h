// Commands that come by LCM, to the services of a simulation on ROS, and their answers back. One
// commander at a time has the twin (nodes/command_taker.h); whoever it is, pause is obeyed.
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

// One commander at a time: who has commanded last keeps the twin to itself for a while.

class CommandLease {
 public:
  /// duration [s], from the last command of a holder on.
  explicit CommandLease(double duration) : duration_(duration) {}

  /// A command comes at `now` [s, a clock that only goes forward]. "" if it may: the lease is its
  /// sender's from then on; else who has it, and for how long.
  std::string ask(const std::string& sender, double now);
  /// Ends the lease, if it is the sender's.
  void release(const std::string& sender);
  /// Who has it; "": nobody.
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
  std::string holder;       ///< of the lease; "": nobody
  TimingHistogram latency;  ///< [ns], from a command's sending to its answer
};

class CommandTaker {
 public:
  /// simulation: the node, whose services are called. played: also commands that were sent long
  /// ago, as those of a log are. `channels` outlives it.
  CommandTaker(CommandChannels& channels, std::string name, std::string simulation, double lease,
               bool played);
  ~CommandTaker();

  CommandCounts counts() const;
  /// Says on the channel of the answers that it is there; once a second.
  void beat();
  /// Who else takes commands there: each would be done twice.
  std::vector<std::string> others() const;

 private:
  void take(const twin_command_t& command);
  void hear(const command_answer_t& answer);
  std::string objectionTo(const twin_command_t& command);
  void run();
  void carryOut(const twin_command_t& command);
  void refuse(const twin_command_t& command, const std::string& why);
  void answer(const twin_command_t& command, command_answer_t answer);

  CommandChannels& channels_;
  std::string name_;
  std::string simulation_;
  bool played_;
  mutable std::mutex mutex_;  // all below
  std::condition_variable came_;
  CommandLease lease_;
  CommandCounts counts_;
  std::deque<twin_command_t> waiting_;
  std::map<std::string, double> heard_;  // [s], when another taker was last
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace whirl_twin
