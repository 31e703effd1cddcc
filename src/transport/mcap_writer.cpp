#include "transport/mcap_writer.h"

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <limits>
#include <string_view>

#ifdef WHIRL_TWIN_LZ4
#include <lz4frame.h>
#endif

#include "messages/input_error.h"

namespace whirl_twin {
namespace {

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum McapOp : std::uint8_t {
  kMcapHeader = 0x01,
  kMcapFooter = 0x02,
  kMcapSchema = 0x03,
  kMcapChannel = 0x04,
  kMcapMessage = 0x05,
  kMcapChunk = 0x06,
  kMcapMessageIndex = 0x07,
  kMcapChunkIndex = 0x08,
  kMcapStatistics = 0x0b,
  kMcapSummaryOffset = 0x0e,
  kMcapDataEnd = 0x0f
};

void putMcapHead(McapOp op, std::uint64_t length, LittleEndian& to) {
  to.number(op, 1);
  to.number(length, 8);
}

void putMcapRecord(McapOp op, const LittleEndian& content, LittleEndian& to) {
  putMcapHead(op, content.size(), to);
  to.bytes(content);
}

std::uint32_t crcOf(const LittleEndian& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

/// Throws unless the number fits into a field of the file.
std::uint16_t numbered(std::size_t count) {
  if (count >= std::numeric_limits<std::uint16_t>::max()) {
    throw RunFailure("MCAP files have at most 65,534 channels");
  }
  return static_cast<std::uint16_t>(count + 1);
}

#ifdef WHIRL_TWIN_LZ4
/// An LZ4 frame for the simplest readers, ROS's among them: independent blocks, with a checksum.
std::vector<std::uint8_t> lz4(const LittleEndian& bytes) {
  LZ4F_preferences_t plain{};
  plain.frameInfo.blockSizeID = LZ4F_max4MB;
  plain.frameInfo.blockMode = LZ4F_blockIndependent;
  plain.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::vector<std::uint8_t> packed(LZ4F_compressFrameBound(bytes.size(), &plain));
  const std::size_t size =
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), &plain);
  if (LZ4F_isError(size) != 0) {
    throw RunFailure(fmt::format("lz4: {}", LZ4F_getErrorName(size)));
  }
  packed.resize(size);
  return packed;
}
#endif

}  // namespace

bool McapWriter::has([[maybe_unused]] Compression compression) {
#ifdef WHIRL_TWIN_LZ4
  return true;
#else
  return compression == Compression::kNone;
#endif
}

void McapWriter::Span::add(std::uint64_t time) {
  first = any ? std::min(first, time) : time;
  last = any ? std::max(last, time) : time;
  any = true;
}

McapWriter::McapWriter(const std::string& path, Compression compression, Profile profile)
    : file_(path), compression_(compression), profile_(profile) {
  LittleEndian header, begin;
  header.text(profile == Profile::kRos2 ? "ros2" : "ros1");
  header.text("whirl_twin");
  begin.bytes(kMcapMagic);
  putMcapRecord(kMcapHeader, header, begin);
  file_.write(begin);
}

McapWriter::Schema& McapWriter::schemaOf(const RecordedTopic& topic) {
  const std::string key = topic.type + '\n' + topic.md5sum;
  const auto found = schemas_.find(key);
  if (found != schemas_.end()) {
    return found->second;
  }
  Schema schema;
  if (profile_ == Profile::kRos2) {
    schema.ros2 = std::make_unique<Ros2Message>(topic.definition);
  }
  schema.id = numbered(schemas_.size());
  LittleEndian content;
  content.number(schema.id, 2);
  content.text(schema.ros2 ? ros2TypeName(topic.type) : topic.type);
  content.text(schema.ros2 ? "ros2msg" : "ros1msg");
  content.text(schema.ros2 ? schema.ros2->definition() : topic.definition);
  putMcapRecord(kMcapSchema, content, chunk_);
  putMcapRecord(kMcapSchema, content, schema_records_);
  return schemas_.emplace(key, std::move(schema)).first->second;
}

McapWriter::Channel& McapWriter::channelOf(const RecordedTopic& topic) {
  const auto found = channels_.find(topic.key());
  if (found != channels_.end()) {
    return found->second;
  }
  Schema& schema = schemaOf(topic);
  Channel channel;
  channel.ros2 = schema.ros2.get();
  channel.id = numbered(channels_.size());
  LittleEndian metadata, content;
  const auto put = [&](std::string_view name, std::string_view value) {
    metadata.text(name);
    metadata.text(value);
  };
  if (channel.ros2) {
    put("offered_qos_profiles", "");
  } else {
    put("md5sum", topic.md5sum);
  }
  if (!topic.callerid.empty()) {
    put("callerid", topic.callerid);
  }
  if (topic.latching) {
    put("latching", "true");
  }
  content.number(channel.id, 2);
  content.number(schema.id, 2);
  content.text(topic.topic);
  content.text(channel.ros2 ? "cdr" : "ros1");
  content.block(metadata);
  putMcapRecord(kMcapChannel, content, chunk_);
  putMcapRecord(kMcapChannel, content, channel_records_);
  return channels_.emplace(topic.key(), std::move(channel)).first->second;
}

