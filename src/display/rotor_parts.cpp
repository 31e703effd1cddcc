#include "display/rotor_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "display/status_text.h"

namespace whirl_twin {
namespace {

constexpr Color kCalmLimit{0.35F, 0.80F, 0.45F};

}  // namespace

void drawLimits(const std::vector<VibrationLimit>& limits, const OrderState* orders, double scale,
                MarkerCanvas& canvas) {
  constexpr std::size_t kMaxLimits = 5;  // three zones, two levels
  constexpr double kLargest = 0.5;       // m, in the picture
  constexpr int kSides = 48;
  for (std::size_t i = 0; i < kMaxLimits; ++i) {
    std::vector<Eigen::Vector3d> circle;
    Color color{0.0F, 0.0F, 0.0F};
    if (i < limits.size() && scale * limits[i].radius <= kLargest) {
      const VibrationLimit& limit = limits[i];
      Eigen::Vector2d centre = Eigen::Vector2d::Zero();
      if (orders != nullptr) {
        centre = scale * Eigen::Vector2d(orders->mean_x, orders->mean_y);
      }
      for (int k = 0; k <= kSides; ++k) {
        const double angle = 2.0 * M_PI * k / kSides;
        const double radius = scale * limit.radius;
        circle.emplace_back(centre.x() + radius * std::cos(angle),
                            centre.y() + radius * std::sin(angle), 0.0);
      }
      color = limit.severity == Alert::INFO ? kCalmLimit : severityColor(limit.severity);
    }
    canvas.line("limit", circle, 0.010, color);
  }
}

std::vector<std::string> whirlLines(const WhirlState& state, const SystemStatus& status) {
  std::vector<std::string> lines;
  if (status.live.margin) {
    lines = marginLines(*status.live.margin);
  }
  std::vector<std::string> first{speedText(state.speed)};
  if (const std::string vibration = vibrationText(status.vibration); !vibration.empty()) {
    first.push_back(vibration);
  }
  if (status.orders) {
    first.push_back(ordersText(*status.orders));
  }
  lines.insert(lines.begin(), first.begin(), first.end());
  if (!status.limits.empty()) {
    lines.push_back(limitsText(status.limits));
  }
  return lines;
}

std::string exaggerationText(double scale) {
  // "500", "0.02", "1 000 000": usual notation of a round number.
  return "whirl x " + (scale >= 1.0 ? fmt::format("{:.0f}", scale) : fmt::format("{:.3g}", scale));
}

}  // namespace whirl_twin
