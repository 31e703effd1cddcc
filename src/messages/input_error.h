// The three kinds of error of a call, each caught by its type:
//   InputError           invalid or unsupported user input: a scene, an option, a message
//   RunFailure        a run failed: a file cannot be written, a step cannot be prepared
//   std::logic_error  a programming error, which no user input can cause
#pragma once

#include <stdexcept>

namespace whirl_twin {

/// The user's input is invalid; what() gives the place, the expected value with its unit, and the
/// value found, one error per line. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is valid, but the requested operation failed. Exit status 1.
class RunFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whirl_twin
