// Barred speed ranges (bands) about critical speeds: a shaft passes them and does not stay there.
//
// A target inside a band is moved to an edge, as in industrial drives: to the upper one from the
// centre on, to the lower one below, and it keeps that edge until it is beyond the centre by a
// fraction of the band (hysteresis). Overlapping bands are merged into one with a new centre.
//
// A band is crossed at the highest acceleration A from edge to edge: there is no schedule that
// passes a resonance better. At a jerk J that takes a run-up of r = A^2 / (2 J) before the near
// edge and as much beyond the far one. So a shaft that starts nearer first moves away from the
// band, and one that is to stop nearer returns; bands with a gap below r are merged for this A and
// J. No shaft reverses for that: a band nearer to standstill than r is crossed at the acceleration
// that a start from standstill allows.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "control/speed_profile.h"

namespace whirl_twin {

/// Speeds [rad/s] between two edges, which do not belong to it; 0 < from < to.
struct SpeedBand {
  double from = 0.0;
  double to = 0.0;

  /// No speed is in it; also when an edge is not a number.
  bool empty() const noexcept { return !(from < to); }
  double centre() const noexcept { return 0.5 * (from + to); }
  bool holds(double speed) const noexcept { return from < speed && speed < to; }
};

/// Changes of speed that follow one another, each from the end of that before.
struct BandedChange {
  static constexpr std::size_t kMaxChanges = 4;
  static constexpr std::size_t kMaxPieces = kMaxChanges * SpeedChange::kMaxPieces;

  std::array<SpeedChange, kMaxChanges> changes;
  std::array<double, kMaxChanges> speeds;  ///< [rad/s], at which each ends
  std::size_t count = 0;
  double duration = 0.0;  ///< [s]
};

class ExclusionBands {
 public:
  // Not real-time safe.

  ExclusionBands() = default;
  /// In any order; of both senses of rotation. hysteresis [-], 0 to 0.5: share of a band. Throws
  /// InputError for a band whose edges are not 0 < from < to, and for another hysteresis.
  explicit ExclusionBands(std::vector<SpeedBand> bands, double hysteresis = 0.1);

  bool empty() const { return bands_.empty(); }
  /// The merged bands of both senses of rotation, in ascending order.
  const std::vector<SpeedBand>& bands() const { return bands_; }

  // Real-time safe: no allocation, no lock, no exception.

  /// Where a target goes, for changes by this acceleration [rad/s^2] and jerk [rad/s^3; 0: no
  /// limit]; before: where the last one went, NaN without one.
  double allowed(double target, double max_acceleration, double max_jerk,
                 double before) const noexcept;

  /// The band that `allowed` moves a target out of: with those that are one with it at this
  /// acceleration and jerk.
  std::optional<SpeedBand> bandOf(double target, double max_acceleration,
                                  double max_jerk) const noexcept;

  /// From a speed and an acceleration to an allowed speed: the smallest number of moves that cross
  /// each band at full acceleration. A start inside a band continues if it is at full acceleration,
  /// or leaves by the edge it can reach first; so does a start that cannot stop before a band. The
  /// move must be valid (faultOf), its speed allowed(). To speed 0 it is the fastest stop that
  /// honours the bands.
  BandedChange plan(double speed, double acceleration, const SpeedMove& move) const noexcept;

 private:
  /// Calls visit(band) in rising order, bands with gaps below a run-up as one, but across rest.
  template <class Visit>
  void visitMerged(double run_up, Visit visit) const noexcept;
  /// The band, so merged, that a speed is in.
  std::optional<SpeedBand> around(double speed, double run_up) const noexcept;

  std::vector<SpeedBand> bands_;
  double hysteresis_ = 0.1;
};

}  // namespace whirl_twin
