// Judges the loop that controllers close around a system, as they sample it
// (analysis/sampled_stability.h): about the motion that they hold it in (scene/held_motion.h).
// Margins take up to a hundred times as long as the verdict: they are found apart, and anew where
// the verdict changes, and at most once a second of simulated time where the speed has changed by a
// hundredth or the motion has moved.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/sampled_stability.h"
#include "analysis/stability.h"
#include "messages/controller_state.h"
#include "messages/refusal.h"
#include "scene/built_system.h"
#include "scene/closed_loop.h"

namespace whirl_twin {

/// Of a speed: after a larger change a system is judged before its turn [-].
inline constexpr double kSpeedNews = 0.01;

/// A loop that has no small motions of a linear law: its verdict is uncertain by its nature, and
/// nothing has failed.
struct LoopNotLinear : RunFailure {
  using RunFailure::RunFailure;
};

class LoopJudge {
 public:
  LoopJudge(SharedSystem system, std::shared_ptr<const ClosedLoop> loop);

  /// With the system at `present` and the loop's others as `beside` tells, at a simulated time [s];
  /// `about`: the place judged. Roots inside the unit circle are `left`. Throws RunFailure where
  /// the loop cannot be judged, and what else linearizing throws.
  Stability judge(double time, const SystemMotion& present, const SystemMotions& beside,
                  Eigen::VectorXd& about);
  /// The margins are not those of what was judged last.
  bool lacksMargins() const;
  void findMargins();
  /// Of each controller: the last verdict, with the margins found last. Without `at`. Of a loop
  /// through several systems its first one tells.
  std::vector<state::ControllerMargins> margins() const;

 private:
  /// What was judged.
  struct Case {
    double time = 0.0;      ///< [s], simulated
    double speed = 0.0;     ///< [rad/s], that the laws follow
    Eigen::VectorXd about;  ///< places, then rates, of each system
    Verdict verdict = Verdict::kUncertain;
    std::vector<bool> holding;  ///< ClosedLoop::Parts
  };

  Stability judgeOrSayWhy(double time, const SystemMotion& present, const SystemMotions& beside,
                          Eigen::VectorXd& about);
  bool speaks() const { return place_ == loop_->systems().front(); }

  SharedSystem system_;
  std::shared_ptr<const ClosedLoop> loop_;
  std::size_t place_;  ///< of the system
  std::vector<state::ControllerMargins> margins_;
  std::optional<ClosedLoop::Parts> parts_;  ///< of `last_`; nothing: not judged
  Case last_;
  std::optional<Case> found_;  ///< what margins_ are of
};

}  // namespace whirl_twin
