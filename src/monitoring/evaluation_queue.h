// Evaluates the stability of systems on request: at once, or concurrently in threads of its own, so
// that no alarm waits behind an evaluation that takes long. There the newest request for a system
// replaces one that is still pending, and all systems have their turn: however slow it is, a
// verdict is about the newest state there was when it was started. A verdict takes well below a
// millisecond for a few coordinates, the critical and threshold speeds of new parameters, or
// margins of a loop, a hundred times that: there it goes first, without them, and comes again with
// them.
//
// A system whose evaluation throws is uncertain, with the reason, and is evaluated again ten
// seconds later or with other parameters; the others are evaluated as if it were not there. So is
// one whose evaluation takes longer than kMaxEvaluation: as soon as one takes longer than
// others are to wait, a further thread continues with those, and no thread is ever ended from
// outside.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "analysis/validity.h"
#include "monitoring/parameter_margins.h"
#include "monitoring/stability_evaluator.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct EvaluationRequest {
  std::size_t system = 0;  ///< its place
  SharedSystem built;      ///< with its parameters as they are
  state::Instant at;
  std::vector<double> q, v;
  double speed = 0.0;       ///< [rad/s], of its shaft
  std::uint64_t run = 0;    ///< of simulated time: comes back with the verdict
  double arrived_at = 0.0;  ///< [s], wall time of the state, likewise
  /// The loop that controllers close around it, with their parameters as they are; nullptr: none.
  std::shared_ptr<const ClosedLoop> loop = nullptr;
  SystemMotions beside = nullptr;  ///< the other systems of that loop, as they came last
  double acceleration = 0.0;       ///< [rad/s^2], of its shaft
};

struct StabilityResult {
  EvaluationRequest request;
  state::StabilityMargin margin;               ///< age: wall time since it was asked for
  std::optional<SteadyMotion> motion;          ///< that it is about
  double speed = 0.0;                          ///< [rad/s]
  std::optional<CharacteristicSpeeds> speeds;  ///< not of a verdict that went before them
  std::vector<state::ControllerMargins> loop;  ///< of the controllers of its loop
  std::string failure;  ///< why it cannot be evaluated, and is uncertain; "": it can
};

/// [s] of an evaluation, after which its system is uncertain. It counts while the monitor runs:
/// the time that a process was stopped for is not part of it.
constexpr double kMaxEvaluation = 5.0;

class EvaluationQueue {
 public:
  enum class Mode { kAtOnce, kConcurrent };

  /// loops: of the controllers around each system, nullptr where there are none; empty: no system
  /// has any.
  EvaluationQueue(const std::vector<SharedSystem>& systems, Mode mode,
                  std::vector<std::shared_ptr<const ClosedLoop>> loops = {});
  ~EvaluationQueue();
  EvaluationQueue(const EvaluationQueue&) = delete;
  EvaluationQueue& operator=(const EvaluationQueue&) = delete;

  /// Those of a system's first parameters, before any request.
  const CharacteristicSpeeds& speedsOf(std::size_t system) const { return first_speeds_[system]; }
  void add(EvaluationRequest request);
  /// Results since last asked, in order.
  std::vector<StabilityResult> take();
  /// There is a request without a result.
  bool pending();
  /// [s], wall time that evaluating has taken so far.
  double busy();

