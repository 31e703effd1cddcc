// A system of a followed machine: its filter, what of its residuals and parameters is watched, and
// what has been told of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "estimation/bearing_forces.h"
#include "estimation/innovation_tests.h"
#include "estimation/robust_covariance.h"
#include "estimation/starting_filter.h"
#include "messages/follow_state.h"
#include "twin/twin.h"

namespace whirl_twin {

struct FollowedTrack {
  FollowedTrack(const Twin& twin, std::size_t system, const SystemFollowing& settings,
                std::vector<FollowedChannel> channels, double false_alarms);

  /// Its motion has been known long enough for residuals to be judged.
  bool settled(std::int64_t instant) const;
  /// Its motion, found at an instant, begins with what is known of it.
  /// again_now: for the second time in a row.
  void beginMotion(std::int64_t instant, bool again_now = false);
  /// It began with an outlier: too many of the samples since were refused. The filter, which is
  /// about to learn from this motion, has to begin with it again, once.
  bool beganWrong(std::int64_t instant) const;
  /// All channels have told of the instant `at`.
  void endInstant();
  /// The block of residuals that `robust` goes by ends at `at`, after a quarter of a second or at
  /// once.
  void endBlock(bool at_once);
  /// All that was learned has been forgotten.
  void forgetFactors();
  /// Into `told`: parameters, zeros, forces, the verdict on residuals and drift at a time [s].
  void tellWhatIsKnown(double time);

  std::size_t index;  // of the twin's systems
  StartingFilter filter;
  std::size_t drive;
  bool runs = false;
  std::int64_t began = 0;                            // [ns], to be followed
  bool again = false;                                // for the second time
  std::int64_t used_before = 0, refused_before = 0;  // samples, until then
  std::int64_t at = 0;         // [ns], of the instant whose innovations are gathered
  std::int64_t last_used = 0;  // [ns]
  ResidualWatch residuals;
  DriftWatch drift;
  RobustCovariance robust;
  std::int64_t block_began = 0;             // [ns]
  std::vector<double> innovations, surest;  // of that instant
  std::vector<double> squares;              // of the residuals of each channel
  std::vector<std::int64_t> counts;
  std::vector<std::int64_t> heard;  // [ns], of each channel: its newest sample
  std::int64_t overtaken = 0;       // samples, by those of channels with less delay
  state::FollowState told;
  std::int64_t next_telling = 0;     // [ns]
  SharedSystem model;                // of the generation
  std::vector<BearingForce> forces;  // of that model
  double first_energy = 0.0;         // [J], as the scene says
  std::int64_t generation = 0;
  std::int64_t next_generation = 0;  // [ns]
};

}  // namespace whirl_twin
