// The twin as run by a fixed-rate loop: one cycle per period, with a command queue in and a record
// queue out. No own thread, no lock, no allocation in a cycle.
//
// Stepping as fast as possible (factor 0, and kStep commands during a pause) uses most of a period,
// and waits while more than an eighth of the ring waits for its reader: no record is lost. Nor is
// any if a step barrier limits the steps (twin/lockstep.h).
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "realtime/record_ring.h"
#include "realtime/step_barrier.h"
#include "twin/ensemble_observer.h"
#include "twin/system_generations.h"
#include "twin/twin.h"

namespace whirl_twin {

// Real-time factor: number of steps due in a period of the loop.
//
// At a factor of 1 one step per period is due; below, a step in some of the periods, evenly
// distributed; above, several per period. The loop keeps its rate, so that commands and its
// statistics are independent of the factor. As fast as possible: as many steps as time and the ring
// allow.

class Pace {
 public:
  static constexpr double kSlowest = 0.01;
  static constexpr double kFastest = 1000.0;
  static constexpr double kAsFastAsItGoes = 0.0;

  /// The real-time factor [-]: simulated time over wall time.
  static bool canBe(double factor) {
    return factor == kAsFastAsItGoes || (factor >= kSlowest && factor <= kFastest);
  }

  // Any thread.
  void set(double factor) noexcept { factor_.store(factor, std::memory_order_relaxed); }
  double factor() const noexcept { return factor_.load(std::memory_order_relaxed); }

  // The loop's thread. Real-time safe.

  /// Whole steps due in the current period; not for stepping as fast as possible.
  std::int64_t due() noexcept {
    owed_ += factor();
    const double whole = std::floor(owed_ + kRounding);
    owed_ -= whole;
    return static_cast<std::int64_t>(whole);
  }

 private:
  static constexpr double kRounding = 1.0e-9;  ///< ten times 0.1 is 1

  std::atomic<double> factor_{1.0};
  double owed_ = 0.0;  ///< [steps], fraction carried over
};

/// A command from outside the loop.
struct TwinCommand {
  enum class Kind : std::uint8_t {
    kResume,
    kReset,
    kStep,
    kSetSpeed,
    kSetInput,
    kLook,
    kReplace,
    kReplaceLaw,
    kSave
  };
  Kind kind = Kind::kResume;
  std::uint64_t steps = 0;        ///< kStep: number of steps
  std::size_t drive = 0;          ///< kSetSpeed, kLook: of twin().drive()
  double speed = 0.0;             ///< [rad/s]
  double max_acceleration = 0.0;  ///< [rad/s^2]
  double max_jerk = 0.0;          ///< [rad/s^3]; 0: unlimited
  std::size_t system = 0;         ///< kSetInput; kReplace, sent by replace()
  std::size_t input = 0;          ///< kSetInput: of the system's dynamics
  double value = 0.0;             ///< in the input's unit
  std::int64_t duration = 0;      ///< [ns], simulated; then the input returns to its own value
  Stepper* replacement = nullptr;
  std::int64_t generation = 0;
  std::size_t controller = 0;  ///< kReplaceLaw, sent by replaceLaw()
  Controller* law = nullptr;
  StateImage* image = nullptr;  ///< kSave: receives the twin's state; must outlive the command
};

/// Result of a command.
struct TwinAnswer {
  bool done = false;
  std::int64_t step = 0;      ///< current step
  double duration = 0.0;      ///< [s], kSetSpeed: of the move
  double speed = 0.0;         ///< [rad/s], kLook: current value of the drive
  double acceleration = 0.0;  ///< [rad/s^2],
  double target_speed = 0.0;  ///< [rad/s], final speed of its move
};

class LiveTwin {
 public:
  /// Up to ring_capacity records are queued for their reader; further ones are dropped and counted.
  LiveTwin(const Scene& scene, std::size_t ring_capacity);
  ~LiveTwin();
  LiveTwin(const LiveTwin&) = delete;
  LiveTwin& operator=(const LiveTwin&) = delete;

  /// While the loop runs, only the constant members of the twin may be used.
  const Twin& twin() const { return twin_; }
  /// Full access, before the loop runs and after it.
  Twin& atRest() { return twin_; }
  /// Before the loop runs: the twin has been restored to its current state, paused or not.
  void restore(bool paused) noexcept;

  /// Called by the loop's thread, once a period; scheduled [ns] is written into the record; several
  /// steps are distributed evenly over the period. Real-time safe.
  bool cycle(std::int64_t scheduled) noexcept;

  // Commands: from one other thread.

