// A mechanism as a picture: the sketch of its model in front of a board, the trail of one of its
// points, its coordinates, energies, margins and alerts as text; where it is measured, a pale hull
// at the measured position. A system with an unknown model, or one without a sketch, is shown as
// one bar per coordinate.
//
// The sketch's axes (see mechanics/sketch.h) are upright in the world and face the viewer of the
// row of systems; rotation about the vertical has x = world y, as for the rotors.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "display/marker_canvas.h"
#include "display/scales.h"
#include "display/system_display.h"
#include "mechanics/dynamics.h"
#include "whirl_twin/PendulumState.h"

namespace whirl_twin {

// Picture of a system whose model has none: a bar for each coordinate, upwards for positive, with
// its name. Angles and lengths have separate scales, chosen like that of the whirl.

class CoordinateBars {
 public:
  static constexpr double kWidth = 1.2;   ///< [m], of the picture, about its origin
  static constexpr double kHeight = 0.9;  ///< [m]

  /// @param time [s], simulated
  void update(const std::vector<CoordinateInfo>& coordinates, const std::vector<double>& value,
              double time);

  void draw(const Color& color, MarkerCanvas& canvas) const;

 private:
  const WhirlScale& scaleOf(const CoordinateInfo& c) const {
    return c.isAngle() ? angle_ : length_;
  }

  std::vector<CoordinateInfo> coordinates_;
  std::vector<double> value_;  // rad or m
  WhirlScale angle_, length_;
};

class MechanismDisplay : public SystemDisplay {
 public:
  static constexpr double kTrailTime = 2.0;               ///< [s], simulated
  static constexpr double kTrailStep = kTrailTime / 400;  ///< [s] between points of the trail

  /// @param name of the system  @param dynamics of its model; null: unknown
  MechanismDisplay(std::string name, std::shared_ptr<const Dynamics> dynamics);

  /// The model with other parameters, of the same coordinates.
  void setDynamics(std::shared_ptr<const Dynamics> dynamics) { dynamics_ = std::move(dynamics); }

  /// Processes the next state; cheap enough for every step of the twin. A state that is not finite,
  /// or not of this model, leaves the picture unchanged.
  /// @param shaft the motion of its shaft at that time; zero without one
  void update(const PendulumState& state, const EvaluationPoint<double>& shaft);

  /// Measured position, coordinates as in the states; it is drawn until measuredGone().
  void measure(const std::vector<double>& place);
  void measuredGone() { measured_ = {}; }

  /// [-], metres in the picture per metre of the machine.
  double pictureScale() const;

  Eigen::Isometry3d placedAt(const Eigen::Vector3d& place) const override;
  void draw(const SystemStatus& status, MarkerCanvas& canvas) const override;
  std::string bodyName() const override { return "body"; }
  /// At the traced point, its z axis back along the rod that ends there.
  Eigen::Isometry3d bodyPose() const override;

 private:
  struct TrailPoint {
    double time;               // s, simulated
    Eigen::Vector3d position;  // m, unscaled
  };

  // Of the picture on the screen [m].
  double width() const;
  double height() const;
  Eigen::Vector3d centre() const;

  void drawBoard(MarkerCanvas& canvas) const;
  void drawTrail(MarkerCanvas& canvas) const;
  std::vector<std::string> lines(const SystemStatus& status) const;

  std::string name_;
  std::shared_ptr<const Dynamics> dynamics_;
  PendulumState state_;
  std::vector<CoordinateInfo> coordinates_;
  EvaluationPoint<double> shaft_;
  Sketch sketch_;
  Sketch measured_;
  CoordinateBars bars_;
  std::deque<TrailPoint> trail_;
};

}  // namespace whirl_twin
