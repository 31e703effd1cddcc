// What no estimate saw: a command that has worked for ten seconds and said nothing says that it is
// at work.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace whirl_twin {

class Patience {
 public:
  /// `command` is what is at work: "twin analyze".
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
