#include "control/sample_instants.h"

#include <cmath>

namespace whirl_twin {

SampleInstants::SampleInstants(double rate) : rate_(rate), period_(std::llround(1.0e9 / rate)) {
  if (static_cast<double>(period_) * rate != 1.0e9) {
    period_ = 0;
  }
}

std::int64_t SampleInstants::at(std::int64_t k) const noexcept {
  // A long double has the digits of an int64.
  return period_ > 0 ? k * period_ : std::llroundl(static_cast<long double>(k) * 1.0e9L / rate_);
}

std::int64_t SampleInstants::firstFrom(std::int64_t time) const noexcept {
  auto k =
      static_cast<std::int64_t>(std::floor(static_cast<long double>(time) * 1.0e-9L * rate_)) - 1;
  while (at(k) < time) {
    ++k;
  }
  return k;
}

}  // namespace whirl_twin
