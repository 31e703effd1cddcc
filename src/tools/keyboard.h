// Unbuffered keys of a terminal, without Enter. If standard input is not a terminal there are none.
#pragma once

#include <termios.h>

#include <chrono>
#include <optional>

namespace whirl_twin {

enum class Key { kSpace, kStep, kFaster, kSlower, kForward, kBack, kQuit };

class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  bool isThere() const { return there_; }

  /// Waits at most `timeout` for a known key; a signal also ends the wait.
  std::optional<Key> wait(std::chrono::nanoseconds timeout);

 private:
  std::optional<Key> read();

  termios before_{};
  bool there_;
};

}  // namespace whirl_twin
