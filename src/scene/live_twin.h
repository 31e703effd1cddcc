// The twin as a fixed-rate loop runs it: one cycle a period, commands in, records out. No thread of
// its own, no lock, no allocation in a cycle.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <vector>

#include "realtime/record_ring.h"
#include "scene/twin.h"

namespace whirl_twin {

/// A command from outside the loop.
struct TwinCommand {
  enum class Kind : std::uint8_t { kPause, kResume, kReset, kStep, kSetSpeed };
  Kind kind = Kind::kPause;
  std::uint64_t steps = 0;        ///< kStep: how many
  std::size_t drive = 0;          ///< kSetSpeed: of the scene
  double speed = 0.0;             ///< [rad/s]
  double max_acceleration = 0.0;  ///< [rad/s^2]
  double max_jerk = 0.0;          ///< [rad/s^3]; 0: unlimited
};

/// What became of a command.
struct TwinAnswer {
  bool done = false;
  std::int64_t step = 0;  ///< the step reached
  double duration = 0.0;  ///< [s], kSetSpeed: of the move
};

class LiveTwin {
 public:
  /// Up to ring_capacity records wait for their reader; more are dropped and counted.
  LiveTwin(const Scene& scene, std::size_t ring_capacity);

  /// Of the twin only what does not change while it runs may be used while the loop runs.
  const Twin& twin() const { return twin_; }

  /// The loop's thread, once a period; scheduled [ns] goes into the record. Real-time safe.
  bool cycle(std::int64_t scheduled) noexcept;

  // One other thread: commands.

  /// Hands a command over; false if the loop is far behind with earlier ones. Commands are carried
  /// out in order, between two steps.
  bool send(const TwinCommand& command);
  /// Commands sent and carried out. A kStep counts when its last step is done.
  std::uint64_t sent() const { return sent_; }
  std::uint64_t carriedOut() const { return carried_out_.load(std::memory_order_acquire); }
  /// Of the last command carried out; read it while no other is under way.
  TwinAnswer answer() const { return answer_; }
  bool paused() const { return paused_.load(std::memory_order_relaxed); }

  // One other thread: records, in order.
  bool pop(double* record) noexcept { return ring_.pop(record); }
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }

 private:
  void carryOut(const TwinCommand& command) noexcept;
  void finish(bool done, double duration) noexcept;
  void publish(std::int64_t scheduled) noexcept;

  Twin twin_;
  RecordRing ring_;
  std::vector<double> record_;
  boost::lockfree::spsc_queue<TwinCommand, boost::lockfree::capacity<64>> commands_;
  std::uint64_t sent_ = 0;
  std::atomic<std::uint64_t> carried_out_{0};
  std::atomic<bool> paused_{false};
  TwinAnswer answer_;
  std::uint64_t steps_to_do_ = 0;  ///< of a kStep under way
  bool at_start_ = true;           ///< the state at step 0 has not been published
};

}  // namespace whirl_twin
