#include "transport/channels.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "messages/message_check.h"

namespace whirl_twin {
namespace {

constexpr std::string_view kPrefix = "TWIN_";
constexpr std::string_view kAlertChannel = "TWIN_ALERTS";

struct Suffix {
  ChannelKind kind;
  std::string_view text;
};
constexpr std::array<Suffix, 7> kSuffixes{{{ChannelKind::kWhirl, "_WHIRL"},
                                           {ChannelKind::kPendulum, "_PENDULUM"},
                                           {ChannelKind::kStability, "_STABILITY"},
                                           {ChannelKind::kParameter, "_PARAMETER"},
                                           {ChannelKind::kEnsemble, "_ENSEMBLE"},
                                           {ChannelKind::kDrive, "_DRIVE"},
                                           {ChannelKind::kMotor, "_MOTOR"}}};

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool isLower(char c) {
  return c >= 'a' && c <= 'z';
}

}  // namespace

const char* toString(ChannelKind kind) {
  switch (kind) {
    case ChannelKind::kWhirl:
      return "whirl";
    case ChannelKind::kPendulum:
      return "pendulum";
    case ChannelKind::kStability:
      return "stability";
    case ChannelKind::kParameter:
      return "parameter";
    case ChannelKind::kEnsemble:
      return "ensemble";
    case ChannelKind::kDrive:
      return "drive";
    case ChannelKind::kMotor:
      return "motor";
    case ChannelKind::kAlerts:
      return "alerts";
  }
  return "";
}

std::string channelName(ChannelKind kind, const std::string& name) {
  if (kind == ChannelKind::kAlerts) {
    return std::string(kAlertChannel);
  }
  std::string channel(kPrefix);
  std::transform(name.begin(), name.end(), std::back_inserter(channel), upper);
  const auto* suffix = std::find_if(kSuffixes.begin(), kSuffixes.end(),
                                    [kind](const Suffix& s) { return s.kind == kind; });
  return channel.append(suffix->text);
}

std::optional<Channel> parseChannel(const std::string& channel) {
  if (channel == kAlertChannel) {
    return Channel{ChannelKind::kAlerts, ""};
  }
  if (channel.compare(0, kPrefix.size(), kPrefix) != 0) {
    return std::nullopt;
  }
  for (const auto& suffix : kSuffixes) {
    const std::size_t affixes = kPrefix.size() + suffix.text.size();
    if (channel.size() <= affixes ||
        channel.compare(channel.size() - suffix.text.size(), std::string::npos, suffix.text) != 0) {
      continue;
    }
    const auto name = channel.substr(kPrefix.size(), channel.size() - affixes);
    if (isLegalName(name) && std::none_of(name.begin(), name.end(), isLower)) {
      return Channel{suffix.kind, name};
    }
  }
  return std::nullopt;
}

}  // namespace whirl_twin
