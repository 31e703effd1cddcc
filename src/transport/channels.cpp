#include "transport/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool isLower(char c) {
  return c >= 'a' && c <= 'z';
}

std::string upperCased(const std::string& text) {
  std::string upper_cased;
  std::transform(text.begin(), text.end(), std::back_inserter(upper_cased), upper);
  return upper_cased;
}

bool hasSubject(const MessageKind& kind) {
  return std::string(kind.topic).find('*') != std::string::npos;
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), std::string::npos, end) == 0;
}

}  // namespace

Kinds allKinds() {
  Kinds kinds;
  eachKind([&kinds](auto kind) { kinds.push_back(&decltype(kind)::State::kKind); });
  return kinds;
}

std::string channelName(const MessageKind& kind, const std::string& subject,
                        const std::string& prefix) {
  const std::string about = hasSubject(kind) ? upperCased(subject) + "_" : "";
  return prefix + about + upperCased(kind.name);
}

std::string topicName(const MessageKind& kind, const std::string& subject) {
  std::string topic = kind.topic;
  const std::size_t at = topic.find('*');
  return at == std::string::npos ? topic : topic.replace(at, 1, subject);
}

std::optional<Channel> parseChannel(const std::string& channel, const std::string& prefix) {
  if (channel.compare(0, prefix.size(), prefix) != 0) {
    return std::nullopt;
  }
  const std::string rest = channel.substr(prefix.size());
  for (const MessageKind* kind : allKinds()) {
    const std::string ending = upperCased(kind->name);
    if (!hasSubject(*kind)) {
      if (rest == ending) {
        return Channel{kind, ""};
      }
    } else if (endsWith(rest, "_" + ending)) {
      const std::string name = rest.substr(0, rest.size() - ending.size() - 1);
      if (isLegalName(name) && std::none_of(name.begin(), name.end(), isLower)) {
        return Channel{kind, name};
      }
    }
  }
  return std::nullopt;
}

std::string channelPattern(const Kinds& kinds, const std::string& prefix) {
  std::vector<std::string> channels;
  for (const MessageKind* kind : kinds) {
    channels.push_back(channelName(*kind, ".*", prefix));
  }
  return fmt::format("({})", fmt::join(channels, "|"));
}

std::string lcmPrefixOf(const std::string& twin_namespace) {
  std::string prefix = upperCased(twin_namespace.substr(twin_namespace.find_first_not_of('/')));
  std::replace(prefix.begin(), prefix.end(), '/', '_');
  return prefix + "_";
}

void requireLcmPrefix(const std::string& prefix) {
  if (!isLegalName(prefix)) {
    throw InputError(fmt::format(
        "lcm_prefix: expected a letter and then letters, digits or _, found {}", inQuotes(prefix)));
  }
}

void requireChannelFits(const std::string& channel) {
  if (channel.size() > kMaxChannelLength) {
    throw InputError(
        fmt::format("lcm_prefix: LCM channels have at most {} characters, {} would have {}",
                    kMaxChannelLength, channel, channel.size()));
  }
}

}  // namespace whirl_twin
