// Interface of the writers of ROS messages: bags, MCAP files, tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace whirl_twin {

/// Topic, type and definition of messages.
struct RecordedTopic {
  std::string topic;       ///< "/twin/rotor/whirl"
  std::string type;        ///< "whirl_twin/WhirlState"
  std::string definition;  ///< the .msg file and those that it names
  std::string md5sum;
  std::string callerid{};  ///< node that sent it; "": not known
  bool latching = false;   ///< a later subscriber gets the newest

  /// Equal for topics whose messages can share a connection.
  std::string key() const { return tableKey() + '\n' + callerid; }
  /// Equal for topics whose messages can share a table, whatever the publisher.
  std::string tableKey() const { return topic + '\n' + md5sum; }
};

/// [bytes] Approximate size of a chunk.
inline constexpr std::size_t kChunkSize = std::size_t{768} << 10;

class RecordingWriter {
 public:
  virtual ~RecordingWriter() = default;

  /// Writes a ROS message. time: [ns], 0 to kMaxStamp. Throws RunFailure if it cannot be written,
  /// and RejectedMessage, having written nothing, if it does not match its definition.
  virtual void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
                     std::size_t size) = 0;

  /// Completes and flushes the file. Throws RunFailure.
  virtual void finish() = 0;
};

}  // namespace whirl_twin
