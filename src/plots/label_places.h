// Placement of labels on a chart: beside their objects, without overlap with curves or labels.
#pragma once

#include <vector>

#include "plots/thinning.h"

namespace whirl_twin {

/// [px]
struct Rectangle {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

class LabelPlaces {
 public:
  /// Labels stay inside this.
  explicit LabelPlaces(const Rectangle& sheet) : sheet_(sheet) {}

  /// A line that no label may cover [px]; a point that is not finite interrupts it.
  void avoid(const std::vector<Spot>& line) { lines_.push_back(line); }
  void avoid(const Rectangle& area) { areas_.push_back(area); }

  bool free(const Rectangle& place) const { return covered(place) == 0; }
  /// The first of these places that is free, else the one with the smallest overlap; it is marked
  /// as occupied. Not empty.
  Rectangle take(const std::vector<Rectangle>& places);

 private:
  int covered(const Rectangle& place) const;

  Rectangle sheet_;
  std::vector<std::vector<Spot>> lines_;
  std::vector<Rectangle> areas_;
};

}  // namespace whirl_twin
