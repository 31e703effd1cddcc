// A rotor as a picture: a shaft between two bearings, bent by the whirl to a half sine, the disc at
// the whirling centre with its unbalance mark, the orbit's trail with its limit circles, margins
// and alerts as text. The whirl is drawn exaggerated; the factor is shown beside the shaft.
//
// Rotor axes (z along the shaft, x and y across it, rotation from x to y positive) lie in the world
// so that the shaft is level: rotor z = world x (REP 103: forward), rotor x = world y, rotor y =
// world z. Seen from the front (world x), forward whirl turns counter-clockwise.
#pragma once

#include <vector>

#include "display/orbit_trail.h"
#include "display/scales.h"
#include "display/system_display.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

class RotorDisplay : public SystemDisplay {
 public:
  /// @param name of the system  @param whirl_scale [-], 0: automatic  @param trail_turns [-], > 0
  RotorDisplay(std::string name, double whirl_scale, double trail_turns);

  /// Processes the next state; cheap enough for every step of the twin.
  void update(const WhirlState& state);

  Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) const override;
  void draw(const SystemStatus& status, MarkerCanvas& canvas) const override;
  std::string bodyName() const override { return "disc"; }
  Eigen::Isometry3d bodyPose() const override;

 private:
  void drawStand(MarkerCanvas& canvas) const;
  void drawShaft(MarkerCanvas& canvas) const;
  void drawDisc(const Color& color, MarkerCanvas& canvas) const;
  void drawOrbit(MarkerCanvas& canvas) const;

  std::string name_;
  WhirlState state_;
  WhirlScale scale_;
  OrbitTrail trail_;
};

/// The centre line of a shaft of the given length [m] along z about the origin, supported in
/// bearings at its ends and displaced at midspan by `whirl` [m]: a half sine, the first bending
/// mode.
std::vector<Eigen::Vector3d> bentShaft(double length, const Eigen::Vector2d& whirl,
                                       std::size_t points);

}  // namespace whirl_twin
