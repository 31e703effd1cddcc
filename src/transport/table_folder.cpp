#include "transport/table_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "messages/csv_cell.h"
#include "messages/message_check.h"

namespace whirl_twin {
namespace {

std::size_t entriesOf(const RosValue& value) {
  return value.whole.size() + value.real.size() + value.text.size();
}

/// The shortest text that reads back as the same number.
std::string cellOf(const RosValue& value, std::size_t i) {
  if (i < value.real.size()) {
    return fmt::format("{}", value.real[i]);
  }
  if (i < value.whole.size()) {
    return fmt::format("{}", value.whole[i]);
  }
  return i < value.text.size() ? csvCell(value.text[i]) : "";
}

/// "/twin/rotor/whirl" -> "twin.rotor.whirl": no topic leaves the folder.
std::string fileNameOf(const std::string& topic) {
  std::string name = topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    c = plain ? c : c == '/' ? '.' : '_';
  }
  constexpr std::size_t kLongest = 200;  // file systems allow 255
  return name.empty() ? "_" : name.substr(0, kLongest);
}

}  // namespace

void TableShapes::write(const RecordedTopic& topic, std::int64_t, const std::uint8_t* data,
                        std::size_t size) {
  auto place = shapes_.find(topic.tableKey());
  if (place == shapes_.end()) {
    TableShape shape{RosLayout(topic.definition), {}, {}};
    shape.names = shape.layout.names();
    shape.most.assign(shape.names.size(), 0);
    place = shapes_.emplace(topic.tableKey(), std::move(shape)).first;
  }
  TableShape& shape = place->second;
  const RosValues values = shape.layout.read(data, size);
  for (std::size_t i = 0; i < shape.names.size(); ++i) {
    const auto value = values.find(shape.names[i].name);
    if (value != values.end()) {
      shape.most[i] = std::max(shape.most[i], entriesOf(value->second));
    }
  }
}

OutputFile& TableFolder::begin(const RecordedTopic& topic, const TableShape& shape) {
  const std::string name = fileNameOf(topic.topic);
  std::string file = name + ".csv";
  for (int i = 2; std::find(files_.begin(), files_.end(), file) != files_.end(); ++i) {
    file = fmt::format("{}-{}.csv", name, i);
  }
  auto& table = tables_[topic.tableKey()];
  table = std::make_unique<OutputFile>(folder_ + "/" + file);
  files_.push_back(file);
  std::string head = "recorded";
  for (std::size_t i = 0; i < shape.names.size(); ++i) {
    if (!shape.names[i].is_array) {
      head += ',' + csvCell(shape.names[i].name);
      continue;
    }
    for (std::size_t k = 0; k < shape.most[i]; ++k) {
      head += ',' + csvCell(fmt::format("{}[{}]", shape.names[i].name, k));
    }
  }
  table->write(head + '\n');
  return *table;
}

void TableFolder::write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
                        std::size_t size) {
  constexpr std::int64_t kSecond = 1'000'000'000;  // ns
  const auto known = shapes_.find(topic.tableKey());
  if (known == shapes_.end()) {
    throw RejectedMessage("a message definition that cannot be read");
  }
  const TableShape& shape = known->second;
  const RosValues values = shape.layout.read(data, size);
  const auto table = tables_.find(topic.tableKey());
  OutputFile& to = table == tables_.end() ? begin(topic, shape) : *table->second;
  std::string row = fmt::format("{}.{:09}", time / kSecond, time % kSecond);
  for (std::size_t i = 0; i < shape.names.size(); ++i) {
    static const RosValue kNone;
    const auto found = values.find(shape.names[i].name);
    const RosValue& value = found == values.end() ? kNone : found->second;
    const std::size_t cells = shape.names[i].is_array ? shape.most[i] : 1;
    for (std::size_t k = 0; k < cells; ++k) {
      row += ',' + cellOf(value, k);
    }
  }
  to.write(row + '\n');
}

void TableFolder::finish() {
  for (auto& table : tables_) {
    table.second->flush();
  }
}

}  // namespace whirl_twin
