// The messages of a twin, or of its machine, out of a recording, an LCM log or a rosbag: the one
// place that reads what was recorded for those who look at what it says. What is damaged is passed
// over and counted.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "transport/channels.h"

namespace whirl_twin {

struct LoggedMessages {
  std::uint64_t size = 0;      ///< [bytes], of the file
  std::uint64_t taken = 0;     ///< messages
  std::uint64_t rejected = 0;  ///< that could not be meant
  std::uint64_t damaged = 0;   ///< places of the file that could not be read
  std::string first_damage;    ///< "byte 1234: what was expected there"; "": none
  /// Of a bag: with which other prefixes it has messages of the kinds that were asked for.
  std::set<std::string> elsewhere;
  std::uint64_t out_of_order = 0;  ///< messages that came after one with a later stamp
};

/// Which way an LCM log is read: by its stamps, or, for readers that tell a run that was appended
/// from messages out of order, as it is. A bag is always read by its stamps.
enum class LogOrder { kRecorded, kOfFile };

/// Called with each message and its stamp [us]: when it was received, or simulated time. What it
/// throws as RejectedMessage counts as rejected.
using TakeLogged = std::function<void(const Message&, std::int64_t)>;
/// Called with how many bytes of how many have been read, once for so many messages.
using LogProgress = std::function<void(std::uint64_t, std::uint64_t)>;
inline constexpr std::uint64_t kMessagesPerProgress = 256;

inline constexpr std::int64_t kMicrosecond = 1'000;  ///< [ns]

/// Gives `take` every message of these kinds on the channels that begin with `prefix`, in the order
/// of their stamps (time_order.h). In a bag MACHINE_ stands for the topics of the namespace
/// /machine, and sensor_msgs/JointState are measurements, too (bag_decode.h), of any prefix where
/// their topic has no namespace. Throws Refusal for a file that cannot be read.
LoggedMessages readLoggedMessages(const std::string& path, const std::string& prefix,
                                  const Kinds& kinds, const TakeLogged& take,
                                  const LogProgress& advanced,
                                  LogOrder order = LogOrder::kRecorded);

/// "2 of 7 messages lie after a later one: taken in the order of their recorded times"
std::string outOfOrder(const LoggedMessages& log);

/// "found none in 1234 bytes", and what there is instead.
std::string foundElsewhere(const LoggedMessages& log);

}  // namespace whirl_twin
