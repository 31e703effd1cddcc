// A controller in another process: samples are sent, commands are received, each the answer to a
// sample.
//
// Free-running, the newest command received is applied. In lockstep the output of a sample is its
// answer, and simulated time waits for it: except before the very first answer, and after a
// `timeout` of wall time without one, until the next arrives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "controllers/controller.h"
#include "controllers/controller_info.h"
#include "realtime/record_ring.h"
#include "realtime/timing_histogram.h"

namespace whirl_twin {

// Link between the real-time loop and the thread that communicates with a controller in another
// process: samples out, commands in, through lock-free rings.

/// A sample that is sent, or the command that answers it.
struct ExternalSample {
  std::int64_t run = 0;     ///< number of the run of simulated time: changes at each reset
  std::int64_t sample = 0;  ///< its index
  double time = 0.0;        ///< [s], simulated, of the sample
  std::vector<double> values;
};

class ExternalLink {
 public:
  ExternalLink(std::size_t measured, std::size_t outputs);

  std::size_t measured() const { return sent_.recordSize() - kValues; }
  std::size_t outputs() const { return received_.recordSize() - kValues; }

  // The loop; real-time safe. `values` of the sample in and out is never resized.

  /// Samples that do not fit into the queue are lost.
  void tell(std::int64_t run, std::int64_t sample, double time, const double* values) noexcept;
  /// The oldest pending command, into one with as many values as outputs(); false: none.
  bool hear(ExternalSample& command) noexcept;

  // One other thread.

  /// The oldest pending sample; false: none.
  bool take(ExternalSample& sample);
  /// Passes a command to the loop. False for one of wrong length, or if the queue is full.
  bool answer(const ExternalSample& command);

 private:
  enum { kRun, kSample, kTime, kValues };
  static bool pop(RecordRing& ring, std::vector<double>& record, ExternalSample& out) noexcept;

  RecordRing sent_, received_;
  std::vector<double> sending_, hearing_;      // the loop's
  std::vector<double> receiving_, answering_;  // the other thread's
};

class ExternalController final : public Controller {
 public:
  /// Fallback after the time-out: hold the last output, output 0, or stop the systems acted on.
  enum class OnTimeout { kHold, kZero, kStop };
  struct Rules {
    bool lockstep = false;
    std::int64_t timeout = 0;  ///< [ns]
    OnTimeout on_timeout = OnTimeout::kHold;
  };
  static constexpr std::int64_t kNoAge = -1;

  ExternalController(const Rules& rules, std::size_t measured, std::size_t outputs);

  const Rules& rules() const { return rules_; }
  /// For the thread that communicates with the other process; lives as long as the controller.
  ExternalLink& link() const { return *link_; }
  /// Number of answers that are stored.
  void keep(std::size_t samples);

  // Real-time safe.

  void reset() noexcept override;
  /// After restoration it waits for the other process, in a new run.
  void exchange(StateImage& image) noexcept override;
  /// Sends the sample. Free-running it outputs the newest command; in lockstep nothing.
  void update(const ControlSample& sample, double* outputs) noexcept override;
  /// The time-out has expired without an answer since.
  bool lost() const noexcept { return lost_; }
  /// Lost, with output 0.
  bool givesNothing() const noexcept { return lost_ && rules_.on_timeout == OnTimeout::kZero; }
  bool stops() const noexcept { return lost_ && rules_.on_timeout == OnTimeout::kStop; }
  /// [samples], of the newest command relative to the newest sample; kNoAge: none received.
  std::int64_t age() const noexcept { return received_ == kNone ? kNoAge : sent_ - received_; }

  /// age() [samples] at each sample since the start, from the first command on. Any thread.
  const TimingHistogram& ages() const noexcept { return ages_; }

  // Of lockstep.

  /// Processes the answers received.
  void listen() noexcept;
  /// nullptr: there is none.
  const double* answer(std::int64_t sample) const noexcept;
  /// Must simulated time wait for the answer to a sample?
  bool isAwaited(std::int64_t sample) const noexcept;
  /// An answer is outstanding, and `elapsed` [ns] have passed since the previous call. True once
  /// the time-out is exceeded: the controller is lost.
  bool waitsTooLong(std::int64_t elapsed) noexcept;
  void waitsNoMore() noexcept { waiting_ = false; }

  // Not real-time safe.

  std::optional<DiscreteStateSpace> linear(double) const override { return std::nullopt; }

 private:
  static constexpr std::int64_t kNone = INT64_MIN;

  std::size_t placeOf(std::int64_t sample) const noexcept {
    const auto places = static_cast<std::int64_t>(answered_.size());
    return static_cast<std::size_t>((sample % places + places) % places);
  }
  bool take(const ExternalSample& command) noexcept;
  void giveNewest(std::int64_t time, double* outputs) noexcept;

  Rules rules_;
  std::unique_ptr<ExternalLink> link_;
  ExternalSample command_;       // preallocated
  std::vector<double> newest_;   // free-running: what acts
  std::vector<double> answers_;  // lockstep
  std::vector<std::int64_t> answered_;
  std::int64_t run_ = 0;
  std::int64_t sent_ = 0;              // newest sample
  std::int64_t received_ = kNone;      // newest sample that was answered in this run
  std::int64_t awaited_from_ = kNone;  // lockstep: the first awaited sample; kNone: none at present
  bool connected_ = false;             // a command was received since the loss, or the start
  bool lost_ = false;
  bool waiting_ = false;
  TimingHistogram ages_;
  std::int64_t waited_ = 0;    // [ns]
  std::int64_t heard_at_ = 0;  // [ns], simulated
};

}  // namespace whirl_twin
