// A recording, an LCM log or a rosbag, into a file of ROS messages: message by message in the order
// of their times (time_order.h), with what cannot be passed on counted and its first places named.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "transport/lcm_event_log.h"
#include "transport/logged_messages.h"
#include "transport/recording_writer.h"

namespace whirl_twin {

struct LogExport {
  std::uint64_t size = 0;                        ///< [bytes], of the recording
  std::uint64_t messages = 0;                    ///< passed on
  std::map<std::string, std::uint64_t> topics;   ///< of them, by topic
  std::map<std::string, std::uint64_t> foreign;  ///< events of an LCM log on no channel of the twin
  std::uint64_t not_selected = 0;
  std::uint64_t rejected = 0;  ///< that could not be meant
  std::uint64_t damaged = 0;   ///< places of the file that could not be read
  /// The first kMaxNamedDefects of those rejected and damaged.
  std::vector<LogDefect> defects;
};

/// Whether messages of an LCM channel, or of a topic of a bag, are wanted.
using Selects = std::function<bool(const std::string&)>;

/// Of an LCM log: events on the channels of the twin that begin with `prefix` become the ROS
/// messages that a bridge would publish, below the namespace /twin for TWIN_, else the prefix in
/// small letters; their time is that of the event, received or simulated. Of a bag: every message
/// as it is. Throws Refusal for a file that cannot be read, RunFailure for one that cannot be
/// written; does not finish `to`.
LogExport exportLog(const std::string& path, const std::string& prefix, const Selects& selects,
                    RecordingWriter& to, const LogProgress& advanced);

/// "/twin" of TWIN_: below which topics of what came over LCM are told.
std::string namespaceOfPrefix(const std::string& prefix);

}  // namespace whirl_twin
