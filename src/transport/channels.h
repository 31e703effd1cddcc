// Names of LCM channels and ROS topics. On LCM, with the default prefix TWIN_, names in upper case:
// TWIN_<SYSTEM>_WHIRL, TWIN_<DRIVE>_MOTOR and so on, one each for all: TWIN_ALERTS and TWIN_LOOP.
// On ROS, below the namespace of the twin: <system>/whirl, drives/<drive>/motor, alerts and loop.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messages/message.h"

namespace whirl_twin {

/// Default LCM url of the twin; ttl=0 keeps the traffic on this machine.
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

/// The channel of a kind for a system, drive or source; `subject` is ignored for a kind with one
/// channel for all.
std::string channelName(const MessageKind& kind, const std::string& subject = "",
                        const std::string& prefix = kDefaultLcmPrefix);

/// The topic, below the twin's namespace.
std::string topicName(const MessageKind& kind, const std::string& subject = "");

/// Channel and topic of a message.
template <class State>
std::string channelOf(const State& state, const std::string& prefix = kDefaultLcmPrefix) {
  return channelName(State::kKind, subjectOf(state), prefix);
}
template <class State>
std::string topicOf(const State& state) {
  return topicName(State::kKind, subjectOf(state));
}

/// The parts of a channel name.
struct Channel {
  const MessageKind* kind;
  std::string name;  ///< system, drive or source, in upper case; empty with one channel for all
};

/// Parses a channel name; nothing if a twin with this prefix has no such channel.
std::optional<Channel> parseChannel(const std::string& channel,
                                    const std::string& prefix = kDefaultLcmPrefix);

/// A regular expression that matches the channels of some kinds.
std::string channelPattern(const Kinds& kinds, const std::string& prefix = kDefaultLcmPrefix);

/// Default prefix of a twin in a ROS namespace: TWIN_ for "/twin", else the namespace in upper case
/// with _ for /, as PLANT_MACHINE_ for "/plant/machine".
std::string lcmPrefixOf(const std::string& twin_namespace);

/// Throws InputError unless it is a letter followed by letters, digits and _.
void requireLcmPrefix(const std::string& prefix);

/// Throws InputError if the channel is longer than LCM allows.
void requireChannelFits(const std::string& channel);

}  // namespace whirl_twin
