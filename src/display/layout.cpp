#include "display/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {
namespace {

constexpr std::size_t kMaxInFull = 3;
constexpr double kFullWidth = 1.95, kFullHeight = 3.1;        // m, of a place
constexpr double kCompactWidth = 1.7, kCompactHeight = 2.15;  // m
constexpr double kColumnPart = 0.22;                          // of the width of the view
constexpr double kNarrowestColumn = 1.7;                      // m, of the column
constexpr double kBelow = 0.25;                               // m, of a base below its shelf

double tangent() {
  return std::tan(0.5 * ViewedFrom::kAngle);
}

/// Distance of the camera from the centre of an upright rectangle that must be in view.
double distanceFor(double width, double height) {
  const double up = 0.5 * height * std::cos(ViewedFrom::kPitch);
  const double nearer = 0.5 * height * std::sin(ViewedFrom::kPitch);  // its upper edge
  return nearer + std::max(up, 0.5 * width / ViewedFrom::kAspect) / tangent();
}

struct Shelves {
  std::size_t rows = 1, columns = 1;
};

Shelves shelvesFor(std::size_t systems, double width, double height) {
  Shelves best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t rows = 1; rows <= systems; ++rows) {
    const std::size_t columns = (systems + rows - 1) / rows;
    const double distance = distanceFor(static_cast<double>(columns) * width / (1.0 - kColumnPart),
                                        static_cast<double>(rows) * height);
    if (distance < least) {
      least = distance;
      best = {rows, columns};
    }
  }
  return best;
}

}  // namespace

Eigen::Vector3d towardsViewer() {
  const double level = std::cos(ViewedFrom::kPitch);
  return {level * std::cos(ViewedFrom::kYaw), level * std::sin(ViewedFrom::kYaw),
          std::sin(ViewedFrom::kPitch)};
}

Eigen::Matrix3d boardAxes() {
  Eigen::Matrix3d axes;
  axes << Eigen::Vector3d(-std::sin(ViewedFrom::kYaw), std::cos(ViewedFrom::kYaw), 0.0),
      Eigen::Vector3d::UnitZ(),
      Eigen::Vector3d(std::cos(ViewedFrom::kYaw), std::sin(ViewedFrom::kYaw), 0.0);
  return axes;
}

Layout layoutOf(std::size_t systems) {
  Layout layout;
  layout.compact = systems > kMaxInFull;
  layout.cell_width = layout.compact ? kCompactWidth : kFullWidth;
  layout.cell_height = layout.compact ? kCompactHeight : kFullHeight;
  const std::size_t count = std::max<std::size_t>(systems, 1);
  const Shelves shelves = shelvesFor(count, layout.cell_width, layout.cell_height);
  const double wide = static_cast<double>(shelves.columns) * layout.cell_width;
  const double tall = static_cast<double>(shelves.rows) * layout.cell_height;
  layout.column_width = std::max(kNarrowestColumn, wide * kColumnPart / (1.0 - kColumnPart));
  // About the centre of all systems on the ground, column excluded.
  const Eigen::Vector3d right = boardAxes().col(0);
  const auto at = [&](double across, double up) {
    return Eigen::Vector3d(across * right + up * Eigen::Vector3d::UnitZ());
  };
  for (std::size_t i = 0; i < systems; ++i) {
    const std::size_t row = i / shelves.columns;
    const std::size_t column = i % shelves.columns;
    layout.places.push_back(at((static_cast<double>(column) + 0.5) * layout.cell_width - 0.5 * wide,
                               static_cast<double>(shelves.rows - 1 - row) * layout.cell_height));
  }
  layout.column = at(0.5 * (wide + layout.column_width), 0.0);
  const double whole = wide + layout.column_width;
  layout.view = at(0.5 * layout.column_width, 0.5 * (tall - kBelow)) +
                (distanceFor(whole, tall + kBelow) - ViewedFrom::kDistance) * towardsViewer();
  return layout;
}

}  // namespace whirl_twin
