// A scale on a board: ranges of colours between places 0 to 1 of its length, and a pointer.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include "display/marker_canvas.h"

namespace whirl_twin {

class ScaleBar {
 public:
  static constexpr double kWidth = 1.3;  ///< [m]

  /// middle [m]: how high on the board; height [m]
  ScaleBar(std::string part, double middle, double height, MarkerCanvas& board)
      : part_(std::move(part)), middle_(middle), height_(height), board_(board) {}

  /// Takes it away where it has no length. A higher layer is in front.
  void range(const std::string& name, double from, double to, const Color& color, int layer) {
    from = std::clamp(from, 0.0, 1.0);
    to = std::clamp(to, 0.0, 1.0);
    if (!(to > from)) {
      board_.gone(part_ + "_" + name);
      return;
    }
    board_.box(part_ + "_" + name, at(0.5 * (from + to), layer),
               {(to - from) * kWidth, height_, kThick}, color);
  }
  void pointer(double place) {
    board_.box(part_ + "_pointer", at(std::clamp(place, 0.0, 1.0), 4),
               {0.024, 1.6 * height_, kThick}, {1.0F, 1.0F, 1.0F});
  }
  void noPointer() { board_.gone(part_ + "_pointer"); }

 private:
  static constexpr double kThick = 0.004;  // m

  Eigen::Isometry3d at(double place, int layer) const {
    return Eigen::Isometry3d(Eigen::Translation3d((place - 0.5) * kWidth, middle_, 0.006 * layer));
  }

  std::string part_;
  double middle_;
  double height_;
  MarkerCanvas& board_;
};

}  // namespace whirl_twin
