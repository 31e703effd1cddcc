// Judges one system of a scene at its present speed and state: linearises it about the equilibrium
// it operates at, applies Routh's test, and measures the distance to its critical and threshold
// speeds.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/equilibria.h"
#include "analysis/known_steady_motions.h"
#include "messages/stability_margin.h"
#include "monitoring/judged_speeds.h"
#include "scene/built_system.h"

namespace whirl_twin {

class SystemJudge {
 public:
  explicit SystemJudge(const BuiltSystem& system);

  const std::string& system() const { return system_; }
  /// The verdict with coordinates q and rates v at shaft speed [rad/s] (ignored without a shaft):
  /// of the equilibrium or steady motion it operates about, its conserved momenta as they are.
  state::StabilityMargin judge(const state::Instant& at, const std::vector<double>& q,
                               const std::vector<double>& v, double speed);
  /// Its critical speeds, and its thresholds as of the last judgement.
  const JudgedSpeeds& speeds() const { return speeds_; }

 private:
  void findThresholds(double time, const Eigen::VectorXd& about, double speed, Verdict verdict);

  std::string system_;
  std::string model_;
  std::shared_ptr<const Dynamics> dynamics_;
  JudgedSpeeds speeds_;
  KnownSteadyMotions steady_motions_;
  std::optional<double> searched_at_;   ///< [s], simulated: for thresholds
  std::optional<Equilibrium> settled_;  ///< of a linear system without a shaft: once for all
};

}  // namespace whirl_twin
