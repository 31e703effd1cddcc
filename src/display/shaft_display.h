// A rotor of a shaft with places along it as a picture: every element with its diameter, discs,
// bearings and pedestals as its model draws them, to scale, the whole shaft bent as its whirl shows
// it (analysis/whole_shape.h) by the factor that is written beside it, an orbit with its limits at
// every place that is published.
//
// Rotor axes as in rotor_display.h, the middle of the shaft their origin; the shaft lies level and
// obliquely to the viewer, its last node nearest.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/whole_shape.h"
#include "display/orbit_trail.h"
#include "display/scales.h"
#include "display/system_display.h"
#include "mechanics/dynamics.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

class ShaftDisplay : public SystemDisplay {
 public:
  /// Whether a model has a picture and several places along its shaft; null has not.
  static bool shows(const Dynamics* dynamics);

  /// @param dynamics one that it shows()  @param whirl_scale [-], 0: automatic
  /// @param trail_turns [-], > 0
  ShaftDisplay(std::string name, std::shared_ptr<const Dynamics> dynamics, double whirl_scale,
               double trail_turns);

  /// The model with other parameters, of the same places.
  void setDynamics(std::shared_ptr<const Dynamics> dynamics);

  /// The names that its whirl is published under, its own first.
  std::vector<std::string> published() const;

  /// Takes the next state of one of them; cheap enough for every step of the twin. The picture is
  /// that of the newest step of which all have told.
  void update(const std::string& published, const WhirlState& state);

  Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) const override;
  void draw(const SystemStatus& status, MarkerCanvas& canvas) const override;
  std::string bodyName() const override { return "disc"; }
  Eigen::Isometry3d bodyPose() const override;

 private:
  struct Place {
    std::string name;
    Station station;
    WhirlState state;
    OrbitTrail trail;
    bool told = false;
  };

  /// In the picture [m], of a place at `position` [m] of the shaft that whirls by x, y [m].
  Eigen::Vector3d drawnAt(double position, double x, double y) const;
  double height() const { return picture_scale_ * at_rest_.height; }
  /// [m], in the picture: half of the thickest disc at a place.
  double inFront(double position) const;
  double longestRadius(const Eigen::VectorXd& q) const;
  void drawBase(MarkerCanvas& canvas) const;
  void drawOrbit(const Place& place, const SystemStatus& status, MarkerCanvas& canvas) const;

  std::string name_;
  std::shared_ptr<const Dynamics> dynamics_;
  std::vector<Station> stations_;  // all along the shaft
  Sketch at_rest_;
  double picture_scale_ = 1.0;  // [-], metres in the picture for a metre of the machine
  std::vector<Place> places_;   // published, the system's own first
  std::optional<WhirlState> shown_;
  Eigen::VectorXd whirl_;     // of the places, at that step
  mutable WholeShape shape_;  // keeps what it found for a speed
  mutable WhirlScale scale_;  // follows what is drawn
};

}  // namespace whirl_twin
