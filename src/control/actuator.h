// An actuator between two samples of its controller: what it is told, as it can.
//
//   output -> resolution -> limit -> slew -> held until the next -> lag
//
// The lag is that of what follows the held value all the time, as a current its amplifier: a state
// of its own between the instants, of the input that it acts on (control/inputs.h).
#pragma once

namespace whirl_twin {

/// How an actuator departs from what it is told, in the unit of the input that it acts on; 0: it
/// does not.
struct ActuatorSettings {
  double limit = 0.0;       ///< it gives no more than +- this
  double slew = 0.0;        ///< [1/s], it changes no faster: by slew / rate from sample to sample
  double resolution = 0.0;  ///< of the converter: outputs are whole multiples of it
  double bandwidth = 0.0;   ///< [Hz], of a first-order lag, i' = 2 pi bandwidth (held - i)
};

class Actuator {
 public:
  Actuator(const ActuatorSettings& settings, double period);  ///< [s], from sample to sample

  // Real-time safe.

  void reset() noexcept { value_ = 0.0; }
  /// Told a finite value: false where it cannot give that.
  bool take(double told) noexcept;
  /// What it is held at, before its lag.
  double value() const noexcept { return value_; }

 private:
  double limit_;  ///< infinite: none
  double most_;   ///< change from sample to sample; infinite: any
  double resolution_;
  double value_ = 0.0;
};

}  // namespace whirl_twin
