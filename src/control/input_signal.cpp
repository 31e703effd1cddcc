#include "control/input_signal.h"

#include <cmath>
#include <utility>

namespace whirl_twin {

InputSignal InputSignal::constant(double value) {
  InputSignal signal;
  signal.kind = Kind::kHeld;
  signal.value = value;
  return signal;
}

InputSignal InputSignal::controlled(double pole) {
  InputSignal signal;
  signal.kind = Kind::kControlled;
  signal.pole = pole;
  return signal;
}

InputSignal InputSignal::harmonic(double amplitude, double frequency, double phase) {
  InputSignal signal;
  signal.kind = Kind::kHarmonic;
  signal.amplitude = amplitude;
  signal.frequency = frequency;
  signal.phase = phase;
  return signal;
}

InputSignal InputSignal::table(std::vector<std::int64_t> instants, std::vector<double> values,
                               bool hold) {
  InputSignal signal;
  signal.kind = Kind::kTable;
  signal.instants = std::move(instants);
  signal.values = std::move(values);
  signal.hold = hold;
  return signal;
}

SignalFault faultOf(const InputSignal& signal) {
  if (!std::isfinite(signal.value)) {
    return {"value", "must be finite", 0};
  }
  if (!std::isfinite(signal.amplitude)) {
    return {"amplitude", "must be finite", 0};
  }
  if (!(std::fabs(signal.frequency) <= kLargestFrequency)) {
    return {"frequency", "must be within +-1e6 rad/s", 0};
  }
  if (!(std::fabs(signal.phase) <= kMaxPhase)) {
    return {"phase", "must be within +-1e15 rad", 0};
  }
  if (!(signal.pole >= 0.0 && std::isfinite(signal.pole))) {
    return {"pole", "must be finite and not negative", 0};
  }
  if (signal.kind != InputSignal::Kind::kTable) {
    return {nullptr, nullptr, 0};
  }
  if (signal.instants.empty() || signal.values.size() != signal.instants.size()) {
    return {"table", "must have at least one instant, and a value at each", 0};
  }
  for (std::size_t row = 0; row < signal.instants.size(); ++row) {
    if (row > 0 && signal.instants[row] <= signal.instants[row - 1]) {
      return {"time", "must increase from row to row", row};
    }
    if (!std::isfinite(signal.values[row])) {
      return {"value", "must be finite", row};
    }
  }
  return {nullptr, nullptr, 0};
}

}  // namespace whirl_twin
