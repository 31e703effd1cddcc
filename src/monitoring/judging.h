// Judges systems when asked: at once, or in a thread of its own beside those who ask, so that no
// alarm waits behind a judgement that takes long. There the newest question about a system replaces
// one that still waits, and all systems have their turn: however slow it is, a verdict is about
// the newest state there was when it was begun. A verdict takes well below a millisecond for a few
// coordinates, the critical and threshold speeds of new parameters, or margins of a loop, a hundred
// times that: there it goes first, without them, and comes again with them.
//
// A system whose evaluation throws is uncertain, with the reason, and is evaluated again ten
// seconds later or with other parameters; the others are judged as if it were not there. So is one
// whose evaluation takes longer than kLongestEvaluation: as soon as one takes longer than others
// are to wait, another thread goes on with those, and no thread is ever ended from outside.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "monitoring/system_judge.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct JudgementRequest {
  std::size_t system = 0;  ///< its place
  SharedSystem built;      ///< with its parameters as they are
  state::Instant at;
  std::vector<double> q, v;
  double speed = 0.0;       ///< [rad/s], of its shaft
  std::uint64_t run = 0;    ///< of simulated time: comes back with the verdict
  double arrived_at = 0.0;  ///< [s], wall time of the state, likewise
  /// What its controllers close around it, with their parameters as they are; nullptr: none do.
  std::shared_ptr<const ClosedLoop> loop = nullptr;
  SystemMotions beside = nullptr;  ///< the other systems of that loop, as they came last
  double acceleration = 0.0;       ///< [rad/s^2], of its shaft
};

struct Judgement {
  std::size_t system = 0;
  std::uint64_t run = 0;
  double arrived_at = 0.0;
  SharedSystem built;
  state::StabilityMargin margin;               ///< age: wall time since it was asked for
  std::optional<SteadyMotion> motion;          ///< that it is about
  double speed = 0.0;                          ///< [rad/s]
  std::optional<JudgedSpeeds> speeds;          ///< not of a verdict that went before them
  bool of_loop = false;                        ///< a system with its controllers
  std::vector<state::ControllerMargins> loop;  ///< of them
  std::string failure;  ///< why it cannot be evaluated, and is uncertain; "": it can
};

/// [s] of an evaluation, after which its system is uncertain. It counts while the monitor runs:
/// what a process was stopped for is not its evaluation's.
constexpr double kLongestEvaluation = 5.0;

class Judging {
 public:
  enum class Mode { kAtOnce, kBeside };

  /// loops: what controllers close around each system, nullptr where there are none; empty: no
  /// system has any.
  Judging(const std::vector<SharedSystem>& systems, Mode mode,
          std::vector<std::shared_ptr<const ClosedLoop>> loops = {});
  ~Judging();
  Judging(const Judging&) = delete;
  Judging& operator=(const Judging&) = delete;

  /// Those of a system's first parameters, before anything is asked.
  const JudgedSpeeds& speedsOf(std::size_t system) const { return first_speeds_[system]; }
  void ask(JudgementRequest request);
  /// What has been judged since last asked, in order.
  std::vector<Judgement> take();
  /// Somebody has asked and not been answered yet.
  bool pending();
  /// [s], wall time that judging has taken so far.
  double busy();

 private:
  /// What is known of a system between evaluations; one thread has it at a time.
  struct Seat {
    SharedSystem built;
    std::shared_ptr<const ClosedLoop> loop;
    std::unique_ptr<SystemJudge> judge = nullptr;  ///< nullptr: it could not be made
    std::string failure = {};                      ///< of the last evaluation
    double failed_at = 0.0;                        ///< [s], simulated
  };
  struct Waiting {
    JudgementRequest request;
    double since;           ///< [s], of a clock that only goes forward
    bool complete = false;  ///< the verdict alone has been given
  };
  /// One that is being made.
  struct Evaluation {
    std::size_t system;
    std::shared_ptr<Seat> seat;
    std::optional<Waiting> of;  ///< none: speeds of the first parameters
    double taken = 0.0;         ///< [s]
    bool left = false;          ///< nobody waits for it any more
  };
  /// What the threads share, also with one that is still busy when nobody else is there.
  struct Desk {
    std::mutex mutex;  ///< what follows
    std::condition_variable asked, answered;
    std::vector<std::shared_ptr<Seat>> seats;
    std::vector<JudgedSpeeds> first_speeds;
    std::vector<std::size_t> to_prepare;  ///< systems whose first speeds are to be looked for
    std::vector<std::optional<Waiting>> waiting;  ///< of each system
    std::vector<std::shared_ptr<Evaluation>> running;
    std::vector<Judgement> done;
    std::size_t threads = 0;
    std::size_t turn = 0;
    double busy = 0.0;  ///< [s]
    bool ending = false;

    bool isBusy(std::size_t system) const;
    std::shared_ptr<Evaluation> next();
    void finish(const Evaluation& made, Judgement judgement);
  };

  /// complete: with what takes long. Throws nothing that an evaluation throws.
  static Judgement judge(Seat& seat, const Waiting& waiting, bool complete);
  /// Puts verdict, speeds and margins into a judgement.
  static void evaluate(Seat& seat, const Waiting& waiting, bool complete, Judgement& judgement);
  static JudgedSpeeds firstSpeeds(Seat& seat);
  static Judgement uncertain(const Waiting& waiting, const std::string& why);
  static void startThread(const std::shared_ptr<Desk>& desk);
  static void run(const std::shared_ptr<Desk>& desk);
  /// Time has passed: whoever takes too long is uncertain, and others do not wait for it. The desk
  /// is locked.
  void watch();

  std::shared_ptr<Desk> desk_ = std::make_shared<Desk>();
  std::vector<JudgedSpeeds> first_speeds_;
  bool beside_;
  double watched_at_;  ///< [s]
};

}  // namespace whirl_twin
