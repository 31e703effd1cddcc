// Folder of a study's results, from which an interrupted study resumes.
//
//   manifest.yaml        the study's hash, its size, and its origin
//   study.yaml, scene.yaml  copies
//   blocks/000000012.csv  a finished block with a checksum at its end; written atomically
//   results.csv          all points that did not fail, in order: point, numbers, measures
//   failed.csv           failed points: point, reason, numbers
//   results.h5           all of it in one file (studies/hdf5_results.h), if built with HDF5
//
// The last three are written when all blocks are finished. They are independent of time, place and
// workers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/point_evaluator.h"
#include "studies/study.h"

namespace whirl_twin {

/// Origin of the results: all that their last bits may depend on.
struct Origin {
  std::string version;
  std::string compiler;
  std::string processor;  ///< type, and instructions that change rounding
};
Origin presentOrigin();

/// All points by measure, in order of the points; NaN where one failed.
struct StudyTable {
  std::vector<std::vector<double>> measures;
  std::vector<bool> failed;
  std::uint64_t failures = 0;
};

/// A point read from a finished block.
struct PointResult {
  std::uint64_t point = 0;
  std::vector<double> values;  ///< of the varied numbers
  Outcome outcome;
};

class ResultFolder {
 public:
  /// Opens or creates it. Throws InputError if it has the results of another study, or, unless
  /// `mixed`, of another version, compiler or processor; RunFailure if it cannot be read or
  /// written.
  ResultFolder(const std::string& path, const Study& study, bool mixed);

  const std::string& path() const { return path_; }
  /// As selected when the folder was created.
  const StepsChosen& steps() const { return steps_; }
  /// Blocks in the folder with a valid checksum.
  std::vector<bool> finished() const;
  /// Writes the results of the points of a block, in order. Throws RunFailure.
  void write(std::uint64_t block, const std::vector<Outcome>& outcomes) const;
  /// Writes results.csv and failed.csv from all blocks in order, and returns their content. Throws
  /// RunFailure, also if a block is missing.
  StudyTable merge() const;
  /// Visits all points of all blocks in order. Throws RunFailure if a block is missing.
  void forEachPoint(const std::function<void(const PointResult&)>& take) const;
  /// Seconds between the first and the last finished block, and their number; zero for fewer than
  /// two.
  struct Pace {
    std::uint64_t blocks = 0;
    double seconds = 0.0;
  };
  Pace pace() const;

 private:
  std::string fileOf(std::uint64_t block) const;
  std::string headOf(std::uint64_t block) const;
  /// Rows of a finished block; empty if it is missing or corrupt.
  std::optional<std::string> rowsOf(std::uint64_t block) const;
  /// Visits all rows, each as a line of a table with its line end.
  void forEachRow(const std::function<void(std::uint64_t point, bool failed, std::string_view row)>&
                      take) const;
  /// False: another process has created it meanwhile.
  bool make();
  void compare(bool mixed);
  void write(const std::string& name, const std::string& text) const;
  void removeUnfinished() const;

  std::string path_;
  const Study& study_;
  StepsChosen steps_;
};

}  // namespace whirl_twin
