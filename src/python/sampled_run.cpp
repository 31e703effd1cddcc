#include "python/sampled_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "reports/asked_cost.h"

namespace whirl_twin {

SampledRun::SampledRun(const Twin& twin, const std::vector<std::size_t>& systems,
                       std::size_t samples, bool insist)
    : signals_(twin, systems, SampledSignals::Energy::kYes), samples_(samples) {
  const std::size_t count = signals().size();
  const double size = static_cast<double>(count) * static_cast<double>(samples_) * sizeof(double);
  tell({0.0, size, fmt::format("sample: {} signals, {} samples", count, samples_)}, insist);
  constexpr double kMaxSize = 1.0e18;  // bytes, which std::size_t holds
  values_.reset(size > kMaxSize
                    ? nullptr
                    : static_cast<double*>(std::malloc(std::max<std::size_t>(1, count * samples_) *
                                                       sizeof(double))));
  if (!values_) {
    throw std::bad_alloc();
  }
}

void SampledRun::write(const Observer& observer) {
  if (written_ == samples_) {
    return;
  }
  std::size_t row = 0;
  signals_.eachOf(observer,
                  [&](double value) { values_.get()[row++ * samples_ + written_] = value; });
  ++written_;
}

}  // namespace whirl_twin
