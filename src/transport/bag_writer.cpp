#include "transport/bag_writer.h"

#include <algorithm>
#include <string_view>

#include "transport/bag_scan.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kBagHeaderSize = 4096;  // bytes of the bag header record

/// Serializes the fields of a header, or of the data of a connection.
class BagFields {
 public:
  BagFields() = default;
  explicit BagFields(BagOp op) { number("op", static_cast<std::uint8_t>(op), 1); }

  void number(std::string_view name, std::uint64_t value, int width) {
    begin(name, static_cast<std::size_t>(width));
    bytes_.number(value, width);
  }
  void time(std::string_view name, std::int64_t time) {
    begin(name, 8);
    putTime(time, bytes_);
  }
  void text(std::string_view name, std::string_view value) {
    begin(name, value.size());
    bytes_.bytes(value);
  }
  const LittleEndian& bytes() const { return bytes_; }

  static void putTime(std::int64_t time, LittleEndian& to) {
    constexpr std::int64_t kSecond = 1'000'000'000;  // ns
    to.number(static_cast<std::uint64_t>(time / kSecond), 4);
    to.number(static_cast<std::uint64_t>(time % kSecond), 4);
  }

 private:
  void begin(std::string_view name, std::size_t size) {
    bytes_.number(name.size() + 1 + size, 4);
    bytes_.bytes(name);
    bytes_.bytes("=");
  }

  LittleEndian bytes_;
};

void putBagRecord(const BagFields& header, const LittleEndian& data, LittleEndian& to) {
  to.block(header.bytes());
  to.block(data);
}

/// The bag header record, padded with blanks so that it can be overwritten at the end.
LittleEndian bagHeader(std::uint64_t index, std::size_t connections, std::uint32_t chunks) {
  BagFields fields(kBagHeader);
  fields.number("index_pos", index, 8);
  fields.number("conn_count", connections, 4);
  fields.number("chunk_count", chunks, 4);
  LittleEndian blanks, record;
  blanks.bytes(std::string(kBagHeaderSize - fields.bytes().size(), ' '));
  putBagRecord(fields, blanks, record);
  return record;
}

}  // namespace

BagWriter::BagWriter(const std::string& path) : file_(path) {
  file_.write(kBagMagic);
  file_.write(bagHeader(0, 0, 0));
}

BagWriter::Connection& BagWriter::connectionOf(const RecordedTopic& topic) {
  const auto [place, is_new] = connections_.try_emplace(topic.key());
  if (is_new) {
    place->second.id = static_cast<std::uint32_t>(connections_.size() - 1);
    BagFields header(kBagConnection), of_connection;
    header.number("conn", place->second.id, 4);
    header.text("topic", topic.topic);
    of_connection.text("topic", topic.topic);
    of_connection.text("type", topic.type);
    of_connection.text("md5sum", topic.md5sum);
    of_connection.text("message_definition", topic.definition);
    if (!topic.callerid.empty()) {
      of_connection.text("callerid", topic.callerid);
    }
    if (topic.latching) {
      of_connection.text("latching", "1");
    }
    putBagRecord(header, of_connection.bytes(), chunk_);
    putBagRecord(header, of_connection.bytes(), connection_records_);
  }
  return place->second;
}

void BagWriter::write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
                      std::size_t size) {
  Connection& connection = connectionOf(topic);
  if (connection.index.empty()) {
    in_chunk_.push_back(&connection);
  }
  connection.index.emplace_back(time, static_cast<std::uint32_t>(chunk_.size()));
  BagFields header(kBagMessage);
  header.number("conn", connection.id, 4);
  header.time("time", time);
  chunk_.block(header.bytes());
  chunk_.number(size, 4);
  chunk_.bytes(data, size);
  if (chunk_.size() >= kChunkSize) {
    writeChunk();
  }
}

void BagWriter::writeChunk() {
  const std::uint64_t begin = file_.offset();
  BagFields header(kBagChunk);
  header.text("compression", "none");
  header.number("size", chunk_.size(), 4);
  LittleEndian head, indexes, counts;
  head.block(header.bytes());
  head.number(chunk_.size(), 4);
  file_.write(head);
  file_.write(chunk_);
  std::int64_t first = in_chunk_.front()->index.front().first, last = first;
  for (Connection* connection : in_chunk_) {
    auto& index = connection->index;
    std::sort(index.begin(), index.end());
    first = std::min(first, index.front().first);
    last = std::max(last, index.back().first);
    BagFields of_index(kBagIndex);
    of_index.number("ver", 1, 4);
    of_index.number("conn", connection->id, 4);
    of_index.number("count", index.size(), 4);
    LittleEndian data;
    for (const auto& [time, offset] : index) {
      BagFields::putTime(time, data);
      data.number(offset, 4);
    }
    putBagRecord(of_index, data, indexes);
    counts.number(connection->id, 4);
    counts.number(index.size(), 4);
    index.clear();
  }
  file_.write(indexes);
  BagFields info(kBagChunkInfo);
  info.number("ver", 1, 4);
  info.number("chunk_pos", begin, 8);
  info.time("start_time", first);
  info.time("end_time", last);
  info.number("count", in_chunk_.size(), 4);
  putBagRecord(info, counts, chunk_records_);
  ++chunks_;
  chunk_.clear();
  in_chunk_.clear();
}

void BagWriter::finish() {
  if (!chunk_.empty()) {
    writeChunk();
  }
  const std::uint64_t index = file_.offset();
  file_.write(connection_records_);
  file_.write(chunk_records_);
  file_.rewrite(kBagMagic.size(), bagHeader(index, connections_.size(), chunks_));
  file_.flush();
}

}  // namespace whirl_twin
