// The picture of a system for the page: its sketch (mechanics/sketch.h) at the newest state, and
// the samples of its motion since the last picture. The motion of a rotor is magnified.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mechanics/sketch.h"
#include "reports/output.h"
#include "twin/observer.h"

namespace whirl_twin {

/// A shaft in two bearings with a disc between them, for rotors whose model has no sketch.
/// x, y: of the disc's centre, in widths of the picture; angle [rad] of the shaft.
Sketch discRotorSketch(double x, double y, double angle);

class SystemPicture {
 public:
  SystemPicture(std::size_t system, const BuiltSystem& built);

  /// Keeps the observer's state as a sample, or leaves some out, evenly, where there are too many.
  void sample(const Observer& observer);
  /// With the samples since the last call. dynamics: with the present parameters.
  Json take(const Observer& observer, const Dynamics& dynamics);
  /// The twin was reset.
  void restart();

 private:
  static constexpr std::size_t kMaxSamples = 64;  // of a picture

  Sketch sketch(const Observer& observer, const Dynamics& dynamics);
  Sketch rotorSketch(const Observer& observer, const Dynamics& dynamics);
  void magnify(double radius, double size);

  std::size_t system_;
  bool rotor_;
  std::vector<std::string> names_;           // of the samples' values
  std::vector<double> times_, speeds_;       // [s], [rad/s]
  std::vector<std::vector<double>> values_;  // of each name
  std::size_t stride_ = 1, passed_ = 0;
  double longest_ = 0.0;  // [m], radius of late
  double magnification_ = 1.0;
};

}  // namespace whirl_twin