 private:
  /// What is known of a system between evaluations; one thread has it at a time.
  struct Slot {
    SharedSystem built;
    std::shared_ptr<const ClosedLoop> loop;
    std::unique_ptr<StabilityEvaluator> evaluator = nullptr;  ///< nullptr: it could not be made
    std::string failure = {};                                 ///< of the last evaluation
    double failed_at = 0.0;                                   ///< [s], simulated
  };
  struct Pending {
    EvaluationRequest request;
    double since;           ///< [s], of a clock that only goes forward
    bool complete = false;  ///< the verdict alone has been given
  };
  /// One that is being made.
  struct Evaluation {
    std::size_t system;
    std::shared_ptr<Slot> slot;
    std::optional<Pending> of;  ///< none: speeds of the first parameters
    double taken = 0.0;         ///< [s]
    bool left = false;          ///< no result is expected from it any more
  };
  /// Shared by the threads, also with one that is still busy when the queue is gone.
  struct Shared {
    std::mutex mutex;  ///< what follows
    std::condition_variable requested, finished;
    std::vector<std::shared_ptr<Slot>> slots;
    std::vector<CharacteristicSpeeds> first_speeds;
    std::vector<std::size_t> to_prepare;          ///< systems whose first speeds are to be found
    std::vector<std::optional<Pending>> waiting;  ///< of each system
    std::vector<std::shared_ptr<Evaluation>> running;
    std::vector<StabilityResult> done;
    std::size_t threads = 0;
    std::size_t turn = 0;
    double busy = 0.0;  ///< [s]
    bool ending = false;

    bool isBusy(std::size_t system) const;
    std::shared_ptr<Evaluation> next();
    void finish(const Evaluation& made, StabilityResult result);
  };

  /// complete: with what takes long. Throws nothing that an evaluation throws.
  static StabilityResult makeResult(Slot& slot, const Pending& waiting, bool complete);
  /// Puts verdict, speeds and margins into a result.
  static void evaluate(Slot& slot, const Pending& waiting, bool complete, StabilityResult& result);
  static CharacteristicSpeeds firstSpeeds(Slot& slot);
  static StabilityResult uncertain(const Pending& waiting, const std::string& why);
  static void startThread(const std::shared_ptr<Shared>& shared);
  static void run(const std::shared_ptr<Shared>& shared);
  /// Systems whose evaluation takes too long are uncertain, and others do not wait for it. `Shared`
  /// is locked.
  void checkTimeouts();

  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::vector<CharacteristicSpeeds> first_speeds_;
  bool concurrent_;
  double checked_at_;  ///< [s]
};

/// Searches for margins that take long and that no verdict waits for: the critical parameter, for
/// systems that are quick to search (isQuickToSearch), the cross-coupling that a rotor bears, the
/// stability within the tolerances of its parameters, and the amplitude up to which the decrement
/// holds. Concurrently in a thread of the lowest priority; or at once, where evaluations are.
class StabilityBoundarySearch {
 public:
  StabilityBoundarySearch(std::size_t systems, EvaluationQueue::Mode mode);
  ~StabilityBoundarySearch();
  StabilityBoundarySearch(const StabilityBoundarySearch&) = delete;
  StabilityBoundarySearch& operator=(const StabilityBoundarySearch&) = delete;

  /// Adds what was found of its system, with its parameters, to a result. The search is repeated
  /// where the parameters have changed; of a linear system where its speed has by a hundredth, a
  /// second [simulated] apart at least; of any other every ten seconds. Samples are unstable that
  /// decay slower than `slowest` [1/s].
  void addTo(StabilityResult& result, double slowest);

 private:
  struct Question {
    SharedSystem built;
    SteadyMotion motion;
    double speed = 0.0;  ///< [rad/s]
    double time = 0.0;   ///< [s], simulated
  };
  struct Answer {
    Question of;
    std::optional<ParameterMargin> nearest;
    std::optional<double> cross_coupling;  ///< [N/m]
    std::optional<RobustStabilityMargin> spread;
    std::optional<LinearDampingLimit> decrement;
  };
  struct Slot {
    std::optional<Question> searched;  ///< last
    std::optional<Question> pending;
    std::optional<Answer> answer;
  };

  static bool isNews(const std::optional<Question>& searched, const Question& now);
  std::optional<Answer> search(const Question& question) const;
  void run();

  std::mutex mutex_;  ///< of slots_, and of `ending_` where a thread waits for it
  std::condition_variable requested_;
  std::vector<Slot> slots_;
  std::size_t turn_ = 0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
