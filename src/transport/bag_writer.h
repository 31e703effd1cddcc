// Writes rosbags (format 2.0, see bag_scan.h) without ROS: uncompressed chunks, each with an index
// by connection and time, and an index of the file at its end.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "transport/little_endian.h"
#include "transport/output_file.h"
#include "transport/recording_writer.h"

namespace whirl_twin {

class BagWriter final : public RecordingWriter {
 public:
  explicit BagWriter(const std::string& path);

  void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
             std::size_t size) override;
  void finish() override;

 private:
  struct Connection {
    std::uint32_t id = 0;
    /// Of each message in the chunk: time [ns] and offset [bytes].
    std::vector<std::pair<std::int64_t, std::uint32_t>> index;
  };
  Connection& connectionOf(const RecordedTopic& topic);
  void writeChunk();

  OutputFile file_;
  std::map<std::string, Connection> connections_;  ///< by RecordedTopic::key()
  std::vector<Connection*> in_chunk_;              ///< connections with messages in the chunk
  LittleEndian chunk_;
  // Records of the index at the end of the file.
  LittleEndian connection_records_, chunk_records_;
  std::uint32_t chunks_ = 0;
};

}  // namespace whirl_twin
