// Tracking state of one system of a state estimator: its filter, tests of its residuals and
// parameters, and its published results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "estimation/bearing_forces.h"
#include "estimation/innovation_tests.h"
#include "estimation/iterated_initializer.h"
#include "estimation/robust_covariance.h"
#include "messages/follow_state.h"
#include "twin/twin.h"

namespace whirl_twin {

struct EstimatorTrack {
  EstimatorTrack(const Twin& twin, std::size_t system, const SystemFollowing& settings,
                 std::vector<EstimatorChannel> channels, double false_alarms);

  /// The motion has been known for long enough to test residuals.
  bool settled(std::int64_t instant) const;
  /// The motion has been found at an instant with the current estimates. again_now: for the second
  /// time in a row.
  void beginMotion(std::int64_t instant, bool again_now = false);
  /// The motion was found from an outlier: too many of the samples since were rejected. Before the
  /// filter estimates parameters from this motion, it must be found again, once.
  bool beganWrong(std::int64_t instant) const;
  /// All channels have delivered their sample of the instant `at`.
  void endInstant();
  /// Ends the block of residuals of `robust` at `at`: after a quarter of a second, or at once.
  void endBlock(bool at_once);
  /// The learned parameters have been reset.
  void forgetFactors();
  /// Updates the FollowState: parameters, offsets, forces, verdicts on residuals and drift at a
  /// time [s].
  void publishKnown(double time);

  std::size_t index;  // of the twin's systems
  IteratedInitializer filter;
  std::size_t drive;
  bool runs = false;
  std::int64_t began = 0;                            // [ns], start of the motion
  bool again = false;                                // found for the second time
  std::int64_t used_before = 0, refused_before = 0;  // samples, before the start
  std::int64_t at = 0;                               // [ns], instant of the current innovations
  std::int64_t last_used = 0;                        // [ns]
  InnovationTest residuals;
  CusumDetector drift;
  RobustCovariance robust;
  std::int64_t block_began = 0;             // [ns]
  std::vector<double> innovations, surest;  // of that instant
  std::vector<double> squares;              // sum of squared residuals of each channel
  std::vector<std::int64_t> counts;
  std::vector<std::int64_t> heard;  // [ns], newest sample of each channel
  std::int64_t overtaken = 0;       // samples preceded by newer ones of channels with less delay
  state::FollowState report;
  std::int64_t next_telling = 0;     // [ns]
  SharedSystem model;                // of the current generation
  std::vector<BearingForce> forces;  // of that model
  double first_energy = 0.0;         // [J], of the scene's initial state
  std::int64_t generation = 0;
  std::int64_t next_generation = 0;  // [ns]
};

}  // namespace whirl_twin
