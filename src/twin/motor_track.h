// Energy balance of a motor since the start, from the records of its shaft.
//
// The motor's work is summed record by record by the trapezoidal rule with end corrections: h/2 (P0
// + P1) + h^2/12 (P0' - P1'), P = T w, P' = (T' w + T) w'. The dissipated energy is this work less
// the work audited by the step, so that motor work = dissipated + gained energy holds as accurately
// as the audit, i.e. the energy residual. (Energy supplied by a cross-coupled stiffness counts as
// negative dissipation.)
#pragma once

#include "control/motor.h"

namespace whirl_twin {

class MotorTrack {
 public:
  /// The shaft at the next record: time [s], speed [rad/s], acceleration [rad/s^2], and the audited
  /// work [J] of its system. The first one is the start.
  void observe(const Motor& motor, double time, double speed, double acceleration, double work);
  void restart() { *this = MotorTrack{}; }

  double power() const { return power_; }                            ///< [W], T w
  double work() const { return work_; }                              ///< [J], of the motor
  double dissipated() const { return work_ - (audited_ - first_); }  ///< [J], including drag

 private:
  bool started_ = false;
  double time_ = 0.0, power_ = 0.0, power_rate_ = 0.0, work_ = 0.0;
  double audited_ = 0.0, first_ = 0.0;
};

}  // namespace whirl_twin
