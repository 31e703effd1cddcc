// The three ways a call can go wrong, each caught by its kind:
//   Refusal           what the user gave cannot be meant or done: a scene, an option, a message
//   RunFailure        a run failed: a file that cannot be written, a step that cannot be prepared
//   std::logic_error  a programmer's misuse, which no user's input can bring about
#pragma once

#include <stdexcept>

namespace whirl_twin {

/// The user's input is refused; what() says where, what was expected with its unit, and what was
/// found, one complaint a line. Exit status 2.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is good, but what it asks for failed. Exit status 1.
class RunFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whirl_twin
