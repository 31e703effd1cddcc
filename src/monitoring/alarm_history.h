// The history of the alarms in a file: one JSON object a line, an event a line, always appended, so
// that it says after a death of the monitor what it said before. Event is "alert" (all fields of
// the alert, but for numbers that are not meant), "reset" of the alarms, "run" of simulated time,
// "settings" as they were changed live, and at the head of a file that was begun anew "raised", how
// often a kind was before, and "id", the last that was given. A line that cannot be read, the last
// one of a monitor that was killed while it wrote, is left out.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>

#include "monitoring/alarm_memory.h"

namespace whirl_twin {

class AlarmHistory {
 public:
  static constexpr std::size_t kLargest = 4'000'000;  ///< bytes, as default

  /// Reads the file if there is one. A larger one becomes PATH.old, and one is begun with what has
  /// to be known.
  explicit AlarmHistory(const std::string& path, std::size_t largest = kLargest);

  /// As the file had it when it was opened.
  const AlarmMemory& memory() const { return memory_; }
  std::size_t unreadableLines() const { return unreadable_; }
  /// Why nothing is kept; "" as long as it is.
  const std::string& problem() const { return problem_; }

  void write(const state::Alert& event);
  void writeReset();
  void writeRun(const TwinRun& run);
  /// For who reads it: a monitor that comes back has its parameters.
  void writeSettings(const std::string& text);

 private:
  void read(const std::string& line);
  void writeLine(const std::string& line);

  std::string path_;
  AlarmMemory memory_;
  std::size_t unreadable_ = 0;
  std::string problem_;
  std::ofstream file_;
};

}  // namespace whirl_twin
