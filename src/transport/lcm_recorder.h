// Records LCM events unchanged into a log. The stock lcm-logger queues at most 30 messages and
// loses further ones silently when the machine is busy for a few milliseconds; this recorder has no
// such limit.
#pragma once

#include <chrono>
#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

namespace whirl_twin {

class LcmRecorder {
 public:
  /// Subscribes to the channels that match `pattern`, a regular expression, and creates or
  /// overwrites the file at `path`. Throws LcmNotAvailable if LCM cannot receive, RunFailure if the
  /// file cannot be written.
  LcmRecorder(std::shared_ptr<lcm::LCM> lcm, const std::string& pattern, const std::string& path);
  ~LcmRecorder();
  LcmRecorder(const LcmRecorder&) = delete;
  LcmRecorder& operator=(const LcmRecorder&) = delete;

  /// Waits up to `timeout` for an event, records the queued events, at most `most` of them, and
  /// flushes the file. Returns their number. Throws RunFailure if they cannot be written.
  int record(std::chrono::milliseconds timeout, int most = 1000);

  std::uint64_t recorded() const { return recorded_; }

 private:
  static void take(const lcm_recv_buf_t* buffer, const char* channel, void* recorder);

  std::shared_ptr<lcm::LCM> lcm_;
  std::string path_;
  lcm::LogFile file_;
  lcm_subscription_t* subscription_ = nullptr;
  std::uint64_t recorded_ = 0;
  int error_ = 0;  ///< errno of the first event that could not be written
};

}  // namespace whirl_twin