  /// Queues a command; false if the queue is full. Commands are executed in order, between two
  /// steps.
  bool send(const TwinCommand& command);
  /// Replaces a system between two steps, with unchanged coordinates and rates; later records have
  /// this generation, and a record of the current step is published at once. False, leaving `next`
  /// unchanged, while another command is under way.
  bool replace(std::size_t system, std::unique_ptr<Stepper>& next, std::int64_t generation);
  /// Likewise for the control law of a controller, by bumpless transfer.
  bool replaceLaw(std::size_t controller, std::unique_ptr<Controller>& next,
                  std::int64_t generation);
  /// Commands sent and executed. A kStep counts when its last step is done.
  std::uint64_t sent() const { return sent_; }
  std::uint64_t carriedOut() const { return carried_out_.load(std::memory_order_acquire); }
  /// Result of the last executed command; read it only while no other one is under way.
  TwinAnswer answer() const { return answer_; }
  bool paused() const { return paused_.load(std::memory_order_relaxed); }

  // From any thread.

  /// Pauses from the next cycle on, before queued commands; a kStep under way is aborted, and is
  /// not done.
  void pause() noexcept { pause_asked_.store(true, std::memory_order_relaxed); }
  /// A pause is requested and not yet in effect.
  bool pausing() const noexcept { return pause_asked_.load(std::memory_order_acquire); }
  /// Sets the real-time factor, see Pace::canBe(); independent of commands.
  void setPace(double factor) noexcept { pace_.set(factor); }
  double pace() const noexcept { return pace_.factor(); }
  /// Limits the steps.
  StepBarrier& gate() noexcept { return gate_; }
  /// Computing times of its parts.
  const StepTimes& stepTimes() const noexcept { return times_; }
  void resetStepTimes() noexcept { times_.reset(); }
  /// Number of executed resets.
  std::uint64_t resets() const { return resets_.load(std::memory_order_relaxed); }
  /// The current step.
  std::int64_t stepCount() const { return step_.load(std::memory_order_relaxed); }
  /// The generations that records refer to.
  const std::shared_ptr<SystemGenerations>& generations() const { return generations_; }

  // Records: one other thread, in order.
  bool pop(double* record) noexcept { return ring_.pop(record); }
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }
  /// Number of queued records, and capacity of the queue.
  std::size_t waiting() const noexcept { return ring_.waiting(); }
  std::size_t ringCapacity() const noexcept { return ring_.capacity(); }
  /// Statistics of its ensembles, for the thread of the records; the twin must outlive it.
  EnsembleObserver ensembles() { return EnsembleObserver(twin_); }

 private:
  void carryOutCommands() noexcept;
  void pauseNow() noexcept;
  bool holds() const noexcept;
  bool resume(std::int64_t scheduled) noexcept;
  bool mayStep(std::int64_t now, std::int64_t end) noexcept;
  bool hasRoom() const noexcept { return ring_.hasRoomFor(7 * ring_.capacity() / 8); }
  void step(std::int64_t scheduled, bool several) noexcept;
  void stepWhileThereIsTime(std::int64_t scheduled) noexcept;
  void carryOut(const TwinCommand& command) noexcept;
  void look(std::size_t drive) noexcept;
  void replaceNow(const TwinCommand& command) noexcept;
  void replaceLawNow(const TwinCommand& command) noexcept;
  void save(StateImage& image) noexcept;
  void tellChange() noexcept;
  void finish(bool done, double duration) noexcept;
  void publish(std::int64_t scheduled) noexcept;

  Twin twin_;
  std::shared_ptr<SystemGenerations> generations_;
  RecordRing ring_;
  std::vector<double> record_;
  boost::lockfree::spsc_queue<TwinCommand, boost::lockfree::capacity<64>> commands_;
  std::uint64_t sent_ = 0;
  std::atomic<std::uint64_t> carried_out_{0};
  std::atomic<bool> pause_asked_{false};
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> step_{0};
  std::atomic<std::uint64_t> resets_{0};
  TwinAnswer answer_;
  std::unique_ptr<Stepper> retired_;         ///< from the last kReplace; deleted outside the loop
  std::unique_ptr<Controller> retired_law_;  ///< likewise, kReplaceLaw
  std::uint64_t steps_to_do_ = 0;            ///< of the kStep under way
  Pace pace_;
  StepBarrier gate_;
  StepTimes times_;
  std::int64_t asked_ = 0;  ///< [ns], last call of Twin::mayStep()
  bool at_start_ = true;    ///< the state at step 0 has not been published
};

}  // namespace whirl_twin
