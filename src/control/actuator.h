// Actuator model between two samples of its controller.
//
//   output -> resolution -> limit -> slew -> zero-order hold -> lag
//
// The lag is a continuous first-order lag of the held value, as of a current amplifier: it is a
// state of the input that the actuator acts on (control/inputs.h).
#pragma once

namespace whirl_twin {

/// Deviations of an actuator from its command, in the unit of the input that it acts on; 0: none.
struct ActuatorSettings {
  double limit = 0.0;       ///< output limited to +- this
  double slew = 0.0;        ///< [1/s], it changes no faster: by slew / rate from sample to sample
  double resolution = 0.0;  ///< of the converter: outputs are whole multiples of it
  double bandwidth = 0.0;   ///< [Hz], of a first-order lag, i' = 2 pi bandwidth (held - i)
};

class Actuator {
 public:
  Actuator(const ActuatorSettings& settings, double period);  ///< [s], from sample to sample

  // Real-time safe.

  void reset() noexcept { value_ = 0.0; }
  /// Sets the command, a finite value: false where the actuator cannot reach it.
  bool take(double command) noexcept;
  /// The held value, before the lag.
  double value() const noexcept { return value_; }

 private:
  double limit_;  ///< infinite: none
  double most_;   ///< change from sample to sample; infinite: any
  double resolution_;
  double value_ = 0.0;
};

}  // namespace whirl_twin
