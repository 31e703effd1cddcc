// What a motor has given since the start and what has become of it, from the records of its shaft.
//
// The motor's work is summed record by record, trapezoid and end slopes: h/2 (P0 + P1) + h^2/12
// (P0' - P1'), P = T w, P' = (T' w + T) w'. What has been dissipated is that less the work that the
// step itself audits, so that motor work = dissipated + gained energy holds as well as the audit
// does, the energy residual. (What a cross-coupled stiffness gives counts as dissipated, negative.)
#pragma once

#include "control/motor.h"

namespace whirl_twin {

class MotorTrack {
 public:
  /// The shaft at a later record: time [s], speed [rad/s], acceleration [rad/s^2], and the audited
  /// work [J] of its system. The first one is the start.
  void observe(const Motor& motor, double time, double speed, double acceleration, double work);
  void restart() { *this = MotorTrack{}; }

  double power() const { return power_; }                            ///< [W], T w
  double work() const { return work_; }                              ///< [J], of the motor
  double dissipated() const { return work_ - (audited_ - first_); }  ///< [J], drag included

 private:
  bool started_ = false;
  double time_ = 0.0, power_ = 0.0, power_rate_ = 0.0, work_ = 0.0;
  double audited_ = 0.0, first_ = 0.0;
};

}  // namespace whirl_twin
