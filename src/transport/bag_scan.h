// One message of a rosbag after another (format 2.0), and what lies between them.
//
// A bag is one record after another, little-endian: header length, header fields as length,
// `name=value`, then data length, data. The field `op` says what it is: a chunk of records, maybe
// compressed, a connection (topic, type and definition of messages), a message, or parts of an
// index. rosbag's own library goes by the index, which a recording that was broken off has not, and
// believes the lengths it reads; the reader here goes through the records themselves, takes of an
// index only which connections there are, needs no ROS, and says at which byte something is wrong.
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

/// What a bag begins with.
inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";

/// What a record is.
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
  std::int64_t time = 0;  ///< [ns], when it was received
  const BagConnection* connection = nullptr;
  std::size_t size = 0;                ///< [bytes]
  const std::uint8_t* data = nullptr;  ///< the message; null if longer than kMaxPayload
};

class BagScan {
 public:
  /// Longest message looked into [bytes]; the twin's have a few hundred, of measurements some 10^5.
  static constexpr std::size_t kMaxPayload = std::size_t{1} << 20;
  /// Longest chunk, when it is no longer compressed [bytes].
  static constexpr std::size_t kMaxChunk = std::size_t{1} << 28;

  enum class Found { kMessage, kDamage, kEnd };

  /// Whether the file begins as a bag does, of whatever version, or is named as one (.bag,
  /// .bag.active). Throws as FileWindow does.
  static bool isBag(const std::string& path);

  /// Throws as FileWindow does, and Refusal for a file that is no bag of version 2.0, or encrypted.
  explicit BagScan(const std::string& path);

  /// Goes on to the next message, whose data and connection are valid until the next call, or over
  /// a damaged place, of which damageOffset() and damage() tell.
  Found next(BagMessage& message);

  std::uint64_t size() const { return file_.size(); }
  /// [bytes], up to where the file has been understood or skipped.
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
  std::vector<std::uint8_t> chunk_;  ///< no longer compressed
  std::size_t chunk_at_ = 0;         ///< [bytes], of it, up to where it has been read
  std::uint64_t chunk_offset_ = 0;   ///< of its data in the file
  bool chunk_compressed_ = false;    ///< offsets within it are none of the file
  std::uint64_t damage_offset_ = 0;
  std::string damage_;
};

}  // namespace whirl_twin
