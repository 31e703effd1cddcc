// What a method has got wrong over a system's horizon: the errors of its steps, of which the last
// one in so many is measured, added up and forgotten with the horizon as time constant.
#pragma once

namespace whirl_twin {

class ErrorTrack {
 public:
  /// The next record: time [s], sum of the steps' errors since the system was set [-], which was
  /// `anew` since the last record. At the beginning the sum may also fall: it counts in parts of a
  /// motion that grows.
  void observe(double time, double sum, double horizon, bool anew);
  double estimate() const { return estimate_; }  ///< [-]; NaN: not estimated

 private:
  double estimate_ = 0.0;
  double sum_ = 0.0;   // of the newest record
  double time_ = 0.0;  // [s], of it
};

}  // namespace whirl_twin
