// The samples of a run in one block of memory, a row for each signal, which becomes a NumPy array
// without a copy.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

#include "reports/sample_writer.h"
#include "reports/sampled_signals.h"
#include "twin/twin.h"

namespace whirl_twin {

class SampledRun final : public SampleWriter {
 public:
  /// For `samples` of these systems of the twin, which outlives the samples' writing. Throws
  /// InputError where they do not fit into the memory that is free, unless `insist`.
  SampledRun(const Twin& twin, const std::vector<std::size_t>& systems, std::size_t samples,
             bool insist);

  void write(const Observer& observer) override;
  void finish() override {}

  const std::vector<SignalName>& signals() const { return signals_.names(); }
  std::size_t samples() const { return samples_; }
  /// Samples written so far.
  std::size_t written() const { return written_; }

  struct Free {
    void operator()(double* values) const { std::free(values); }
  };
  using Values = std::unique_ptr<double, Free>;
  /// [signal][sample]; the run has none afterwards.
  Values takeValues() { return std::move(values_); }

 private:
  SampledSignals signals_;
  std::size_t samples_;
  std::size_t written_ = 0;
  Values values_;
};

}  // namespace whirl_twin
