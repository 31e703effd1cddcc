// Picture of a rotor with stations along its shaft: every element with its diameter, discs,
// bearings and pedestals as its model draws them, to scale, the whole shaft bent according to its
// whirl (analysis/shape_expansion.h), magnified by the displayed factor, and an orbit with its
// limits at every published station.
//
// Rotor axes as in rotor_display.h, with the origin at the middle of the shaft; the shaft is level
// and oblique to the viewer, its last node nearest.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/shape_expansion.h"
#include "display/orbit_trail.h"
#include "display/scales.h"
#include "display/system_display.h"
#include "mechanics/dynamics.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

class ShaftDisplay : public SystemDisplay {
 public:
  /// Does the model have a picture and several stations along its shaft? False for null.
  static bool shows(const Dynamics* dynamics);

  /// @param dynamics one that it shows()  @param whirl_scale [-], 0: automatic
  /// @param trail_turns [-], > 0
  ShaftDisplay(std::string name, std::shared_ptr<const Dynamics> dynamics, double whirl_scale,
               double trail_turns);

  /// The model with other parameters, of the same stations.
  void setDynamics(std::shared_ptr<const Dynamics> dynamics);

  /// The names under which its whirl is published, its own first.
  std::vector<std::string> published() const;

  /// Processes the next state of one of them; cheap enough for every step of the twin. The picture
  /// shows the newest step for which the states of all have arrived.
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
    bool published = false;
  };

  /// In the picture [m], of a station at `position` [m] of the shaft with the whirl x, y [m].
  Eigen::Vector3d drawnAt(double position, double x, double y) const;
  double height() const { return picture_scale_ * at_rest_.height; }
  /// [m], in the picture: half the thickness of the thickest disc at a station.
  double inFront(double position) const;
  double longestRadius(const Eigen::VectorXd& q) const;
  void drawBase(MarkerCanvas& canvas) const;
  void drawOrbit(const Place& place, const SystemStatus& status, MarkerCanvas& canvas) const;

  std::string name_;
  std::shared_ptr<const Dynamics> dynamics_;
  std::vector<Station> stations_;  // all along the shaft
  Sketch at_rest_;
  double picture_scale_ = 1.0;  // [-], metres in the picture per metre of the machine
  std::vector<Place> places_;   // published, the system's own first
  std::optional<WhirlState> shown_;
  Eigen::VectorXd whirl_;         // of the stations, at that step
  mutable ShapeExpansion shape_;  // caches the result for a speed
  mutable WhirlScale scale_;      // adapts to the drawn whirl
};

}  // namespace whirl_twin
