// Measured samples of several sources, in the order of their instants. Messages come when they
// come: a source may be slower than others, late, silent, or say a thing twice, and its clock may
// be set. What comes out depends on the messages and their order alone, so that a log played back
// gives what the live run gave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "messages/measurement.h"

namespace whirl_twin {

struct MeasuredSample {
  std::int64_t time = 0;  ///< [ns], of the machine's clock
  std::size_t source = 0;
  std::size_t channel = 0;  ///< of that source, as it was registered
  double value = 0.0;       ///< in the unit in which it was registered
  double deviation = 0.0;   ///< as the message says, likewise; 0: it does not
  bool valid = true;        ///< false: not to be used, not finite, or in a unit of another kind
};

/// Further ahead no clock has gone: it has been set.
inline constexpr std::int64_t kClockJump = 60'000'000'000;  // ns

/// What has become of samples before they were of use.
struct MeasuredCounts {
  std::int64_t late = 0;      ///< came after their turn
  std::int64_t lost = 0;      ///< of blocks that never came
  std::int64_t repeated = 0;  ///< came twice
};

class MeasuredQueue {
 public:
  /// A sample waits for those of slower sources until the newest is `patience` [s] ahead of it.
  explicit MeasuredQueue(double patience);

  /// Returns its number. units: of the samples that come out, of each channel; "": as they come.
  std::size_t addSource(const std::string& name, std::vector<std::string> channels,
                        std::vector<std::string> units);
  /// The next message, if it is of one of the sources. False where its clock has been set: what
  /// waits is left out, and all begins anew with this message.
  bool take(const state::Measurement& message);
  /// The earliest sample, if none before it can come any more.
  std::optional<MeasuredSample> next();
  /// The next sample of a channel that has come, whether its turn has come or not; else nullptr.
  const MeasuredSample* front(std::size_t source, std::size_t channel = 0) const;
  void pop(std::size_t source) { sources_[source].waiting.pop_front(); }
  /// All that has come counts as complete: no more will follow.
  void finish() { finished_ = true; }
  /// [ns], before which everything is there.
  std::int64_t completeUntil() const;
  bool silent(std::size_t source) const;  ///< others are further by more than the patience
  const MeasuredCounts& counts(std::size_t source) const { return sources_[source].counts; }

 private:
  struct Source {
    std::string name;
    std::vector<std::string> channels;
    std::vector<std::string> units;
    std::deque<MeasuredSample> waiting;
    std::optional<std::int64_t> newest;  // [ns]
    std::int64_t newest_block = 0;
    std::int64_t block_size = 0;  // samples of the last one
    int behind = 0;               // messages in a row that were all late
    MeasuredCounts counts;
  };

  void takeSamples(const state::Measurement& message, Source& source, std::size_t number);
  std::int64_t newest() const;

  std::int64_t patience_;  // [ns]
  std::vector<Source> sources_;
  std::int64_t given_;  // [ns], of the last sample that went out
  bool finished_ = false;
};

}  // namespace whirl_twin
