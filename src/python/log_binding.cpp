// Recorded logs as arrays: a table for each topic, a row for each message.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "messages/message_check.h"
#include "python/conversions.h"
#include "python/listening.h"
#include "python/scene_object.h"
#include "transport/channels.h"
#include "transport/log_export.h"
#include "transport/ros_layout.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

/// A field of all messages: their entries one after the other, and how many each has.
struct Column {
  std::string name;
  bool is_array = false;
  std::vector<double> real;
  std::vector<std::int64_t> whole;
  std::vector<std::string> text;
  std::vector<std::size_t> counts;
};

struct Table {
  explicit Table(const std::string& definition) : layout(definition) {
    for (const RosLayout::Name& name : layout.names()) {
      columns.push_back({name.name, name.is_array, {}, {}, {}, {}});
    }
  }

  RosLayout layout;
  std::vector<double> recorded;  // s
  std::vector<Column> columns;
};

class TopicTables final : public RecordingWriter {
 public:
  void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
             std::size_t size) override {
    auto place = tables_.find(topic.topic);
    if (place == tables_.end()) {
      place = tables_.try_emplace(topic.topic, topic.definition).first;
    }
    Table& table = place->second;
    const RosValues values = table.layout.read(data, size);
    table.recorded.push_back(1.0e-9 * static_cast<double>(time));
    for (Column& column : table.columns) {
      const auto found = values.find(column.name);
      static const RosValue kNone;
      const RosValue& value = found == values.end() ? kNone : found->second;
      column.real.insert(column.real.end(), value.real.begin(), value.real.end());
      column.whole.insert(column.whole.end(), value.whole.begin(), value.whole.end());
      column.text.insert(column.text.end(), value.text.begin(), value.text.end());
      column.counts.push_back(value.real.size() + value.whole.size() + value.text.size());
    }
  }
  void finish() override {}

  std::map<std::string, Table>& tables() { return tables_; }

 private:
  std::map<std::string, Table> tables_;
};

/// The array owns the values.
template <class Number>
py::array arrayOf(std::vector<Number> values, const std::vector<py::ssize_t>& shape) {
  auto* const kept = new std::vector<Number>(std::move(values));
  const py::capsule owner(
      kept, [](void* memory) { delete static_cast<std::vector<Number>*>(memory); });
  return py::array_t<Number>(shape, kept->data(), owner);
}

/// Rows of one length: missing entries are NaN.
std::vector<double> filled(const Column& column, std::size_t most) {
  std::vector<double> all(column.counts.size() * most, kNaN);
  std::size_t at = 0;
  for (std::size_t row = 0; row < column.counts.size(); ++row) {
    for (std::size_t k = 0; k < column.counts[row]; ++k, ++at) {
      all[row * most + k] =
          column.real.empty() ? static_cast<double>(column.whole[at]) : column.real[at];
    }
  }
  return all;
}

py::object pythonOf(Column& column) {
  const auto rows = static_cast<py::ssize_t>(column.counts.size());
  if (!column.text.empty()) {
    py::list all;
    std::size_t at = 0;
    for (const std::size_t count : column.counts) {
      py::list row;
      for (std::size_t k = 0; k < count; ++k) {
        row.append(pythonText(column.text[at++]));
      }
      all.append(column.is_array || row.empty() ? py::object(row) : py::object(row[0]));
    }
    return std::move(all);
  }
  if (!column.is_array) {
    return column.real.empty() ? arrayOf(std::move(column.whole), {rows})
                               : arrayOf(std::move(column.real), {rows});
  }
  const std::size_t most =
      column.counts.empty() ? 0 : *std::max_element(column.counts.begin(), column.counts.end());
  const std::vector<py::ssize_t> shape{rows, static_cast<py::ssize_t>(most)};
  const bool even = std::all_of(column.counts.begin(), column.counts.end(),
                                [&](std::size_t count) { return count == most; });
  if (even && column.real.empty() && !column.whole.empty()) {
    return arrayOf(std::move(column.whole), shape);
  }
  return arrayOf(even && !column.real.empty() ? std::move(column.real) : filled(column, most),
                 shape);
}

/// {topic: {column: values}}; the tables are empty afterwards.
py::dict columnsOf(TopicTables& tables) {
  py::dict topics;
  for (auto& [topic, table] : tables.tables()) {
    const auto rows = static_cast<py::ssize_t>(table.recorded.size());
    py::dict columns;
    columns["recorded"] = arrayOf(std::move(table.recorded), {rows});
    for (Column& column : table.columns) {
      columns[pythonText(column.name)] = pythonOf(column);
    }
    topics[pythonText(topic)] = columns;
  }
  tables.tables().clear();
  return topics;
}

/// A message of a file that Python reads. False: it does not match its definition.
bool add(TopicTables& tables, const std::string& topic, const std::string& definition,
         std::int64_t time, const py::bytes& data) {
  const std::string_view bytes = data;
  try {
    tables.write({topic, "", definition, ""}, time,
                 reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    return true;
  } catch (const RejectedMessage&) {
    return false;
  }
}

py::tuple readLog(const std::string& path, const std::string& prefix, const py::object& progress) {
  requireLcmPrefix(prefix);
  TopicTables tables;
  LogExport log;
  runListening(progress, [&](WorkProgress& work) {
    const LogProgress advanced = [&](std::uint64_t bytes, std::uint64_t all) {
      work.begin(path, static_cast<std::int64_t>(all), true);
      work.show(static_cast<std::int64_t>(bytes));
    };
    log = exportLog(path, prefix, [](const std::string&) { return true; }, tables, advanced);
  });
  py::list defects;
  for (const LogDefect& defect : log.defects) {
    defects.append(py::make_tuple(defect.offset, pythonText(defect.what)));
  }
  return py::make_tuple(columnsOf(tables), log.rejected + log.damaged, defects);
}

}  // namespace

void bindLogs(py::module_& module) {
  py::class_<TopicTables>(module, "TopicTables")
      .def(py::init<>())
      .def("add", add, py::arg("topic"), py::arg("definition"), py::arg("time"), py::arg("data"))
      .def("columns", columnsOf);
  module.def("read_log", readLog, py::arg("path"), py::arg("prefix"), py::arg("progress"));
}

}  // namespace whirl_twin
