// Records LCM events as they are into a log. The stock lcm-logger does so as well, but keeps at
// most 30 messages that it has not looked at yet, and loses the rest in silence when the machine is
// busy for a few milliseconds; here there is no such limit.
#pragma once

#include <chrono>
#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

namespace whirl_twin {

class LcmRecorder {
 public:
  /// Listens to the channels that match `pattern`, a regular expression, and writes into a new file
  /// at `path`, or over an existing one. Throws LcmNotAvailable if LCM cannot receive,
  /// RunFailure if the file cannot be written.
  LcmRecorder(std::shared_ptr<lcm::LCM> lcm, const std::string& pattern, const std::string& path);
  ~LcmRecorder();
  LcmRecorder(const LcmRecorder&) = delete;
  LcmRecorder& operator=(const LcmRecorder&) = delete;

  /// Waits up to `timeout` for an event, records all that have arrived, at most `most` of them, and
  /// hands them to the file system. Returns how many. Throws RunFailure if they cannot be
  /// written.
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
