// Progress note for work without a run-time estimate: a command that has used ten seconds of
// processor time without output reports that it is running.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace whirl_twin {

/// No note from now on: the command runs until it is stopped, as its user knows.
void runsUntilStopped();

class Patience {
 public:
  /// `command`: the name in the note, "twin analyze".
  explicit Patience(std::string command);
  ~Patience();
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

 private:
  void watch();

  std::string command_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace whirl_twin
