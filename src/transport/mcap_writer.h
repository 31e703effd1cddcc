// Writes MCAP files of ROS messages for PlotJuggler, Foxglove and Lichtblick (MCAP format
// specification, version 0; registry: profile "ros1", message encoding "ros1", schemas "ros1msg",
// or profile "ros2", "cdr", "ros2msg", for the programs of ROS 2).
//
// A file is magic bytes and records: opcode of 1 byte, length of 8, content; little-endian.
//   header | chunks of schemas, channels and messages, each with an index of its messages by
//   channel | end of data | summary: schemas, channels, statistics, offsets of the chunks |
//   offsets of the groups of the summary | footer
// Chunks are flushed one by one, so that an interrupted run loses about the last second only.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "transport/channels.h"
#include "transport/little_endian.h"
#include "transport/log_export.h"
#include "transport/output_file.h"
#include "transport/recording_writer.h"
#include "transport/ros2_message.h"
#include "transport/ros_encode.h"

namespace whirl_twin {

class McapWriter final : public RecordingWriter {
 public:
  enum class Compression { kNone, kLz4 };
  /// Whether this build supports it.
  static bool has(Compression compression);

  enum class Profile { kRos1, kRos2 };

  explicit McapWriter(const std::string& path, Compression compression = Compression::kNone,
                      Profile profile = Profile::kRos1);

  void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
             std::size_t size) override;
  void finish() override;

  /// Writes the pending messages as a chunk and flushes it.
  void flush();
  /// [bytes], with the pending chunk.
  std::uint64_t size() const { return file_.offset() + chunk_.size(); }

 private:
  struct Channel {
    std::uint16_t id = 0;
    std::uint32_t messages = 0;
    Ros2Message* ros2 = nullptr;  ///< null: as they are
    LittleEndian index;           ///< of the chunk: time and offset of each message
  };
  struct Span {
    std::uint64_t first = 0, last = 0;  ///< [ns]
    bool any = false;
    void add(std::uint64_t time);
  };
  struct Schema {
    std::uint16_t id = 0;
    std::unique_ptr<Ros2Message> ros2;
  };
  Channel& channelOf(const RecordedTopic& topic);
  Schema& schemaOf(const RecordedTopic& topic);
  void writeChunk();
  void writeSummary();

  OutputFile file_;
  Compression compression_;
  Profile profile_;
  std::map<std::string, Schema> schemas_;    ///< by type and MD5 sum
  std::map<std::string, Channel> channels_;  ///< by RecordedTopic::key()
  std::vector<Channel*> in_chunk_;           ///< channels with messages in the chunk
  LittleEndian chunk_;
  Span chunk_span_, span_;
  // Records for the summary.
  LittleEndian schema_records_, channel_records_, chunk_indexes_;
  std::uint32_t chunks_ = 0;
  std::uint64_t messages_ = 0;
};

// Writes the twin's messages to an MCAP file, stamped with their simulated time: the same file as
// the export of an LCM log of them.

class McapLog {
 public:
  /// Creates the file, or empties it. All throw RunFailure if it cannot be written.
  explicit McapLog(const std::string& path)
      : encoder_(namespaceOfPrefix(kDefaultLcmPrefix)), writer_(path) {}

  template <class State>
  void write(const State& state) {
    writeAt(timeOf(state), state);
  }
  /// The same, stamped with another time [s] than the message's.
  template <class State>
  void writeAt(double time, const State& state) {
    const LittleEndian& bytes = encoder_.encode(state);
    writer_.write(encoder_.topic(), 1'000 * utimeOf(time), bytes.data(), bytes.size());
  }

  void finish() { writer_.finish(); }

 private:
  RosEncoder encoder_;
  McapWriter writer_;
};

}  // namespace whirl_twin
