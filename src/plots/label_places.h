// Where words stand on a chart: beside what they name, on no curve and on no other words.
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
  /// Words stay inside this.
  explicit LabelPlaces(const Rectangle& sheet) : sheet_(sheet) {}

  /// A line that no words may cover [px]; one that is not finite breaks it.
  void avoid(const std::vector<Spot>& line) { lines_.push_back(line); }
  void avoid(const Rectangle& area) { areas_.push_back(area); }

  bool free(const Rectangle& place) const { return covered(place) == 0; }
  /// The first of these places that is free, else the one that covers least; taken from now on.
  /// Not empty.
  Rectangle take(const std::vector<Rectangle>& places);

 private:
  int covered(const Rectangle& place) const;

  Rectangle sheet_;
  std::vector<std::vector<Spot>> lines_;
  std::vector<Rectangle> areas_;
};

}  // namespace whirl_twin
