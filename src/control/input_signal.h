// Signal of an input of a system: a force, a torque, the motion of a support. It is
//
//   held      a constant, or the value of the last command: the same over whole steps
//   harmonic  amplitude cos(frequency t + phase), t the simulated time
//   table     values at instants, held from one instant to the next or linear between them; before
//             the first and after the last it keeps their values
//   controlled  held from one instant to the next by a controller of the scene, or followed by an
//             actuator with a lag, lag u' = held - u, from instant to instant exactly; 0 before
//
// Instants are whole nanoseconds of simulated time and a harmonic's phase is counted in integers
// (SteadyTurn), so that neither accumulates an error over any number of steps.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whirl_twin {

/// An error of a signal: the field as in scene files, and the requirement.
struct SignalFault {
  const char* field;
  const char* expected;
  std::size_t row;  ///< of a table, from 0
};

constexpr double kLargestFrequency = 1.0e6;  ///< [rad/s]: phases stay below 1e15 rad for 31 years
constexpr double kMaxPhase = 1.0e15;         ///< [rad]

struct InputSignal {
  enum class Kind { kNone, kHeld, kHarmonic, kTable, kControlled };

  Kind kind = Kind::kNone;                  ///< kNone: the input does not act
  double value = 0.0;                       ///< kHeld: until a command changes it
  double amplitude = 0.0;                   ///< kHarmonic
  double frequency = 0.0;                   ///< [rad/s]
  double phase = 0.0;                       ///< [rad]
  std::vector<std::int64_t> instants = {};  ///< kTable [ns], ascending
  std::vector<double> values = {};          ///< at the instants
  bool hold = false;                        ///< from each instant to the next; else linear
  double pole = 0.0;                        ///< kControlled [1/s], 1 / lag; 0: no lag

  static InputSignal constant(double value);
  static InputSignal controlled(double pole = 0.0);
  static InputSignal harmonic(double amplitude, double frequency, double phase);
  static InputSignal table(std::vector<std::int64_t> instants, std::vector<double> values,
                           bool hold);
};

/// The first fault of a signal; nullptr expected: none.
SignalFault faultOf(const InputSignal& signal);

/// A signal between two breakpoints: from `value` on, its slope falling off as e^(-decay t); value
/// + slope * (offset - from) where it does not.
struct SignalPiece {
  double from = 0.0;  ///< [s] after the instant from which offsets count
  double value = 0.0;
  double slope = 0.0;  ///< [1/s]
  double decay = 0.0;  ///< [1/s]

  double at(double offset) const noexcept {
    const double t = offset - from;
    return value + slope * (decay == 0.0 ? t : -std::expm1(-decay * t) / decay);
  }
  double slopeAt(double offset) const noexcept {
    return decay == 0.0 ? slope : slope * std::exp(-decay * (offset - from));
  }
};

}  // namespace whirl_twin
