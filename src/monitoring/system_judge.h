// Judges one system of a scene at its present speed and state: linearises it about the equilibrium
// it operates at, applies Routh's test, and measures the distance to its critical and threshold
// speeds.
//
// A rotor that is reduced to a few shapes stands for the one that these were taken from: both are
// judged, and where they are on different sides of the limit the verdict is uncertain.
//
// A system with controllers is judged by its loop (loop_judge.h): no critical and threshold speeds
// of it are looked for.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/equilibria.h"
#include "analysis/known_steady_motions.h"
#include "analysis/steady_motion.h"
#include "analysis/unreduced_margins.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "messages/stability_margin.h"
#include "monitoring/judged_speeds.h"
#include "monitoring/loop_judge.h"
#include "scene/built_system.h"
#include "scene/closed_loop.h"

namespace whirl_twin {

/// The verdict on a system that cannot be evaluated: uncertain, with nothing known.
state::StabilityMargin uncertainMargin(const BuiltSystem& system, const state::Instant& at,
                                       const std::vector<double>& q, double speed);

class SystemJudge {
 public:
  /// loop: what its controllers close around it; nullptr: it has none.
  explicit SystemJudge(SharedSystem system, std::shared_ptr<const ClosedLoop> loop = nullptr);

  /// The verdict with coordinates q and rates v at shaft speed [rad/s] (ignored without a shaft):
  /// of the equilibrium or steady motion it operates about, its conserved momenta as they are.
  /// With the speeds and margins of loops that are known: those that are to be looked for take a
  /// hundred times as long. beside: the other systems of a loop that goes through several;
  /// acceleration: of the shaft [rad/s^2].
  state::StabilityMargin judge(const state::Instant& at, const std::vector<double>& q,
                               const std::vector<double>& v, double speed,
                               const SystemMotions& beside = nullptr, double acceleration = 0.0);
  /// Something is to be looked for: critical speeds before the first time, thresholds where the
  /// last verdict was not that which they foretold, margins of its loop.
  bool isPartial() const { return loop_ ? loop_->lacksMargins() : !speeds_ || lacks_thresholds_; }
  /// Looks for it, about what was judged last at `speed` [rad/s], and puts speeds into its verdict.
  void complete(double speed, state::StabilityMargin& margin);
  /// Of the controllers around it, as of the last verdict at `at`.
  std::vector<state::ControllerMargins> loopMargins(const state::Instant& at) const;
  /// Its critical speeds, and its thresholds as of the last search; those that follow from its
  /// parameters alone are looked for if they have not been.
  const JudgedSpeeds& speeds();
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

  /// The margins before the reduction, about what was judged. Throws what UnreducedMargins does.
  ReducedMargins unreducedMargins(const Eigen::VectorXd& about, double speed);

  SharedSystem system_;
  std::shared_ptr<const Dynamics> judged_;  ///< with its harmonic inputs (judgedDynamics)
  DataSpeeds tables_;
  std::optional<LoopJudge> loop_;
  std::optional<JudgedSpeeds> speeds_;
  KnownSteadyMotions steady_motions_;
  /// What was found of a reduction last, and where.
  struct JudgedReduction {
    double speed = 0.0;     ///< [rad/s]
    Eigen::VectorXd place;  ///< amplitudes
    ReducedMargins margins;
  };
  std::optional<UnreducedMargins> unreduced_;
  std::optional<JudgedReduction> reduction_;
  std::optional<SteadyMotion> motion_;
  std::string failure_;
  state::StabilityMargin::About judged_about_ = state::StabilityMargin::About::kEquilibrium;
  bool lacks_thresholds_ = false;
  std::optional<double> searched_at_;   ///< [s], simulated: for thresholds
  std::optional<Equilibrium> settled_;  ///< of a linear system without a shaft: once for all
};

}  // namespace whirl_twin
