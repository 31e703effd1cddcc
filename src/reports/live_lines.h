// What a terminal shows of live messages: lines that are drawn again and again in the same place
// (into a file or a pipe they go one below another), and the fields of a message as text and JSON.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "messages/message.h"
#include "reports/output.h"

namespace whirl_twin {

/// [s], wall time: since the lines were shown, or a message came.
double secondsSince(std::chrono::steady_clock::time_point begin);

class LiveLines {
 public:
  LiveLines();

  /// Whether standard output is a terminal.
  bool onTerminal() const { return on_terminal_; }

  /// In place of those shown before, cut to what the terminal has room for. Without what a terminal
  /// might obey (printableLines()). Throws RunFailure if they cannot be written.
  void show(const std::vector<std::string>& lines);
  /// One that stays, above those that change.
  void keep(const std::string& line);

 private:
  void erase();
  void print(const std::string& text);

  bool on_terminal_;
  std::size_t shown_ = 0;
};

/// "speed 104.72 rad/s, x 1.2e-05 m, ...", in the order of the .msg file, without its time and whom
/// it is about.
std::string messageText(const Message& message);

/// By name, with step, time [s], stamp [ns] and whom it is about.
Json messageJson(const Message& message);

}  // namespace whirl_twin
