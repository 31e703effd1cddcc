// ROS messages as tables of comma-separated values, a file a topic in one folder: its first column
// is the time of recording [s], then every field by its name, an entry of an array as name[0].
//
// How many entries arrays have at most has to be known before the first row is written, so that the
// messages are gone through twice: TableShapes, then TableFolder.
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

/// What the rows of a topic look like.
struct TableShape {
  RosLayout layout;
  std::vector<RosLayout::Name> names;
  std::vector<std::size_t> most;  ///< entries, of each
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
  /// Of the same messages that `shapes` was made of, into a folder that exists.
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
