// Reads the messages of a twin, or of its machine, from an LCM log or a rosbag, for the tools that
// evaluate recordings. Corrupt places are skipped and counted.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "transport/channels.h"

namespace whirl_twin {

struct LoggedMessages {
  std::uint64_t size = 0;      ///< [bytes], of the file
  std::uint64_t taken = 0;     ///< messages
  std::uint64_t rejected = 0;  ///< invalid messages
  std::uint64_t damaged = 0;   ///< places of the file that could not be read
  std::string first_damage;    ///< "byte 1234: what was expected there"; "": none
  /// Of a bag: other prefixes under which it has messages of the selected kinds.
  std::set<std::string> elsewhere;
  std::uint64_t out_of_order = 0;    ///< messages after one with a later stamp
  std::vector<std::string> remarks;  ///< of another kind of file that is read as a log
};

/// Order of an LCM log: by stamps, or that of the file, for readers that distinguish an appended
/// run from messages out of order. A bag is always read by its stamps.
enum class LogOrder { kRecorded, kOfFile };

/// Called with each message and its stamp [us]: time of reception, or simulated time. A
/// RejectedMessage that it throws is counted as rejected.
using TakeLogged = std::function<void(const Message&, std::int64_t)>;
/// Called once per kMessagesPerProgress messages with the bytes read and the bytes in total.
using LogProgress = std::function<void(std::uint64_t, std::uint64_t)>;
inline constexpr std::uint64_t kMessagesPerProgress = 256;

inline constexpr std::int64_t kMicrosecond = 1'000;  ///< [ns]

/// Calls `take` with every message of these kinds on the channels that begin with `prefix`, in the
/// order of their stamps (time_order.h). In a bag MACHINE_ matches the topics of the namespace
/// /machine, and sensor_msgs/JointState are measurements (bag_decode.h), with any prefix if their
/// topic has no namespace. Throws InputError for a file that cannot be read.
LoggedMessages readLoggedMessages(const std::string& path, const std::string& prefix,
                                  const Kinds& kinds, const TakeLogged& take,
                                  const LogProgress& advanced,
                                  LogOrder order = LogOrder::kRecorded);

/// "2 of 7 messages lie after a later one: taken in the order of their recorded times"
std::string outOfOrder(const LoggedMessages& log);

/// "found none in 1234 bytes", the corrupt places and the other prefixes present.
std::string foundElsewhere(const LoggedMessages& log);

}  // namespace whirl_twin
