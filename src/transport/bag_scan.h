// Sequential reader of rosbags (format 2.0): messages and corrupt places.
//
// A bag is a sequence of records, little-endian: header length, header fields as length,
// `name=value`, then data length, data. The field `op` is the type: a chunk of records, maybe
// compressed, a connection (topic, type and definition of messages), a message, or part of an
// index. rosbag's own library relies on the index, which an interrupted recording lacks, and does
// not check the lengths it reads. This reader scans the records themselves, uses an index only to
// find connections, needs no ROS, and reports the offset of every defect.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/file_window.h"
#include "transport/recording_writer.h"

namespace whirl_twin {

/// Magic bytes of a bag.
inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";

/// Values of `op`.
enum BagOp : std::uint8_t {
  kBagMessage = 2,
  kBagHeader = 3,
  kBagIndex = 4,
  kBagChunk = 5,
  kBagChunkInfo = 6,
  kBagConnection = 7
};

using BagConnection = RecordedTopic;

struct BagMessage {
  std::int64_t time = 0;  ///< [ns], time of reception
  const BagConnection* connection = nullptr;
  std::size_t size = 0;                ///< [bytes]
  const std::uint8_t* data = nullptr;  ///< the message; null if longer than kMaxPayload
};

class BagScan {
 public:
  /// Longest message that is read [bytes]; the twin's have a few hundred, measurements some 10^5.
  static constexpr std::size_t kMaxPayload = std::size_t{1} << 20;
  /// Longest chunk, decompressed [bytes].
  static constexpr std::size_t kMaxChunk = std::size_t{1} << 28;

  enum class Found { kMessage, kDamage, kEnd };

  /// Whether the file begins like a bag of any version, or its name ends like that of one (.bag,
  /// .bag.active). Throws as FileWindow does.
  static bool isBag(const std::string& path);

  /// Throws as FileWindow does, and InputError for a file that is not a bag of version 2.0, or is
  /// encrypted.
  explicit BagScan(const std::string& path);

  /// Advances to the next message, whose data and connection are valid until the next call, or past
  /// a corrupt place, see damageOffset() and damage().
  Found next(BagMessage& message);

  std::uint64_t size() const { return file_.size(); }
  /// [bytes], up to which the file has been read or skipped.
  std::uint64_t offset() const { return at_; }
  std::uint64_t damageOffset() const { return damage_offset_; }
  const std::string& damage() const { return damage_; }
  const std::map<std::uint32_t, BagConnection>& connections() const { return connections_; }

 private:
  struct Record;
  void readIndex(const std::optional<Record>& header);
  bool nextOfChunk(BagMessage& message);
  bool nextOfFile(BagMessage& message);
  bool take(const Record& record, const std::uint8_t* data, BagMessage& message);
  void openChunk(const Record& record, std::uint64_t data_at);
  std::uint64_t findChunk(std::uint64_t from);

  FileWindow file_;
  std::uint64_t at_ = 0;
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<std::uint8_t> chunk_;  ///< decompressed
  std::size_t chunk_at_ = 0;         ///< [bytes], read position in chunk_
  std::uint64_t chunk_offset_ = 0;   ///< of the chunk's data in the file
  bool chunk_compressed_ = false;    ///< offsets within it are not offsets in the file
  std::uint64_t damage_offset_ = 0;
  std::string damage_;
};

}  // namespace whirl_twin
