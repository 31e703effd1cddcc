// A file of ROS messages, whatever its format: what a bag, an MCAP file and tables have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace whirl_twin {

/// Where messages come from, and how they lie in bytes.
struct RecordedTopic {
  std::string topic;       ///< "/twin/rotor/whirl"
  std::string type;        ///< "whirl_twin/WhirlState"
  std::string definition;  ///< the .msg file and those that it names
  std::string md5sum;
  std::string callerid{};  ///< of the node that sent it; "": not known
  bool latching = false;   ///< who comes later gets the newest

  /// Topics whose messages can be in one connection.
  std::string key() const { return tableKey() + '\n' + callerid; }
  /// Those whose messages can be in one table, whoever published them.
  std::string tableKey() const { return topic + '\n' + md5sum; }
};

/// [bytes] of records that are written as one chunk, about.
inline constexpr std::size_t kChunkSize = std::size_t{768} << 10;

class RecordingWriter {
 public:
  virtual ~RecordingWriter() = default;

  /// A ROS message. time: [ns], 0 to kMaxStamp. Throws RunFailure if it cannot be written, and
  /// RejectedMessage, having written nothing, if it is no message of this definition.
  virtual void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
                     std::size_t size) = 0;

  /// Completes the file, and hands it to the file system. Throws RunFailure.
  virtual void finish() = 0;
};

}  // namespace whirl_twin
