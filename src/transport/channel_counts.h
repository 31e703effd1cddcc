// Statistics of the channels of a twin: events, events missing by their steps, invalid events.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "transport/channels.h"
#include "transport/step_continuity.h"

namespace whirl_twin {

class ChannelCounts {
 public:
  struct Count {
    std::string kind;  ///< "whirl", ...; "other" if it is not a channel of the twin
    std::uint64_t events = 0;
    std::uint64_t bytes = 0;
    std::uint64_t rejected = 0;
    StepContinuity steps;
    std::int64_t first = 0, last = 0;  ///< [us], reception
    std::optional<Message> newest;     ///< latest valid message
  };

  explicit ChannelCounts(std::string prefix) : prefix_(std::move(prefix)) {}

  /// Returns the decoded message if the channel is the twin's and the message is valid.
  const Message* add(const std::string& channel, std::int64_t received, const std::uint8_t* data,
                     std::size_t size);

  const std::map<std::string, Count>& channels() const { return channels_; }
  /// Over all channels.
  std::uint64_t events() const;
  std::uint64_t lost() const;
  std::uint64_t rejected() const;

 private:
  std::string prefix_;
  std::map<std::string, Count> channels_;
};

}  // namespace whirl_twin
