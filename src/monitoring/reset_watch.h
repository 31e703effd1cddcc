// Whether the twin has begun anew, which it says itself: its loop statistics carry when the
// simulation was started and how often it has been reset since, its epoch. One message alone is not
// believed, for a network has no checksum: the first state of the new run of time confirms it, or a
// second message. An epoch that is older than the present one is a message that was late.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "messages/loop_statistics.h"

namespace whirl_twin {

class ResetWatch {
 public:
  /// The loop says which run of time this is, at wall_time [s]; true: it is another than before,
  /// for certain.
  bool take(const state::LoopStatistics& loop, double wall_time);
  /// Whether a state at time [s, simulated] belongs to the run of time that was announced, if one
  /// was.
  bool confirmedBy(double time, double wall_time) const;
  /// When the simulation was started and how often reset; none before it has said so.
  std::optional<std::pair<std::int64_t, std::uint64_t>> present() const {
    if (!present_) {
      return std::nullopt;
    }
    return std::make_pair(present_->started, present_->epoch);
  }
  /// The announced run of time is the present one.
  void begin();

 private:
  struct Announcement {
    std::int64_t started;
    std::uint64_t epoch;
    double time;         ///< [s], simulated, when it was said
    std::int64_t stamp;  ///< [ns], of the message
    double wall_time;    ///< [s]

    auto run() const { return std::tie(started, epoch); }
  };

  std::optional<Announcement> present_;
  std::optional<Announcement> next_;
};

}  // namespace whirl_twin
