// The folder that a study's results are in, from which it goes on where it stopped.
//
//   manifest.yaml        the study's hash, its size, and what computed it
//   study.yaml, scene.yaml  as they were
//   blocks/000000012.csv  a finished block; it has its name only when it is whole and on the disk,
//   and
//                        ends with its checksum
//   results.csv          all points that did not fail, in their order: point, numbers, measures
//   failed.csv           those that did: point, reason, numbers
//   results.h5           all of it in one file (studies/hdf5_results.h), where HDF5 is built in
//
// The last three are there when every block is. Nothing in them tells of time, place or workers.
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

/// What computes results: all that their last bits may hang on.
struct Origin {
  std::string version;
  std::string compiler;
  std::string processor;  ///< its kind, and the instructions that change rounding
};
Origin presentOrigin();

/// What all points came to, by measure, in the order of the points; NaN where one failed.
struct StudyTable {
  std::vector<std::vector<double>> measures;
  std::vector<bool> failed;
  std::uint64_t failures = 0;
};

/// A point as a finished block has it.
struct PointResult {
  std::uint64_t point = 0;
  std::vector<double> values;  ///< of the numbers that vary
  Outcome outcome;
};

class ResultFolder {
 public:
  /// Opens or makes it. Throws Refusal for the results of another study, or, unless `mixed`, of
  /// another version, compiler or processor; RunFailure where it cannot be read or written.
  ResultFolder(const std::string& path, const Study& study, bool mixed);

  const std::string& path() const { return path_; }
  /// As they were chosen when the folder was made.
  const StepsChosen& steps() const { return steps_; }
  /// Finished blocks, as the folder has them now: those whose checksum is right.
  std::vector<bool> finished() const;
  /// Outcomes of the points of a block, in their order. Throws RunFailure.
  void write(std::uint64_t block, const std::vector<Outcome>& outcomes) const;
  /// Writes results.csv and failed.csv, of all blocks in their order, and returns what is in them.
  /// Throws RunFailure, also where a block is not there.
  StudyTable merge() const;
  /// Every point of every block, in their order. Throws RunFailure where a block is not there.
  void forEachPoint(const std::function<void(const PointResult&)>& take) const;
  /// Seconds between the first and the last block that was finished, and how many of them;
  /// nothing of fewer than two.
  struct Pace {
    std::uint64_t blocks = 0;
    double seconds = 0.0;
  };
  Pace pace() const;

 private:
  std::string fileOf(std::uint64_t block) const;
  std::string headOf(std::uint64_t block) const;
  /// Of a finished block; nothing where there is none, or where it is another than was written.
  std::optional<std::string> rowsOf(std::uint64_t block) const;
  /// Its line as it goes into a table, with its end.
  void forEachRow(const std::function<void(std::uint64_t point, bool failed, std::string_view row)>&
                      take) const;
  /// False: another has made it meanwhile.
  bool make();
  void compare(bool mixed);
  void write(const std::string& name, const std::string& text) const;
  void removeUnfinished() const;

  std::string path_;
  const Study& study_;
  StepsChosen steps_;
};

}  // namespace whirl_twin
