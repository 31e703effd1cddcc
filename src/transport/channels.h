// Where messages go. On LCM, with the prefix TWIN_ unless told otherwise, names upper-cased:
// TWIN_<SYSTEM>_WHIRL, TWIN_<DRIVE>_MOTOR and so on, one for all TWIN_ALERTS and TWIN_LOOP. On ROS,
// below the namespace of the twin: <system>/whirl, drives/<drive>/motor, alerts and loop.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messages/message.h"

namespace whirl_twin {

/// Where the twin's LCM traffic goes unless told otherwise; ttl=0 keeps it on this machine.
inline constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

inline constexpr const char* kDefaultLcmPrefix = "TWIN_";

/// Longest name of an LCM channel [characters].
inline constexpr std::size_t kMaxChannelLength = 63;

using Kinds = std::vector<const MessageKind*>;

template <class... States>
Kinds kindsOf() {
  return {&States::kKind...};
}
Kinds allKinds();

/// The channel of a kind about a system, drive or source; `subject` is not used where there is one
/// channel for all.
std::string channelName(const MessageKind& kind, const std::string& subject = "",
                        const std::string& prefix = kDefaultLcmPrefix);

/// The topic, below the twin's namespace.
std::string topicName(const MessageKind& kind, const std::string& subject = "");

/// Where a message belongs.
template <class State>
std::string channelOf(const State& state, const std::string& prefix = kDefaultLcmPrefix) {
  return channelName(State::kKind, subjectOf(state), prefix);
}
template <class State>
std::string topicOf(const State& state) {
  return topicName(State::kKind, subjectOf(state));
}

/// A channel taken apart.
struct Channel {
  const MessageKind* kind;
  std::string name;  ///< of the system, drive or source, upper-cased; empty where one is for all
};

/// The parts of a channel name, or nothing if a twin with this prefix has no such channel.
std::optional<Channel> parseChannel(const std::string& channel,
                                    const std::string& prefix = kDefaultLcmPrefix);

/// A regular expression for the channels of some kinds.
std::string channelPattern(const Kinds& kinds, const std::string& prefix = kDefaultLcmPrefix);

/// The prefix of a twin in a ROS namespace, where none is given: TWIN_ for "/twin", else the
/// namespace upper-cased with _ for /, as PLANT_MACHINE_ for "/plant/machine".
std::string lcmPrefixOf(const std::string& twin_namespace);

/// Throws Refusal unless it is a letter and then letters, digits and _.
void requireLcmPrefix(const std::string& prefix);

/// Throws Refusal if the channel is longer than LCM allows.
void requireChannelFits(const std::string& channel);

}  // namespace whirl_twin
