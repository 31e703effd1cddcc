// Lines that are drawn again and again in the same place of a terminal; into a file or a pipe they
// go one below another.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

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

}  // namespace whirl_twin
