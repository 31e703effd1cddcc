#include "nodes/pendulum_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "nodes/status_text.h"

namespace whirl_twin {
namespace {

// Sizes of the picture [m]. Rods are drawn true to length as long as they fit their place.
constexpr double kPivotHeight = 0.85;
constexpr double kLongest = 0.62;
constexpr double kShortest = 0.30;
constexpr double kPostDistance = 0.78;
constexpr double kArmHeight = 0.12;  // above the pivot
constexpr double kTextFoot = 0.43;   // above the pivot, clear of the bracket

constexpr Color kSteel{0.66F, 0.69F, 0.73F};
constexpr Color kIron{0.48F, 0.52F, 0.58F};
constexpr Color kBase{0.75F, 0.80F, 0.88F};
constexpr Color kCalmBob{0.30F, 0.62F, 0.52F};
constexpr Color kTrail{0.95F, 0.60F, 0.95F};
constexpr Color kThin{0.80F, 0.83F, 0.87F, 0.55F};

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace

PendulumDisplay::PendulumDisplay(std::string name) : name_(std::move(name)) {}

void PendulumDisplay::update(const PendulumState& state, const DriveState* drive) {
  if (!std::all_of(state.angle.begin(), state.angle.end(),
                   [](double angle) { return std::isfinite(angle); })) {
    trail_.clear();
    return;
  }
  state_ = state;
  shaft_speed_ = drive != nullptr ? drive->speed : geometry_.speed;
  plane_angle_ = planeAngle(state, geometry_, drive);
  joints_ = pendulumJoints(state, geometry_, plane_angle_);
  if (!trail_.empty() && state.time < trail_.back().time) {
    trail_.clear();
  }
  if (!joints_.empty() && (trail_.empty() || state.time - trail_.back().time >= kTrailStep)) {
    trail_.push_back({state.time, joints_.back()});
  }
  while (!trail_.empty() && state.time - trail_.front().time > kTrailTime) {
    trail_.pop_front();
  }
}

double PendulumDisplay::pictureScale() const {
  const double length =
      joints_.size() > 2 ? geometry_.length1 + geometry_.length2 : geometry_.length1;
  return length > 0.0 ? std::clamp(length, kShortest, kLongest) / length : 1.0;
}

Eigen::Isometry3d PendulumDisplay::placedAt(const Eigen::Vector3d& place) const {
  Eigen::Matrix3d axes;
  axes << Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ();
  return Eigen::Translation3d(place + kPivotHeight * Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d(axes);
}

Eigen::Isometry3d PendulumDisplay::bodyPose() const {
  if (joints_.empty()) {
    return Eigen::Isometry3d::Identity();
  }
  // The bob's z axis runs back along its rod; its y axis is across the plane of the swing.
  const Eigen::Vector3d z = (joints_[joints_.size() - 2] - joints_.back()).normalized();
  const Eigen::Vector3d y(-std::sin(plane_angle_), std::cos(plane_angle_), 0.0);
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return Eigen::Translation3d(pictureScale() * joints_.back()) * Eigen::Isometry3d(axes);
}

void PendulumDisplay::drawBracket(MarkerCanvas& canvas) const {
  const double top = kArmHeight + 0.03;
  canvas.box("stand", at(0.0, kPostDistance, 0.5 * (top - kPivotHeight)),
             {0.07, 0.07, top + kPivotHeight}, kIron);
  canvas.box("stand", at(0.0, 0.5 * kPostDistance, top), {0.06, kPostDistance + 0.07, 0.06}, kIron);
  canvas.box("stand", at(0.0, 0.5 * kPostDistance, 0.02 - kPivotHeight),
             {0.34, kPostDistance + 0.3, 0.04}, kBase);
  canvas.cylinder("stand", {0, 0, 0.02}, {0, 0, kArmHeight}, 0.02, kSteel);
  // The pivot's pin lies across the plane of the swing and shows how the plane has turned.
  const Eigen::Vector3d pin(-0.06 * std::sin(plane_angle_), 0.06 * std::cos(plane_angle_), 0.0);
  canvas.cylinder("stand", -pin, pin, 0.016, kSteel);
  canvas.line("axis", {{0, 0, top + 0.1}, {0, 0, 0.04 - kPivotHeight}}, 0.004, kThin);
}

void PendulumDisplay::drawPendulum(const Color& color, MarkerCanvas& canvas) const {
  const double scale = pictureScale();
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    canvas.cylinder("rod", scale * joints_[i - 1], scale * joints_[i], 0.012, kSteel);
    canvas.sphere("bob", scale * joints_[i], 0.05, color);
  }
  std::vector<Eigen::Vector3d> path;
  path.reserve(trail_.size() + 1);
  for (const auto& point : trail_) {
    path.push_back(scale * point.position);
  }
  path.push_back(scale * joints_.back());
  canvas.line("trail", path, 0.014, kTrail, true);
}

void PendulumDisplay::draw(const SystemStatus& status, MarkerCanvas& canvas) const {
  std::vector<std::string> lines = {coordinateText(state_.name, state_.angle)};
  if (!joints_.empty()) {
    drawBracket(canvas);
    drawPendulum(severityColor(status.alerts, kCalmBob), canvas);
    if (pictureScale() != 1.0) {
      canvas.text("scale", {0.0, 0.0, 0.12 - kPivotHeight}, 0.072,
                  fmt::format("lengths x {:.2g}", pictureScale()), kTrail);
    }
  }
  if (!geometry_.drive.empty() || geometry_.speed != 0.0) {
    lines.push_back(speedText(shaft_speed_));
  }
  if (status.margin) {
    const auto& margin = *status.margin;
    if (!margin.coordinate.empty()) {
      lines.push_back("about " + coordinateText(margin.coordinate, margin.operating_point) + ":");
    }
    const auto margins = marginLines(margin);
    lines.insert(lines.end(), margins.begin(), margins.end());
  }
  // A double pendulum easily swings over the top.
  const double foot = joints_.size() > 2 ? kLongest + 0.1 : kTextFoot;
  drawStatus(name_, lines, status.alerts, foot * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ(),
             canvas);
}

}  // namespace whirl_twin
