// The history of the alarms in a file: one JSON object a line, an event a line, always appended, so
// that a monitor that died leaves a complete record. Event is "alert" (all fields of
// the alert, but for numbers that are not meant), "reset" of the alarms, "run" of simulated time,
// "settings" as they were changed live, and at the head of a new file "raised", how
// often a kind was before, and "id", the last that was given. Each line ends with its checksum
// (CRC-32C of what is before it); lines of earlier versions have none. A line that cannot be read
// or has another checksum, as the last one of a monitor that was killed while it wrote, is left
// out.
//
// A disk that is full, read-only or gone loses no alarm: what could not be written is tried again
// once a second, and with the first line that can be written again everything that is active or
// latched then is, and what has been cleared meanwhile. So it is where the file was removed or
// another disk is in its place.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "monitoring/alert_list.h"

namespace whirl_twin {

class AlarmHistory {
 public:
  static constexpr std::size_t kLargest = 4'000'000;  ///< bytes, as default

  /// Reads the file if there is one. A larger one becomes PATH.old, at any time, and one is begun
  /// with what has to be known.
  explicit AlarmHistory(const std::string& path, std::size_t largest = kLargest);
  ~AlarmHistory();
  AlarmHistory(const AlarmHistory&) = delete;
  AlarmHistory& operator=(const AlarmHistory&) = delete;

  /// As the file had it when it was opened, and what has been written since.
  const AlarmMemory& memory() const { return memory_; }
  std::size_t unreadableLines() const { return unreadable_; }
  /// Why nothing is kept at present; "" as long as it is.
  const std::string& problem() const { return problem_; }

  void write(const state::Alert& event);
  void writeReset();
  void writeRun(const TwinRun& run);
  /// For who reads it: a monitor that comes back has its parameters.
  void writeSettings(const std::string& text);
  /// To be called a few times a second: writes what could not be written, if it can be now.
  void retry();

 private:
  void writeLine(const std::string& line);
  /// The file that is at the path now is open, and stored_ is what it has.
  bool open();
  void close();
  bool isThere() const;
  bool append(const std::string& text);
  bool fail(int error);
  /// What the file has to say so that a monitor that reads it knows memory_.
  std::string lacking() const;
  void beginNewFile();

  std::string path_;
  std::size_t largest_;
  AlarmMemory memory_;
  std::map<std::uint32_t, state::Alert> stored_;  ///< raised, as the file has them
  bool lacks_reset_ = false;
  std::string lacks_settings_;  ///< the line
  std::size_t unreadable_ = 0;
  std::string problem_;
  std::chrono::steady_clock::time_point next_try_;
  int file_ = -1;
};

}  // namespace whirl_twin
