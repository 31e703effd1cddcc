// Payloads that were refused, by channel. Any thread.
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
  /// "CHANNEL: why" of the latest; empty without one.
  std::string last() const;
  /// How many of each channel, of those beyond the first kMostChannels together.
  std::map<std::string, std::uint64_t> channels() const;

  static constexpr std::size_t kMostChannels = 100;  ///< whoever sends chooses their names
  static constexpr const char* kFurther = "further channels";

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> channels_;
  std::string last_;
};

}  // namespace whirl_twin
