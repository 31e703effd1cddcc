#include "display/rotor_display.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "display/rotor_parts.h"

namespace whirl_twin {
namespace {

// Sizes of the picture [m]; only the whirl is to scale, with the displayed scale factor.
constexpr double kShaftHeight = 0.66;
constexpr double kShaftLength = 1.3;
constexpr double kShaftRadius = 0.022;
constexpr double kDiscRadius = 0.26;
constexpr double kDiscThickness = 0.05;
constexpr double kTextFoot = 0.56;  // above the shaft

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace

std::vector<Eigen::Vector3d> bentShaft(double length, const Eigen::Vector2d& whirl,
                                       std::size_t points) {
  std::vector<Eigen::Vector3d> line;
  line.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(points - 1);
    const double bend = std::sin(M_PI * s);
    line.emplace_back(bend * whirl.x(), bend * whirl.y(), (s - 0.5) * length);
  }
  return line;
}

RotorDisplay::RotorDisplay(std::string name, double whirl_scale, double trail_turns)
    : name_(std::move(name)), scale_(whirl_scale), trail_(trail_turns) {}

void RotorDisplay::update(const WhirlState& state) {
  trail_.add(state);
  if (std::isfinite(state.x) && std::isfinite(state.y)) {
    state_ = state;
    scale_.observe(std::hypot(state.x, state.y), state.time);
  }
}

Eigen::Isometry3d RotorDisplay::placedAt(const Eigen::Vector3d& place) const {
  Eigen::Matrix3d axes;
  axes << Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX();
  return Eigen::Translation3d(place + kShaftHeight * Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d(axes);
}

Eigen::Isometry3d RotorDisplay::bodyPose() const {
  const Eigen::Vector2d whirl = scale_.value() * Eigen::Vector2d(state_.x, state_.y);
  return at(whirl.x(), whirl.y(), 0.0) *
         Eigen::AngleAxisd(state_.shaft_angle, Eigen::Vector3d::UnitZ());
}

void RotorDisplay::drawStand(MarkerCanvas& canvas) const {
  for (const double end : {-0.5 * kShaftLength, 0.5 * kShaftLength}) {
    canvas.box("stand", at(0.0, 0.0, end), {0.13, 0.13, 0.09}, kIronColor);
    canvas.box("stand", at(0.0, -0.5 * kShaftHeight, end), {0.09, kShaftHeight, 0.06}, kIronColor);
  }
  canvas.box("stand", at(0.0, 0.02 - kShaftHeight, 0.0), {0.34, 0.04, kShaftLength + 0.2},
             kBaseColor);
  const double beyond = 0.5 * kShaftLength + 0.2;
  canvas.line("bearing_line", {{0.0, 0.0, -beyond}, {0.0, 0.0, beyond}}, 0.004, kFaintColor);
}

void RotorDisplay::drawShaft(MarkerCanvas& canvas) const {
  const Eigen::Vector2d whirl = bodyPose().translation().head<2>();
  canvas.tube("shaft", bentShaft(kShaftLength, whirl, 25), kShaftRadius, kSteelColor);
  // Stubs beyond the bearings; the front one carries the keyphasor's reference mark, which is at
  // shaft angle zero like the unbalance, under a probe on the rotor's x axis.
  const double bearing = 0.5 * kShaftLength;
  canvas.cylinder("shaft", {0, 0, -bearing - 0.12}, {0, 0, -bearing}, kShaftRadius, kSteelColor);
  canvas.cylinder("shaft", {0, 0, bearing}, {0, 0, bearing + 0.12}, kShaftRadius, kSteelColor);
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(state_.shaft_angle, Eigen::Vector3d::UnitZ()));
  canvas.box("keyphasor", turned * at(kShaftRadius, 0.0, bearing + 0.085), {0.016, 0.016, 0.05},
             kMarkColor);
  canvas.cylinder("keyphasor", {0.05, 0.0, bearing + 0.085}, {0.13, 0.0, bearing + 0.085}, 0.012,
                  kIronColor);
}

void RotorDisplay::drawDisc(const Color& color, MarkerCanvas& canvas) const {
  const Eigen::Isometry3d disc = bodyPose();
  const double face = 0.5 * kDiscThickness;
  canvas.cylinder("disc", disc * Eigen::Vector3d(0, 0, -face), disc * Eigen::Vector3d(0, 0, face),
                  kDiscRadius, color);
  for (const double side : {-face - 0.004, face + 0.004}) {
    canvas.line("unbalance",
                {disc * Eigen::Vector3d(0, 0, side), disc * Eigen::Vector3d(kDiscRadius, 0, side)},
                0.012, kMarkColor);
  }
  canvas.sphere("unbalance", disc * Eigen::Vector3d(kDiscRadius, 0, 0), 0.036, kMarkColor);
}

void RotorDisplay::drawOrbit(MarkerCanvas& canvas) const {
  // Just in front of the disc, which would hide it.
  const double plane = 0.5 * kDiscThickness + 0.012;
  std::vector<Eigen::Vector3d> orbit;
  for (const auto& point : trail_.points()) {
    orbit.emplace_back(scale_.value() * point.x(), scale_.value() * point.y(), plane);
  }
  canvas.line("orbit", orbit, 0.014, kOrbitColor, true);
  const Eigen::Vector3d centre = bodyPose().translation() + plane * Eigen::Vector3d::UnitZ();
  canvas.line("whirl_radius", {{0.0, 0.0, plane}, centre}, 0.006, kOrbitColor);
}

void RotorDisplay::draw(const SystemStatus& status, MarkerCanvas& canvas) const {
  drawStand(canvas);
  drawShaft(canvas);
  drawDisc(severityColor(status.alerts, kCalmDiscColor), canvas);
  drawOrbit(canvas);
  MarkerCanvas plane = canvas.moved(at(0.0, 0.0, 0.5 * kDiscThickness + 0.010));
  drawLimits(status.limits, status.orders.get(), scale_.value(), plane);
  // Beside the shaft; in a compact view in front of the base.
  const Eigen::Vector3d beside = status.compact
                                     ? Eigen::Vector3d(-0.41, -0.54, 0.43)
                                     : Eigen::Vector3d(0.0, -0.14, 0.5 * kShaftLength + 0.25);
  canvas.text("scale", beside, status.compact ? 0.11 : 0.072, exaggerationText(scale_.value()),
              kOrbitColor);
  drawStatus(name_, whirlLines(state_, status), state_.speed, status,
             kTextFoot * Eigen::Vector3d::UnitY(), canvas);
}

}  // namespace whirl_twin
