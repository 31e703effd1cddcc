// The samples of a run in one block of memory, a row for each signal, which becomes a NumPy array
// without a copy.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reports/sample_writer.h"
#include "twin/twin.h"

namespace whirl_twin {

struct SignalName {
  std::string name;  ///< "rotor.x", as in the table of `twin simulate` where that has it
  std::string unit;
};

class SampledRun final : public SampleWriter {
 public:
  /// For `samples` of these systems of the twin, which outlives the samples' writing. Throws
  /// InputError where they do not fit into the memory that is free, unless `insist`.
  SampledRun(const Twin& twin, std::vector<std::size_t> systems, std::size_t samples, bool insist);

  void write(const Observer& observer) override;
  void finish() override {}

  const std::vector<SignalName>& signals() const { return signals_; }
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
  /// Displacement of a place on the shaft: its factors of the coordinates, without zeros.
  struct Place {
    std::vector<std::pair<std::size_t, double>> x, y;
  };
  struct Sampled {
    std::size_t system;
    std::vector<Place> places;
    bool rotor, shaft;
  };

  void addSystem(std::size_t system);
  void put(double value) {
    values_.get()[row_++ * samples_ + written_] = value;
  }

  const Twin& twin_;
  std::vector<Sampled> sampled_;
  std::vector<std::size_t> controllers_;  // that have to do with the systems
  std::vector<SignalName> signals_;
  std::size_t samples_;
  std::size_t written_ = 0;
  std::size_t row_ = 0;
  Values values_;
};

}  // namespace whirl_twin
