#include "transport/bag_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "messages/input_error.h"
#include "transport/unpack.h"

namespace whirl_twin {
namespace {

constexpr std::string_view kAnyBag = "#ROSBAG V";
constexpr std::uint64_t kMaxHeader = 1 << 16;        // bytes; topics and names of types
constexpr std::uint64_t kPieceLength = 1 << 20;      // bytes read at a time
constexpr std::uint64_t kBagSearchLength = 1 << 16;  // bytes searched at a time
constexpr std::uint64_t kFarBack = 64;  // bytes from the begin of a chunk to its field op, at most
constexpr std::string_view kChunkField{"\4\0\0\0op=\5", 8};

std::uint32_t littleEndian32(const void* bytes) {
  const auto* b = static_cast<const std::uint8_t*>(bytes);
  return b[0] | static_cast<std::uint32_t>(b[1]) << 8 | static_cast<std::uint32_t>(b[2]) << 16 |
         static_cast<std::uint32_t>(b[3]) << 24;
}

using FoundFields = std::map<std::string, std::string, std::less<>>;

/// Header fields; none if the bytes end within a field.
std::optional<FoundFields> fieldsOf(const std::uint8_t* bytes, std::size_t size) {
  FoundFields fields;
  while (size > 0) {
    if (size < 4) {
      return std::nullopt;
    }
    const std::uint32_t length = littleEndian32(bytes);
    if (length > size - 4) {
      return std::nullopt;
    }
    const std::string_view field(reinterpret_cast<const char*>(bytes + 4), length);
    const std::size_t equal = field.find('=');
    if (equal == std::string_view::npos) {
      return std::nullopt;
    }
    fields.emplace(field.substr(0, equal), field.substr(equal + 1));
    bytes += 4 + length;
    size -= 4 + length;
  }
  return fields;
}

std::optional<std::uint32_t> number(const FoundFields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found != fields.end() && found->second.size() == 4
             ? std::optional(littleEndian32(found->second.data()))
             : std::nullopt;
}

std::string fieldText(const FoundFields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "" : found->second;
}

/// Position and description of a defect; caught by next().
struct Damage {
  std::uint64_t offset;
  std::string what;
};

}  // namespace

/// Header of a record, and the length of its data.
struct BagScan::Record {
  FoundFields fields;
  int op = 0;
  std::uint64_t header = 0;  ///< [bytes], with both lengths
  std::uint64_t size = 0;    ///< [bytes], length of the data by the record

