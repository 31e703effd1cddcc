#include "transport/channel_counts.h"

#include "messages/message_check.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {

const Message* ChannelCounts::add(const std::string& channel, std::int64_t received,
                                  const std::uint8_t* data, std::size_t size) {
  const auto [place, is_new] = channels_.try_emplace(channel);
  Count& count = place->second;
  if (is_new) {
    const auto parsed = parseChannel(channel, prefix_);
    count.kind = parsed ? parsed->kind->name : "other";
    count.first = received;
  }
  ++count.events;
  count.bytes += size;
  count.last = received;
  if (count.kind == "other") {
    return nullptr;
  }
  try {
    count.newest = decodeEvent(channel, data, size, prefix_);
  } catch (const RejectedMessage&) {
    ++count.rejected;
    return nullptr;
  }
  if (const auto step = seriesStep(*count.newest)) {
    count.steps.add(*step);
  }
  return &*count.newest;
}

std::uint64_t ChannelCounts::events() const {
  std::uint64_t sum = 0;
  for (const auto& channel : channels_) {
    sum += channel.second.events;
  }
  return sum;
}

std::uint64_t ChannelCounts::lost() const {
  std::uint64_t sum = 0;
  for (const auto& channel : channels_) {
    sum += channel.second.steps.lost();
  }
  return sum;
}

std::uint64_t ChannelCounts::rejected() const {
  std::uint64_t sum = 0;
  for (const auto& channel : channels_) {
    sum += channel.second.rejected;
  }
  return sum;
}

}  // namespace whirl_twin
