// Counts rejected payloads by channel. Thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace whirl_twin {

class RefusedPayloads {
 public:
  void add(const std::string& channel, const std::string& why);

  std::uint64_t total() const;
  /// "CHANNEL: why" of the latest; "" if there is none.
  std::string last() const;
  /// Their number by channel; the channels beyond the first kMaxChannels share one entry.
  std::map<std::string, std::uint64_t> channels() const;

  static constexpr std::size_t kMaxChannels = 100;  ///< the sender chooses their names
  static constexpr const char* kFurther = "further channels";

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> channels_;
  std::string last_;
};

}  // namespace whirl_twin
