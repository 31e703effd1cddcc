// Progress of long work, and its end on request: a bar on a terminal and Ctrl-C for the command
// line, a callback for a program.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace whirl_twin {

class WorkProgress {
 public:
  virtual ~WorkProgress() = default;

  /// Work of so many steps begins. `asked`: the option that sets its length, "--duration: 100 s".
  /// `insist`: no limit on the computing time.
  virtual void begin(const std::string& asked, std::int64_t steps, bool insist) = 0;
  /// So many steps are done. Returns the number of steps until the next call. Throws InputError
  /// for work that would take too long.
  virtual std::int64_t show(std::int64_t done) = 0;
  /// Before a message, and at the end.
  virtual void clear() = 0;

  /// An end of the work was requested.
  virtual bool interrupted() = 0;
  /// Set by the same request, for work that polls it.
  virtual std::atomic<bool>& stop() = 0;
};

}  // namespace whirl_twin
