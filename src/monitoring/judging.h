// Judges systems when asked: at once, or in a thread of its own beside those who ask, so that no
// alarm waits behind a judgement that takes long. There the newest question about a system replaces
// one that still waits, and all systems have their turn: however slow it is, a verdict is about
// the newest state there was when it was begun. A verdict takes well below a millisecond for a few
// coordinates, the critical and threshold speeds of new parameters, or margins of a loop, a hundred
// times that: there it goes first, without them, and comes again with them.
//
// A system whose evaluation throws is uncertain, with the reason, and is evaluated again ten
// seconds later or with other parameters; the others are judged as if it were not there.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
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
  struct Seat {
    SharedSystem built;
    std::shared_ptr<const ClosedLoop> loop;
    std::unique_ptr<SystemJudge> judge;  ///< nullptr: it could not be made
    std::string failure = {};            ///< of the last evaluation
    double failed_at = 0.0;              ///< [s], simulated
  };
  struct Waiting {
    JudgementRequest request;
    double since;           ///< [s], of a clock that only goes forward
    bool complete = false;  ///< the verdict alone has been given
  };

  /// complete: with what takes long. Throws nothing that an evaluation throws.
  Judgement judge(const Waiting& waiting, bool complete);
  /// Puts verdict, speeds and margins into a judgement.
  void evaluate(Seat& seat, const Waiting& waiting, bool complete, Judgement& judgement);
  void run();
  std::optional<Waiting> next();  ///< mutex_ is held

  std::vector<Seat> seats_;  ///< the thread's, while there is one
  std::vector<JudgedSpeeds> first_speeds_;
  std::mutex mutex_;  ///< what follows
  std::condition_variable asked_;
  std::vector<std::optional<Waiting>> waiting_;  ///< of each system
  std::vector<Judgement> done_;
  std::size_t turn_ = 0;
  double busy_ = 0.0;  ///< [s]
  bool judging_ = false;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace whirl_twin
