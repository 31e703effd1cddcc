#include "control/input_shaper.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "control/inputs.h"

namespace whirl_twin {

namespace {

double dampedFrequency(double frequency, double damping_ratio) {
  return frequency * std::sqrt((1.0 - damping_ratio) * (1.0 + damping_ratio));
}

/// Ratio of amplitudes half a period apart.
double halfPeriodDecay(double damping_ratio) {
  return std::exp(-kPi * damping_ratio / dampedFrequency(1.0, damping_ratio));
}

std::int64_t delayOf(const ShapedPart& part) {
  return std::llround(1e9 * part.time);
}

}  // namespace

std::vector<ShapedPart> zeroVibration(double frequency, double damping_ratio) {
  const double k = halfPeriodDecay(damping_ratio);
  return {{1.0 / (1.0 + k), 0.0}, {k / (1.0 + k), kPi / dampedFrequency(frequency, damping_ratio)}};
}

std::vector<ShapedPart> zeroVibrationDerivative(double frequency, double damping_ratio) {
  const double k = halfPeriodDecay(damping_ratio);
  const double whole = (1.0 + k) * (1.0 + k);
  const double half = kPi / dampedFrequency(frequency, damping_ratio);
  return {{1.0 / whole, 0.0}, {2.0 * k / whole, half}, {k * k / whole, 2.0 * half}};
}

double residualVibration(const std::vector<ShapedPart>& shaper, double frequency,
                         double damping_ratio) {
  const double damped = dampedFrequency(frequency, damping_ratio);
  const double last = shaper.back().time;
  std::complex<double> sum;
  for (const ShapedPart& part : shaper) {
    sum += std::polar(part.share * std::exp(damping_ratio * frequency * (part.time - last)),
                      damped * part.time);
  }
  // At once it would have left e^(-zeta w last) by then.
  return std::abs(sum) * std::exp(damping_ratio * frequency * last);
}

InputSignal shaped(const InputSignal& table, const std::vector<ShapedPart>& shaper) {
  std::vector<std::int64_t> instants;
  for (const ShapedPart& part : shaper) {
    for (const std::int64_t instant : table.instants) {
      instants.push_back(instant + delayOf(part));
    }
  }
  std::sort(instants.begin(), instants.end());
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  Inputs given({table});
  std::vector<double> values;
  for (const std::int64_t instant : instants) {
    double value = 0.0;
    for (const ShapedPart& part : shaper) {
      given.begin(instant - delayOf(part));
      value += part.share * given.value(0, 0.0);
    }
    values.push_back(value);
  }
  return InputSignal::table(std::move(instants), std::move(values), table.hold);
}

}  // namespace whirl_twin
