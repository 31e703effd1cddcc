// Merges the measured samples of several sources in the order of their instants. Messages may be
// late, missing or repeated, sources may be slower than others, and their clock may be set. The
// output depends only on the messages and their order: replaying a log gives the same results as
// the live run.
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
  std::size_t channel = 0;  ///< of that source, in the order of registration
  double value = 0.0;       ///< in the registered unit
  double deviation = 0.0;   ///< as in the message, in that unit; 0: not specified
  bool valid = true;        ///< false: not usable, not finite, or in a unit of another kind
};

/// A larger jump forward means that the clock has been set.
inline constexpr std::int64_t kClockJump = 60'000'000'000;  // ns

/// Counts of unused samples.
struct MeasuredCounts {
  std::int64_t late = 0;      ///< came after their turn
  std::int64_t lost = 0;      ///< of blocks that never came
  std::int64_t repeated = 0;  ///< duplicates
};

class MeasuredQueue {
 public:
  /// patience: reordering delay [s]; a sample waits for slower sources until the newest one is so
  /// far ahead of it.
  explicit MeasuredQueue(double patience);

  /// Returns the index of the source. units: of the output samples, for each channel; "":
  /// unconverted.
  std::size_t addSource(const std::string& name, std::vector<std::string> channels,
                        std::vector<std::string> units);
  /// Adds a message if it is of one of the sources. False if its clock has been set: waiting
  /// samples are discarded, and the queue restarts with this message.
  bool take(const state::Measurement& message);
  /// The earliest sample, once no earlier one can come.
  std::optional<MeasuredSample> next();
  /// The next sample of a channel that has come, even before its turn; nullptr: none.
  const MeasuredSample* front(std::size_t source, std::size_t channel = 0) const;
  void pop(std::size_t source) { sources_[source].waiting.pop_front(); }
  /// No more messages will come: all that have come are complete.
  void finish() { finished_ = true; }
  /// [ns], all samples before this instant have come.
  std::int64_t completeUntil() const;
  bool silent(std::size_t source) const;  ///< others are ahead by more than the reordering delay
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
    int behind = 0;               // consecutive messages that were late
    MeasuredCounts counts;
  };

  void takeSamples(const state::Measurement& message, Source& source, std::size_t number);
  std::int64_t newest() const;

  std::int64_t patience_;  // [ns]
  std::vector<Source> sources_;
  std::int64_t given_;  // [ns], of the last output sample
  bool finished_ = false;
};

}  // namespace whirl_twin