  /// Reads the record at `bytes`, of which `left` are available; on failure none, with the reason
  /// in `why`.
  static std::optional<Record> read(const std::uint8_t* bytes, std::uint64_t left,
                                    std::string& why) {
    Record record;
    if (left < 8) {
      why = fmt::format("a truncated record of {} bytes", left);
      return std::nullopt;
    }
    const std::uint32_t length = littleEndian32(bytes);
    if (length > std::min(kMaxHeader, left - 8)) {
      why = fmt::format("the header of a record: expected at most {} bytes, found {}",
                        std::min(kMaxHeader, left - 8), length);
      return std::nullopt;
    }
    auto fields = fieldsOf(bytes + 4, length);
    const std::string op = fields ? fieldText(*fields, "op") : "";
    if (op.size() != 1) {
      why = "expected the header of a record";
      return std::nullopt;
    }
    record.fields = std::move(*fields);
    record.op = static_cast<unsigned char>(op.front());
    record.header = 8 + std::uint64_t{length};
    record.size = littleEndian32(bytes + 4 + length);
    return record;
  }
};

bool BagScan::isBag(const std::string& path) {
  const auto named = [&](std::string_view end) {
    return path.size() >= end.size() &&
           path.compare(path.size() - end.size(), end.size(), end) == 0;
  };
  FileWindow file(path);
  return named(".bag") || named(".bag.active") ||
         (file.size() >= kAnyBag.size() &&
          std::equal(kAnyBag.begin(), kAnyBag.end(), file.at(0, kAnyBag.size())));
}

BagScan::BagScan(const std::string& path) : file_(path) {
  if (file_.size() < kBagMagic.size() ||
      !std::equal(kBagMagic.begin(), kBagMagic.end(), file_.at(0, kBagMagic.size()))) {
    throw InputError(
        fmt::format("{}: must be a rosbag of version 2.0 ('#ROSBAG V2.0' and a new line), found "
                    "another header in {} bytes",
                    path, file_.size()));
  }
  at_ = kBagMagic.size();
  std::string why;
  const std::uint64_t left = file_.size() - at_;
  const auto first = Record::read(file_.at(at_, std::min(left, kMaxHeader + 8)),
                                  std::min(left, kMaxHeader + 8), why);
  if (first && first->op == kBagHeader && !fieldText(first->fields, "encryptor").empty()) {
    throw InputError(fmt::format("{}: must not be encrypted, found a bag encrypted by {}", path,
                                 fieldText(first->fields, "encryptor")));
  }
  readIndex(first);
}

/// The index at the end of the file repeats every connection: without it, the loss of the chunk
/// with the first occurrence of a connection would lose all its messages.
void BagScan::readIndex(const std::optional<Record>& header) {
  const std::string place = header ? fieldText(header->fields, "index_pos") : "";
  const std::uint64_t begin = at_;
  std::uint64_t index = 0;
  if (place.size() == 8) {
    index = littleEndian32(place.data()) | std::uint64_t{littleEndian32(place.data() + 4)} << 32;
  }
  if (index > begin && index < file_.size()) {
    BagMessage none;
    try {
      for (at_ = index; at_ < file_.size() && chunk_.empty();) {
        nextOfFile(none);
      }
    } catch (const Damage&) {
      // The index is corrupt from here on.
    }
  }
  chunk_.clear();
  at_ = begin;
}

BagScan::Found BagScan::next(BagMessage& message) {
  try {
    while (chunk_at_ < chunk_.size() || at_ < file_.size()) {
      if (chunk_at_ < chunk_.size() ? nextOfChunk(message) : nextOfFile(message)) {
        return Found::kMessage;
      }
    }
    return Found::kEnd;
  } catch (const Damage& damage) {
    damage_offset_ = damage.offset;
    damage_ = damage.what;
    return Found::kDamage;
  }
}

/// Reads the next record of the chunk; true if it is a message. A corrupt record skips the rest of
/// the chunk.
bool BagScan::nextOfChunk(BagMessage& message) {
  const std::size_t begin = chunk_at_;
  const std::uint64_t left = chunk_.size() - begin;
  const auto fail = [&](const std::string& what) {
    chunk_at_ = chunk_.size();
    throw Damage{
        chunk_offset_ + (chunk_compressed_ ? 0 : begin),
        chunk_compressed_ ? fmt::format("{}, {} bytes into its chunk", what, begin) : what};
  };
  std::string why;
  const auto record = Record::read(chunk_.data() + begin, left, why);
  if (!record) {
    fail(why);
  }
  if (record->size > left - record->header) {
    fail(fmt::format("a record of {} bytes, but the chunk ends after {}",
                     record->header + record->size, left));
  }
  chunk_at_ += record->header + record->size;
  return take(*record, chunk_.data() + begin + record->header, message);
}

/// Reads the next record of the file; true if it is a message. Messages outside chunks are those of
/// a chunk whose recording was interrupted. A corrupt record skips to the next chunk.
bool BagScan::nextOfFile(BagMessage& message) {
  const std::uint64_t begin = at_;
  const std::uint64_t left = file_.size() - begin;
  const std::uint64_t seen = std::min(left, kMaxHeader + 8);
  std::string why;
  const auto record = Record::read(file_.at(begin, seen), left, why);
  if (!record) {
    at_ = findChunk(begin + 1);
    throw Damage{begin, why};
  }
  const std::uint64_t data_at = begin + record->header;
  if (record->op == kBagChunk) {
    openChunk(*record, data_at);
    return false;
  }
  if (record->size > file_.size() - data_at) {
    at_ = findChunk(begin + 1);
    throw Damage{begin, fmt::format("a record of {} bytes, but the file ends after {}",
                                    record->header + record->size, left)};
  }
  at_ = data_at + record->size;
  if (record->op != kBagMessage && record->op != kBagConnection) {
    return false;  // the index
  }
  const bool readable = record->size <= kMaxPayload;
  return take(*record, readable ? file_.at(data_at, record->size) : nullptr, message);
}

/// Stores a connection; passes on a message of a known one.
bool BagScan::take(const Record& record, const std::uint8_t* data, BagMessage& message) {
  const auto id = number(record.fields, "conn");
  if (record.op == kBagConnection && id && data != nullptr && record.size <= kMaxPayload) {
    if (const auto fields = fieldsOf(data, record.size)) {
      // A repeated connection does not replace the first, to which messages refer.
      connections_.try_emplace(
          *id,
          BagConnection{fieldText(record.fields, "topic"), fieldText(*fields, "type"),
                        fieldText(*fields, "message_definition"), fieldText(*fields, "md5sum"),
                        fieldText(*fields, "callerid"), fieldText(*fields, "latching") == "1"});
    }
    return false;
  }
  if (record.op != kBagMessage) {
    return false;
  }
  const std::string time = fieldText(record.fields, "time");
  const auto connection = id ? connections_.find(*id) : connections_.end();
  if (connection == connections_.end() || time.size() != 8) {
    throw Damage{chunk_at_ > 0 ? chunk_offset_ : at_ - record.size - record.header,
                 "a message of an unknown connection"};
  }
  message.time =
      littleEndian32(time.data()) * std::int64_t{1'000'000'000} + littleEndian32(time.data() + 4);
  message.connection = &connection->second;
  message.size = record.size;
  message.data = record.size <= kMaxPayload ? data : nullptr;
  return true;
}

/// Reads and decompresses a chunk, including an incomplete one.
void BagScan::openChunk(const Record& record, std::uint64_t data_at) {
  const std::uint64_t begin = at_;
  const std::string compression = fieldText(record.fields, "compression");
  const std::uint64_t expected = number(record.fields, "size").value_or(0);
  const std::uint64_t left = file_.size() - data_at;
  chunk_.clear();
  chunk_at_ = 0;
  chunk_offset_ = data_at;
  chunk_compressed_ = compression != "none";
  if (record.size == 0 && expected == 0 && !chunk_compressed_) {
    at_ = data_at;  // interrupted before its size was written: its records follow
    return;
  }
  // A compressed chunk that was interrupted has the size 0.
  const std::uint64_t size = std::min(record.size == 0 ? left : record.size, left);
  at_ = data_at + size;
  if (size > kMaxChunk) {
    throw Damage{begin,
                 fmt::format("a chunk: expected at most {} bytes, found {}", kMaxChunk, size)};
  }
  std::vector<std::uint8_t> packed;
  packed.reserve(size);
  while (packed.size() < size) {
    const std::uint64_t piece = std::min(kPieceLength, size - packed.size());
    const std::uint8_t* bytes = file_.at(data_at + packed.size(), piece);
    packed.insert(packed.end(), bytes, bytes + piece);
  }
  std::string why = unpack(compression, packed, kMaxChunk, chunk_);
  if (why.empty() && record.size > left) {
    why = fmt::format("has {} bytes, but the file ends after {}", record.size, left);
  } else if (why.empty() && record.size > 0 && chunk_.size() != expected) {
    why = fmt::format("expected {} bytes of records, found {}", expected, chunk_.size());
  }
  if (!why.empty()) {
    throw Damage{begin, "a chunk: " + why};  // its decompressed part is read next
  }
}

/// Offset of the next chunk, or the end of the file.
std::uint64_t BagScan::findChunk(std::uint64_t from) {
  while (from + kChunkField.size() <= file_.size()) {
    const std::uint64_t length = std::min(kBagSearchLength, file_.size() - from);
    const std::uint8_t* bytes = file_.at(from, length);
    const std::uint8_t* found =
        std::search(bytes, bytes + length, kChunkField.begin(), kChunkField.end());
    if (found != bytes + length) {
      const std::uint64_t field = from + static_cast<std::uint64_t>(found - bytes);
      const std::uint64_t first = std::max(from, field - std::min(field, kFarBack));
      for (std::uint64_t begin = first; begin < field; ++begin) {
        const std::uint64_t seen = std::min(file_.size() - begin, kFarBack + kBagSearchLength);
        std::string why;
        const auto record = Record::read(file_.at(begin, seen), seen, why);
        if (record && record->op == kBagChunk && record->fields.count("compression") > 0) {
          return begin;
        }
      }
      from = field + 1;
    } else {
      from += length - (kChunkField.size() - 1);  // the field may cross the boundary
    }
  }
  return file_.size();
}

}  // namespace whirl_twin
