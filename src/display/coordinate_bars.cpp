#include "display/coordinate_bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace whirl_twin {
namespace {

constexpr Color kName{0.90F, 0.92F, 0.94F};
constexpr double kThinnest = 0.004;  // m, a bar of nothing is still seen

}  // namespace

void CoordinateBars::update(const std::vector<CoordinateInfo>& coordinates,
                            const std::vector<double>& value, double time) {
  coordinates_ = coordinates;
  value_ = value;
  double angle = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    double& largest = coordinates_[i].isAngle() ? angle : length;
    largest = std::max(largest, std::abs(value_[i]));
  }
  angle_.observe(angle, time);
  length_.observe(length, time);
}

void CoordinateBars::draw(const Color& color, MarkerCanvas& canvas) const {
  const double half = 0.5 * kWidth;
  canvas.line("line", {{-half, 0.0, 0.0}, {half, 0.0, 0.0}}, 0.006, kFaintColor);
  const auto count = static_cast<double>(coordinates_.size());
  const double pitch = 0.92 * kWidth / count;
  const double text = std::min(0.072, 0.45 * pitch);
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const double x = (static_cast<double>(i) - 0.5 * (count - 1.0)) * pitch;
    const double largest = 0.5 * kHeight - 0.12;
    const double height =
        std::clamp(scaleOf(coordinates_[i]).value() * value_[i], -largest, largest);
    const Eigen::Isometry3d pose(Eigen::Translation3d(x, 0.0, 0.5 * height));
    canvas.box("bar", pose,
               {std::min(0.16, 0.6 * pitch), 0.06, std::max(std::abs(height), kThinnest)}, color);
    // The name stands on the side of the line where the bar is not.
    canvas.text("coordinate", {x, -0.05, height > 0.0 ? -0.6 * text : 0.6 * text}, text,
                coordinates_[i].name, kName);
  }
  std::vector<std::string> scales;
  for (const bool angles : {true, false}) {
    const bool any = std::any_of(coordinates_.begin(), coordinates_.end(),
                                 [&](const CoordinateInfo& c) { return c.isAngle() == angles; });
    if (any) {
      scales.push_back(fmt::format("{} x {:.6g}", angles ? "angles" : "lengths",
                                   (angles ? angle_ : length_).value()));
    }
  }
  canvas.text("scale", {0.0, -0.05, -0.5 * kHeight + 0.05}, 0.06,
              fmt::format("{}", fmt::join(scales, ", ")), kFaintColor);
}

}  // namespace whirl_twin
