// Exports a recording, an LCM log or a rosbag, to a file of ROS messages in the order of their
// times (time_order.h). Messages that cannot be exported are counted, and the first of them listed.
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
  std::uint64_t messages = 0;                    ///< exported
  std::map<std::string, std::uint64_t> topics;   ///< exported, by topic
  std::map<std::string, std::uint64_t> foreign;  ///< LCM events on other channels
  std::uint64_t not_selected = 0;
  std::uint64_t rejected = 0;  ///< invalid messages
  std::uint64_t damaged = 0;   ///< places of the file that could not be read
  /// The first kMaxNamedDefects of the rejected and corrupt ones.
  std::vector<LogDefect> defects;
};

/// Whether an LCM channel, or a topic of a bag, is selected.
using Selects = std::function<bool(const std::string&)>;

/// From an LCM log: events on the channels of the twin that begin with `prefix` become the ROS
/// messages that a bridge would publish, below the namespace /twin for TWIN_, else the prefix in
/// small letters; their time is that of the event, reception or simulated time. From a bag: every
/// message unchanged. Throws InputError for a file that cannot be read, RunFailure for one that
/// cannot be written; does not finish `to`.
LogExport exportLog(const std::string& path, const std::string& prefix, const Selects& selects,
                    RecordingWriter& to, const LogProgress& advanced);

/// The ROS namespace of an LCM prefix: "/twin" of TWIN_.
std::string namespaceOfPrefix(const std::string& prefix);

}  // namespace whirl_twin