void McapWriter::write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
                       std::size_t size) {
  Channel& channel = channelOf(topic);
  if (channel.ros2) {
    const LittleEndian& converted = channel.ros2->convert(data, size);
    data = converted.data();
    size = converted.size();
  }
  const auto instant = static_cast<std::uint64_t>(time);
  if (channel.index.empty()) {
    in_chunk_.push_back(&channel);
  }
  channel.index.number(instant, 8);
  channel.index.number(chunk_.size(), 8);
  putMcapHead(kMcapMessage, 2 + 4 + 8 + 8 + size, chunk_);
  chunk_.number(channel.id, 2);
  chunk_.number(channel.messages++, 4);
  chunk_.number(instant, 8);  // time of recording
  chunk_.number(instant, 8);  // time of publication: not known
  chunk_.bytes(data, size);
  chunk_span_.add(instant);
  span_.add(instant);
  ++messages_;
  if (chunk_.size() >= kChunkSize) {
    flush();
  }
}

void McapWriter::flush() {
  if (!in_chunk_.empty()) {
    writeChunk();
  }
  file_.flush();
}

void McapWriter::writeChunk() {
  const std::uint8_t* records = chunk_.data();
  std::uint64_t size = chunk_.size();
  std::string_view name;
#ifdef WHIRL_TWIN_LZ4
  std::vector<std::uint8_t> packed;
  if (compression_ == Compression::kLz4) {
    packed = lz4(chunk_);
    records = packed.data();
    size = packed.size();
    name = "lz4";
  }
#endif
  LittleEndian head;
  head.number(chunk_span_.first, 8);
  head.number(chunk_span_.last, 8);
  head.number(chunk_.size(), 8);
  head.number(crcOf(chunk_), 4);
  head.text(name);
  head.number(size, 8);
  const std::uint64_t begin = file_.offset();
  LittleEndian record;
  putMcapHead(kMcapChunk, head.size() + size, record);
  record.bytes(head);
  file_.write(record);
  file_.write(records, size);

  const std::uint64_t end = file_.offset();
  LittleEndian indexes, offsets;
  for (Channel* channel : in_chunk_) {
    offsets.number(channel->id, 2);
    offsets.number(end + indexes.size(), 8);
    LittleEndian index;
    index.number(channel->id, 2);
    index.block(channel->index);
    putMcapRecord(kMcapMessageIndex, index, indexes);
    channel->index.clear();
  }
  file_.write(indexes);

  LittleEndian where;
  where.number(chunk_span_.first, 8);
  where.number(chunk_span_.last, 8);
  where.number(begin, 8);
  where.number(end - begin, 8);
  where.block(offsets);
  where.number(indexes.size(), 8);
  where.text(name);
  where.number(size, 8);
  where.number(chunk_.size(), 8);
  putMcapRecord(kMcapChunkIndex, where, chunk_indexes_);
  ++chunks_;
  chunk_.clear();
  chunk_span_ = {};
  in_chunk_.clear();
}

void McapWriter::finish() {
  flush();
  writeSummary();
  file_.flush();
}

void McapWriter::writeSummary() {
  LittleEndian data_end, none;
  none.number(0, 4);  // no checksum of all the data: each chunk has one
  putMcapRecord(kMcapDataEnd, none, data_end);
  file_.write(data_end);

  LittleEndian content, counts, statistics;
  content.number(messages_, 8);
  content.number(schemas_.size(), 2);
  content.number(channels_.size(), 4);
  content.number(0, 4);  // attachments
  content.number(0, 4);  // metadata
  content.number(chunks_, 4);
  content.number(span_.first, 8);
  content.number(span_.last, 8);
  for (const auto& [key, channel] : channels_) {
    counts.number(channel.id, 2);
    counts.number(channel.messages, 8);
  }
  content.block(counts);
  putMcapRecord(kMcapStatistics, content, statistics);

  const std::uint64_t begin = file_.offset();
  LittleEndian summary, offsets;
  const std::array<std::pair<McapOp, const LittleEndian*>, 4> groups = {
      {{kMcapSchema, &schema_records_},
       {kMcapChannel, &channel_records_},
       {kMcapStatistics, &statistics},
       {kMcapChunkIndex, &chunk_indexes_}}};
  for (const auto& [op, records] : groups) {
    if (!records->empty()) {
      LittleEndian offset;
      offset.number(op, 1);
      offset.number(begin + summary.size(), 8);
      offset.number(records->size(), 8);
      putMcapRecord(kMcapSummaryOffset, offset, offsets);
      summary.bytes(*records);
    }
  }
  const std::uint64_t offsets_begin = begin + summary.size();
  summary.bytes(offsets);
  putMcapHead(kMcapFooter, 8 + 8 + 4, summary);
  summary.number(begin, 8);
  summary.number(offsets_begin, 8);
  const std::uint32_t crc = crcOf(summary);
  summary.number(crc, 4);
  summary.bytes(kMcapMagic);
  file_.write(summary);
}

}  // namespace whirl_twin
