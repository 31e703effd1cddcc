// The picture of a system for the page: its sketch (mechanics/sketch.h) at the newest state, and
// the samples of its motion since the last picture. The motion of a rotor is magnified; its samples
// have velocities, too, so that a fast orbit is drawn as a curve through few points.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/sketch.h"
#include "messages/states.h"
#include "reports/output.h"
#include "twin/whirl_phase.h"

namespace whirl_twin {

/// A shaft in two bearings with a disc between them, for rotors whose model has no sketch.
/// x, y: of the disc's centre, in widths of the picture; angle [rad] of the shaft.
Sketch discRotorSketch(double x, double y, double angle);

/// The motion of a system at an instant.
struct PictureMotion {
  state::Instant at;
  EvaluationPoint<double> shaft;
  WhirlMotion whirl;    ///< of a rotor
  Eigen::VectorXd q;    ///< coordinates; empty: not known, of a rotor
  std::string stopped;  ///< why it has stopped, or ""
};

class SystemPicture {
 public:
  explicit SystemPicture(const Dynamics& dynamics);

  /// Keeps the motion as a sample, or leaves some out, evenly, where there are too many.
  void sample(const PictureMotion& motion, const Dynamics& dynamics);
  /// With the samples since the last call. dynamics: with the present parameters.
  Json take(const PictureMotion& motion, const Dynamics& dynamics);
  /// The twin was reset.
  void restart();

 private:
  static constexpr std::size_t kMaxSamples = 64;  // of a picture

  Sketch sketch(const PictureMotion& motion, const Dynamics& dynamics);
  Sketch rotorSketch(const PictureMotion& motion, const Dynamics& dynamics);
  void magnify(double radius, double size);
  Json path(double x) const;
  void clearSamples();

  bool rotor_;
  std::vector<std::string> names_;           // of the samples' values
  std::vector<double> times_, speeds_;       // [s], [rad/s]
  std::vector<std::vector<double>> values_;  // of each name
  std::vector<SketchPoint> path_;            // of the tracer; of a rotor it follows from values_
  std::size_t stride_ = 1, passed_ = 0;
  double longest_ = 0.0;  // [m], radius of late
  double magnification_ = 1.0;
};

}  // namespace whirl_twin
