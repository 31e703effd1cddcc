// The twin as a fixed-rate loop runs it: one cycle a period, commands in, records out. No thread of
// its own, no lock, no allocation in a cycle.
//
// What goes as fast as it goes (the factor 0, and the steps of a command in a pause) takes most of
// a period, and waits while more than an eighth of the ring waits for its reader: nothing of it is
// lost. Nor is anything where a gate lets it step only so far (twin/lockstep.h).
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "realtime/record_ring.h"
#include "realtime/step_gate.h"
#include "twin/ensemble_observer.h"
#include "twin/system_generations.h"
#include "twin/twin.h"

namespace whirl_twin {

// How fast simulated time goes beside wall time: which steps are due in a period of the loop.
//
// At a factor of 1 one step is; below, a step in some of the periods, evenly; above, several in
// each. The loop itself keeps its rate, so that commands, and its statistics, are what they are at
// any factor. As fast as it goes: as many as there is time and room for.

class Pace {
 public:
  static constexpr double kSlowest = 0.01;
  static constexpr double kFastest = 1000.0;
  static constexpr double kAsFastAsItGoes = 0.0;

  /// The real-time factor [-], simulated seconds in one of wall time.
  static bool canBe(double factor) {
    return factor == kAsFastAsItGoes || (factor >= kSlowest && factor <= kFastest);
  }

  // Any thread.
  void set(double factor) noexcept { factor_.store(factor, std::memory_order_relaxed); }
  double factor() const noexcept { return factor_.load(std::memory_order_relaxed); }

  // The loop's thread. Real-time safe.

  /// Whole steps that are due in the period that begins; not to be asked as fast as it goes.
  std::int64_t due() noexcept {
    owed_ += factor();
    const double whole = std::floor(owed_ + kRounding);
    owed_ -= whole;
    return static_cast<std::int64_t>(whole);
  }

 private:
  static constexpr double kRounding = 1.0e-9;  ///< ten tenths are a whole

  std::atomic<double> factor_{1.0};
  double owed_ = 0.0;  ///< [steps]
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
  std::uint64_t steps = 0;        ///< kStep: how many
  std::size_t drive = 0;          ///< kSetSpeed, kLook: of twin().drive()
  double speed = 0.0;             ///< [rad/s]
  double max_acceleration = 0.0;  ///< [rad/s^2]
  double max_jerk = 0.0;          ///< [rad/s^3]; 0: unlimited
  std::size_t system = 0;         ///< kSetInput; kReplace, which replace() makes
  std::size_t input = 0;          ///< kSetInput: of the system's dynamics
  double value = 0.0;             ///< in the input's unit
  std::int64_t duration = 0;      ///< [ns], simulated, until its own value returns
  Stepper* replacement = nullptr;
  std::int64_t generation = 0;
  std::size_t controller = 0;  ///< kReplaceLaw, which replaceLaw() makes
  Controller* law = nullptr;
  StateImage* image = nullptr;  ///< kSave: that takes the twin's state; outlives the command
};

/// What became of a command.
struct TwinAnswer {
  bool done = false;
  std::int64_t step = 0;      ///< the step reached
  double duration = 0.0;      ///< [s], kSetSpeed: of the move
  double speed = 0.0;         ///< [rad/s], kLook: of the drive now,
  double acceleration = 0.0;  ///< [rad/s^2],
  double target_speed = 0.0;  ///< [rad/s], and where its move ends
};

class LiveTwin {
 public:
  /// Up to ring_capacity records wait for their reader; more are dropped and counted.
  LiveTwin(const Scene& scene, std::size_t ring_capacity);
  ~LiveTwin();
  LiveTwin(const LiveTwin&) = delete;
  LiveTwin& operator=(const LiveTwin&) = delete;

  /// Of the twin only what does not change while it runs may be used while the loop runs.
  const Twin& twin() const { return twin_; }
  /// Before the loop runs, and after: all of it.
  Twin& atRest() { return twin_; }
  /// Before it runs: it has been put back to where it stands now, in a pause or not.
  void putBack(bool paused) noexcept;

  /// The loop's thread, once a period; scheduled [ns] goes into the record, and where there are
  /// several they stand evenly in the period. Real-time safe.
  bool cycle(std::int64_t scheduled) noexcept;

  // One other thread: commands.

  /// Hands a command over; false if the loop is far behind with earlier ones. Commands are carried
  /// out in order, between two steps.
  bool send(const TwinCommand& command);
  /// Has a system replaced between two steps, with its coordinates and rates as they are; records
  /// carry the generation from then on, and one of the step reached is made at once. False, with
  /// `next` left alone, while another command is under way.
  bool replace(std::size_t system, std::unique_ptr<Stepper>& next, std::int64_t generation);
  /// The same for the law of a controller, which takes over from the one before.
  bool replaceLaw(std::size_t controller, std::unique_ptr<Controller>& next,
                  std::int64_t generation);
  /// Commands sent and carried out. A kStep counts when its last step is done.
  std::uint64_t sent() const { return sent_; }
  std::uint64_t carriedOut() const { return carried_out_.load(std::memory_order_acquire); }
  /// Of the last command carried out; read it while no other is under way.
  TwinAnswer answer() const { return answer_; }
  bool paused() const { return paused_.load(std::memory_order_relaxed); }

  // Any thread.

  /// Stands still from the next cycle on, ahead of the commands that wait; a kStep under way ends
  /// there, as one that is not done.
  void pause() noexcept { pause_asked_.store(true, std::memory_order_relaxed); }
  /// Asked to, and not yet done.
  bool pausing() const noexcept { return pause_asked_.load(std::memory_order_acquire); }
  /// The real-time factor, that Pace::canBe(); of commands it is independent.
  void setPace(double factor) noexcept { pace_.set(factor); }
  double pace() const noexcept { return pace_.factor(); }
  /// How far it may step.
  StepGate& gate() noexcept { return gate_; }
  /// What its parts take of a step.
  const StepTimes& stepTimes() const noexcept { return times_; }
  void resetStepTimes() noexcept { times_.reset(); }
  /// Resets carried out.
  std::uint64_t resets() const { return resets_.load(std::memory_order_relaxed); }
  /// The step reached.
  std::int64_t stepCount() const { return step_.load(std::memory_order_relaxed); }
  /// What the records' generations stand for.
  const std::shared_ptr<SystemGenerations>& generations() const { return generations_; }

  // One other thread: records, in order.
  bool pop(double* record) noexcept { return ring_.pop(record); }
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }
  /// Those that wait, and how many there is room for.
  std::size_t waiting() const noexcept { return ring_.waiting(); }
  std::size_t ringCapacity() const noexcept { return ring_.capacity(); }
  /// The statistics of its ensembles, for the thread of the records; the twin outlives it.
  EnsembleObserver ensembles() { return EnsembleObserver(twin_); }

 private:
  void carryOutCommands() noexcept;
  void pauseNow() noexcept;
  bool holds() const noexcept;
  bool goOn(std::int64_t scheduled) noexcept;
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
  std::unique_ptr<Stepper> retired_;         ///< by the last kReplace; deleted outside of the loop
  std::unique_ptr<Controller> retired_law_;  ///< likewise, kReplaceLaw
  std::uint64_t steps_to_do_ = 0;            ///< of a kStep under way
  Pace pace_;
  StepGate gate_;
  StepTimes times_;
  std::int64_t asked_ = 0;  ///< [ns], the twin last whether it may step
  bool at_start_ = true;    ///< the state at step 0 has not been published
};

}  // namespace whirl_twin
