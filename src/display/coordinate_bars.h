// A picture of a system whose model has none: a bar for each coordinate, up for positive, with its
// name. Angles and lengths have a scale each, chosen as the whirl's is.
#pragma once

#include <string>
#include <vector>

#include "display/marker_canvas.h"
#include "display/whirl_scale.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

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

}  // namespace whirl_twin
