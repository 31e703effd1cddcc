// The LCM channels of the twin: TWIN_<SYSTEM>_WHIRL, _PENDULUM, _STABILITY, _PARAMETER, _ENSEMBLE,
// TWIN_<DRIVE>_DRIVE, TWIN_<DRIVE>_MOTOR and TWIN_ALERTS, names upper-cased.
#pragma once

#include <optional>
#include <string>

namespace whirl_twin {

/// Where the twin's LCM traffic goes unless told otherwise; ttl=0 keeps it on this machine.
inline constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

enum class ChannelKind {
  kWhirl,
  kPendulum,
  kStability,
  kParameter,
  kEnsemble,
  kDrive,
  kMotor,
  kAlerts
};

/// "whirl", "pendulum", "stability", "parameter", "ensemble", "drive", "motor" or "alerts".
const char* toString(ChannelKind kind);

/// The channel of a system or drive: (kWhirl, "rotor") -> "TWIN_ROTOR_WHIRL". Alerts have one
/// channel for all systems; `name` is not used then.
std::string channelName(ChannelKind kind, const std::string& name = "");

/// A channel taken apart.
struct Channel {
  ChannelKind kind;
  std::string name;  ///< of the system or drive, upper-cased; empty for the alerts
};

/// The parts of a channel name, or nothing if the twin has no such channel.
std::optional<Channel> parseChannel(const std::string& channel);

}  // namespace whirl_twin
