// Keys pressed in a terminal, one by one and without Enter. Where standard input is no terminal
// there are none.
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

  /// Waits for a key that means something, at most `timeout`; a signal ends the wait, too.
  std::optional<Key> wait(std::chrono::nanoseconds timeout);

 private:
  std::optional<Key> read();

  termios before_{};
  bool there_;
};

}  // namespace whirl_twin
