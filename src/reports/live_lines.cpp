#include "reports/live_lines.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "messages/names.h"
#include "reports/output.h"

namespace whirl_twin {

namespace {

struct Room {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

Room room() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

/// A character that is no ASCII takes more than a byte and at least a column: never too wide.
std::string cutToColumns(const std::string& line, std::size_t columns) {
  std::string out;
  for (std::size_t at = 0, column = 0; at < line.size() && column < columns; ++column) {
    const std::size_t length = std::max<std::size_t>(1, printableLength(line, at));
    out += line.substr(at, length);
    at += length;
  }
  return out;
}

}  // namespace

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

LiveLines::LiveLines() : on_terminal_(::isatty(STDOUT_FILENO) == 1) {}

void LiveLines::show(const std::vector<std::string>& lines) {
  erase();
  std::string text;
  if (!on_terminal_) {
    for (const std::string& line : lines) {
      text += line + "\n";
    }
    return print(text);
  }
  const Room there = room();
  const std::size_t most = std::max<std::size_t>(2, there.rows) - 1;  // the cursor has the last row
  const bool all = lines.size() <= most;
  for (std::size_t i = 0; i < (all ? lines.size() : most - 1); ++i) {
    text += cutToColumns(lines[i], there.columns) + "\n";
  }
  if (!all) {
    text += cutToColumns(fmt::format("... and {} more", lines.size() - (most - 1)), there.columns) +
            "\n";
  }
  print(text);
  shown_ = std::min(lines.size(), most);
}

void LiveLines::keep(const std::string& line) {
  erase();
  print(line + "\n");
}

/// Up, to the first column, and nothing left below.
void LiveLines::erase() {
  if (shown_ > 0) {
    std::fputs(fmt::format("\x1b[{}A\r\x1b[J", shown_).c_str(), stdout);
  }
  shown_ = 0;
}

void LiveLines::print(const std::string& text) {
  printText(text);
  finishStandardOutput();
}

}  // namespace whirl_twin
