// Writes ROS messages as tables of comma-separated values, a file per topic in one folder: the
// first column is the time of recording [s], then each field by name, an entry of an array as
// name[0].
//
// The largest length of each array must be known before the first row is written: a first pass over
// the messages is TableShapes, the second TableFolder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "transport/output_file.h"
#include "transport/recording_writer.h"
#include "transport/ros_layout.h"

namespace whirl_twin {

/// The columns of a topic.
struct TableShape {
  RosLayout layout;
  std::vector<RosLayout::Name> names;
  std::vector<std::size_t> most;  ///< largest number of entries of each
};

class TableShapes final : public RecordingWriter {
 public:
  void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
             std::size_t size) override;
  void finish() override {}

  /// By RecordedTopic::tableKey().
  const std::map<std::string, TableShape>& shapes() const { return shapes_; }

 private:
  std::map<std::string, TableShape> shapes_;
};

class TableFolder final : public RecordingWriter {
 public:
  /// For the same messages as `shapes`, into an existing folder.
  TableFolder(std::string folder, const std::map<std::string, TableShape>& shapes)
      : folder_(std::move(folder)), shapes_(shapes) {}

  void write(const RecordedTopic& topic, std::int64_t time, const std::uint8_t* data,
             std::size_t size) override;
  void finish() override;

  /// Names of the files, without the folder.
  const std::vector<std::string>& files() const { return files_; }

 private:
  OutputFile& begin(const RecordedTopic& topic, const TableShape& shape);

  std::string folder_;
  const std::map<std::string, TableShape>& shapes_;
  std::map<std::string, std::unique_ptr<OutputFile>> tables_;
  std::vector<std::string> files_;
};

}  // namespace whirl_twin
