#include "transport/refused_payloads.h"

#include "messages/names.h"

namespace whirl_twin {

void RefusedPayloads::add(const std::string& channel, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string shown = printable(channel);
  const bool known = channels_.count(shown) > 0 || channels_.size() < kMaxChannels;
  ++channels_[known ? shown : kFurther];
  last_ = shown + ": " + why;
}

std::uint64_t RefusedPayloads::total() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t sum = 0;
  for (const auto& [channel, count] : channels_) {
    sum += count;
  }
  return sum;
}

std::string RefusedPayloads::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

std::map<std::string, std::uint64_t> RefusedPayloads::channels() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return channels_;
}

}  // namespace whirl_twin
