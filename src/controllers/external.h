// A controller in another process: samples go out, commands come in, each the answer to a sample.
//
// Free-running, what acts is the newest command that has come. In lockstep the output of a sample
// is its answer, and simulated time waits for it: not before the first answer of all, and not after
// none has come for `timeout` of wall time, until one comes again.
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

// Between the real-time loop and the thread that talks to a controller in another process: samples
// out, commands in, through rings without a lock.

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

class ExternalController final : public Controller {
 public:
  /// What becomes of it after the time-out: it gives what it gave last, or 0, or what it acts on
  /// stops.
  enum class OnTimeout { kHold, kZero, kStop };
  struct Rules {
    bool lockstep = false;
    std::int64_t timeout = 0;  ///< [ns]
    OnTimeout on_timeout = OnTimeout::kHold;
  };
  static constexpr std::int64_t kNoAge = -1;

  ExternalController(const Rules& rules, std::size_t measured, std::size_t outputs);

  const Rules& rules() const { return rules_; }
  /// For the thread that talks to the other process; lives as long as the controller.
  ExternalLink& link() const { return *link_; }
  /// Answers to so many samples are kept.
  void keep(std::size_t samples);

  // Real-time safe.

  void reset() noexcept override;
  /// Put back, it is yet to hear of the other process, in a run of its own.
  void exchange(StateImage& image) noexcept override;
  /// Tells the sample. Free-running it gives the newest command; in lockstep nothing.
  void update(const ControlSample& sample, double* outputs) noexcept override;
  /// No answer within the time-out, and none since.
  bool lost() const noexcept { return lost_; }
  /// It is, and gives 0 then, or stops what it acts on.
  bool givesNothing() const noexcept { return lost_ && rules_.on_timeout == OnTimeout::kZero; }
  bool stops() const noexcept { return lost_ && rules_.on_timeout == OnTimeout::kStop; }
  /// [samples], of the newest command at the newest sample; kNoAge: none has come.
  std::int64_t age() const noexcept { return heard_ == kNone ? kNoAge : told_ - heard_; }

  /// age() [samples] at each sample since the start, from the first command on. Any thread.
  const TimingHistogram& ages() const noexcept { return ages_; }

  // Of lockstep.

  /// Takes the answers that have come.
  void listen() noexcept;
  /// nullptr: there is none.
  const double* answer(std::int64_t sample) const noexcept;
  /// Simulated time is to wait for the answer to a sample.
  bool isAwaited(std::int64_t sample) const noexcept;
  /// There is something to wait for, and `elapsed` [ns] have gone since this was said last. True
  /// once it has lasted too long: the controller is lost.
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
  ExternalSample command_;       // room for one
  std::vector<double> newest_;   // free-running: what acts
  std::vector<double> answers_;  // lockstep
  std::vector<std::int64_t> answered_;
  std::int64_t run_ = 0;
  std::int64_t told_ = 0;              // newest sample
  std::int64_t heard_ = kNone;         // newest sample that was answered in this run
  std::int64_t awaited_from_ = kNone;  // lockstep: the first to wait for; kNone: not at present
  bool connected_ = false;             // something has come since it was lost, or the start
  bool lost_ = false;
  bool waiting_ = false;
  TimingHistogram ages_;
  std::int64_t waited_ = 0;    // [ns]
  std::int64_t heard_at_ = 0;  // [ns], simulated
};

}  // namespace whirl_twin
