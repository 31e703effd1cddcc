#include "tools/keyboard.h"

#include <poll.h>
#include <unistd.h>

#include <ctime>

namespace whirl_twin {

Keyboard::Keyboard()
    : there_(::isatty(STDIN_FILENO) == 1 && ::tcgetattr(STDIN_FILENO, &before_) == 0) {
  if (there_) {
    termios plain = before_;
    plain.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &plain);
  }
}

Keyboard::~Keyboard() {
  if (there_) {
    ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
}

std::optional<Key> Keyboard::wait(std::chrono::nanoseconds timeout) {
  pollfd keys{there_ ? STDIN_FILENO : -1, POLLIN, 0};
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const timespec wait{static_cast<std::time_t>(seconds.count()),
                      static_cast<long>((timeout - seconds).count())};
  return ::ppoll(&keys, 1, &wait, nullptr) > 0 ? read() : std::nullopt;
}

/// One key: a letter, or the three bytes of an arrow.
std::optional<Key> Keyboard::read() {
  char typed[3];
  if (::read(STDIN_FILENO, typed, 1) != 1) {
    there_ = false;  // the terminal has gone
    return std::nullopt;
  }
  pollfd more{STDIN_FILENO, POLLIN, 0};
  if (typed[0] == '\x1b' && ::poll(&more, 1, 0) > 0 && ::read(STDIN_FILENO, typed + 1, 2) == 2) {
    return typed[2] == 'C'   ? std::optional(Key::kForward)
           : typed[2] == 'D' ? std::optional(Key::kBack)
                             : std::nullopt;
  }
  switch (typed[0]) {
    case ' ':
      return Key::kSpace;
    case 's':
      return Key::kStep;
    case '+':
      return Key::kFaster;
    case '-':
      return Key::kSlower;
    case 'q':
      return Key::kQuit;
    default:
      return std::nullopt;
  }
}

}  // namespace whirl_twin
