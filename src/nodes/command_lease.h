// One commander at a time: who has commanded last keeps the twin to itself for a while.
#pragma once

#include <string>

namespace whirl_twin {

class CommandLease {
 public:
  /// duration [s], from the last command of a holder on.
  explicit CommandLease(double duration) : duration_(duration) {}

  /// A command comes at `now` [s, a clock that only goes forward]. "" if it may: the lease is its
  /// sender's from then on; else who has it, and for how long.
  std::string ask(const std::string& sender, double now);
  /// Ends the lease, if it is the sender's.
  void release(const std::string& sender);
  /// Who has it; "": nobody.
  std::string holder(double now) const { return now < until_ ? holder_ : ""; }

 private:
  double duration_;      // [s]
  double until_ = -1.0;  // [s]
  std::string holder_;
};

}  // namespace whirl_twin
