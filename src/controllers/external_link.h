// Between the real-time loop and the thread that talks to a controller in another process: samples
// out, commands in, through rings without a lock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "realtime/record_ring.h"

namespace whirl_twin {

/// A sample as it goes out, or the command that answers it.
struct ExternalSample {
  std::int64_t run = 0;     ///< which run of simulated time: another after each reset
  std::int64_t sample = 0;  ///< its index
  double time = 0.0;        ///< [s], simulated, of the sample
  std::vector<double> values;
};

class ExternalLink {
 public:
  ExternalLink(std::size_t measured, std::size_t outputs);

  std::size_t measured() const { return told_.recordSize() - kValues; }
  std::size_t outputs() const { return heard_.recordSize() - kValues; }

  // The loop; real-time safe. `values` of the sample in and out is never resized.

  /// What finds no room is lost.
  void tell(std::int64_t run, std::int64_t sample, double time, const double* values) noexcept;
  /// The oldest command that waits, into one with as many values as outputs(); false: none.
  bool hear(ExternalSample& command) noexcept;

  // One other thread.

  /// The oldest sample that waits; false: none.
  bool take(ExternalSample& sample);
  /// Hands a command over. False for one of another length, or where the loop is far behind.
  bool answer(const ExternalSample& command);

 private:
  enum { kRun, kSample, kTime, kValues };
  static bool pop(RecordRing& ring, std::vector<double>& record, ExternalSample& out) noexcept;

  RecordRing told_, heard_;
  std::vector<double> telling_, hearing_;   // the loop's
  std::vector<double> taking_, answering_;  // the other thread's
};

}  // namespace whirl_twin
