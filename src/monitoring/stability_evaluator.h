// Evaluates the stability of one system of a scene at its present speed and state: linearises it
// about the equilibrium it operates at, applies Routh's test, and measures the distance to its
// critical and threshold speeds.
//
// Of a reduced-order rotor the full-order model is evaluated, too, and where they are on different
// sides of the limit the verdict is uncertain.
//
// A system with controllers is evaluated by its loop (LoopEvaluator), without critical and
// threshold speeds.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/equilibria.h"
#include "analysis/full_order_margins.h"
#include "analysis/known_steady_motions.h"
#include "analysis/sampled_stability.h"
#include "analysis/stability.h"
#include "analysis/steady_motion.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "messages/controller_state.h"
#include "messages/input_error.h"
#include "messages/stability_margin.h"
#include "monitoring/characteristic_speeds.h"
#include "scene/built_system.h"
#include "scene/closed_loop.h"

namespace whirl_twin {

/// Of a speed: after a larger change a system is evaluated before its turn [-].
inline constexpr double kSpeedNews = 0.01;

/// A loop that has no small motions of a linear law: its verdict is uncertain by its nature, and
/// nothing has failed.
struct LoopNotLinear : RunFailure {
  using RunFailure::RunFailure;
};

/// Evaluates the loop that controllers close around a system, as they sample it
/// (analysis/sampled_stability.h): about the closed-loop equilibrium
/// (scene/closed_loop_equilibrium.h). Margins take up to a hundred times as long as the verdict:
/// they are found apart, and again where the verdict changes, and at most once a second of
/// simulated time where the speed has changed by a hundredth or the motion has moved.
class LoopEvaluator {
 public:
  LoopEvaluator(SharedSystem system, std::shared_ptr<const ClosedLoop> loop);

  /// With the system at `present` and the loop's others as `beside` gives, at a simulated time [s];
  /// `about`: the evaluated place. Roots inside the unit circle are `left`. Throws RunFailure where
  /// the loop cannot be evaluated, and what else linearizing throws.
  Stability evaluate(double time, const SystemMotion& present, const SystemMotions& beside,
                     Eigen::VectorXd& about);
  /// The margins are not those of the last verdict.
  bool lacksMargins() const;
  void findMargins();
  /// Of each controller: the last verdict, with the margins found last. Without `at`. Of a loop
  /// through several systems its first one reports them.
  std::vector<state::ControllerMargins> margins() const;

 private:
  /// What was evaluated.
  struct Case {
    double time = 0.0;      ///< [s], simulated
    double speed = 0.0;     ///< [rad/s], that the laws follow
    Eigen::VectorXd about;  ///< places, then rates, of each system
    Verdict verdict = Verdict::kUncertain;
    std::vector<bool> holding;  ///< ClosedLoop::Parts
  };

  Stability evaluateOrThrow(double time, const SystemMotion& present, const SystemMotions& beside,
                            Eigen::VectorXd& about);
  bool reports() const { return place_ == loop_->systems().front(); }

  SharedSystem system_;
  std::shared_ptr<const ClosedLoop> loop_;
  std::size_t place_;  ///< of the system
  std::vector<state::ControllerMargins> margins_;
  std::optional<ClosedLoop::Parts> parts_;  ///< of `last_`; nothing: not evaluated
  Case last_;
  std::optional<Case> found_;  ///< what margins_ are of
};

/// The verdict on a system that cannot be evaluated: uncertain, with nothing known.
state::StabilityMargin uncertainMargin(const BuiltSystem& system, const state::Instant& at,
                                       const std::vector<double>& q, double speed);

class StabilityEvaluator {
 public:
  /// loop: of its controllers; nullptr: it has none.
  explicit StabilityEvaluator(SharedSystem system,
                              std::shared_ptr<const ClosedLoop> loop = nullptr);

  /// The verdict with coordinates q and rates v at shaft speed [rad/s] (ignored without a shaft):
  /// of the equilibrium or steady motion it operates about, its conserved momenta as they are.
  /// With the speeds and margins of loops that are known: those that are to be searched for take
  /// a hundred times as long. beside: the other systems of a loop that goes through several;
  /// acceleration: of the shaft [rad/s^2].
  state::StabilityMargin evaluate(const state::Instant& at, const std::vector<double>& q,
                                  const std::vector<double>& v, double speed,
                                  const SystemMotions& beside = nullptr, double acceleration = 0.0);
  /// Something is to be searched for: critical speeds before the first time, thresholds where the
  /// last verdict was not that which they predicted, margins of its loop.
  bool isPartial() const { return loop_ ? loop_->lacksMargins() : !speeds_ || lacks_thresholds_; }
  /// Searches for it, about the last evaluation at `speed` [rad/s], and puts speeds into its
  /// verdict.
  void complete(double speed, state::StabilityMargin& margin);
  /// Of the controllers around it, as of the last verdict at `at`.
  std::vector<state::ControllerMargins> loopMargins(const state::Instant& at) const;
  /// Its critical speeds, and its thresholds as of the last search; those that follow from its
  /// parameters alone are found if they have not been.
  const CharacteristicSpeeds& speeds();
  /// The motion that the last verdict is about; nothing where it operates about none.
  const std::optional<SteadyMotion>& motion() const { return motion_; }
  /// Why the last verdict could not be reached; "": it was.
  const std::string& failure() const { return failure_; }

 private:
  void checkThresholds(double time, double speed, Verdict verdict);
  void putSpeeds(double speed, state::StabilityMargin& margin) const;
  double shaftSpeed(double speed) const { return system_->dynamics->hasShaft() ? speed : 0.0; }

  Stability openStability(const state::Instant& at, const Eigen::VectorXd& present,
                          const Eigen::VectorXd& rates, double speed, Eigen::VectorXd& about);

  void findSpeeds(double speed, state::StabilityMargin& margin);

  /// The margins of the full-order model, about what was evaluated. Throws what FullOrderMargins
  /// does.
  ReducedMargins fullOrderMargins(const Eigen::VectorXd& about, double speed);

  SharedSystem system_;
  std::shared_ptr<const Dynamics> driven_;  ///< with its harmonic inputs (judgedDynamics)
  DataSpeeds tables_;
  std::optional<LoopEvaluator> loop_;
  std::optional<CharacteristicSpeeds> speeds_;
  KnownSteadyMotions steady_motions_;
  /// What was found of a reduction last, and where.
  struct EvaluatedReduction {
    double speed = 0.0;     ///< [rad/s]
    Eigen::VectorXd place;  ///< amplitudes
    ReducedMargins margins;
  };
  std::optional<FullOrderMargins> unreduced_;
  std::optional<EvaluatedReduction> reduction_;
  std::optional<SteadyMotion> motion_;
  std::string failure_;
  state::StabilityMargin::About evaluated_about_ = state::StabilityMargin::About::kEquilibrium;
  bool lacks_thresholds_ = false;
  std::optional<double> searched_at_;   ///< [s], simulated: for thresholds
  std::optional<Equilibrium> settled_;  ///< of a linear system without a shaft: once for all
};

}  // namespace whirl_twin
