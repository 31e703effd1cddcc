#include "display/shaft_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "display/layout.h"
#include "display/rotor_parts.h"
#include "display/sketch_drawing.h"
#include "scene/signal_names.h"

namespace whirl_twin {
namespace {

// Sizes of the picture [m]. Machines are drawn to scale up to the available space.
constexpr double kWidestShaft = 2.2;
constexpr double kNarrowestShaft = 1.8;
constexpr double kTallestShaft = 1.2;
constexpr double kShaftBaseHeight = 0.04;
constexpr double kShaftTextGap = 0.16;  // between the picture and its text
constexpr double kLowestText = 0.40;    // above the shaft
// rad, rotation of the shaft from across the view towards the viewer
constexpr double kTowardsViewer = 0.6;
constexpr double kBeforeDisc = 0.012;  // of an orbit, so that the disc does not hide it
constexpr double kSamePlace = 1.0e-9;  // of the picture's size
constexpr double kRoom = 0.4;          // of the picture's height: space for the whirl

std::vector<Station> publishedOf(const std::vector<Station>& stations) {
  std::vector<Station> published{stations.front()};
  std::copy_if(stations.begin() + 1, stations.end(), std::back_inserter(published),
               [](const Station& station) { return station.published; });
  return published;
}

double scaleOf(const Sketch& sketch) {
  return std::min(std::clamp(sketch.size, kNarrowestShaft, kWidestShaft) / sketch.size,
                  kTallestShaft / sketch.height);
}

}  // namespace

bool ShaftDisplay::shows(const Dynamics* dynamics) {
  if (dynamics == nullptr || !dynamics->isRotor() || dynamics->stations().size() < 2) {
    return false;
  }
  const Sketch sketch = dynamics->sketch(Eigen::VectorXd::Zero(dynamics->dof()), {});
  return !sketch.empty() && sketch.height > 0.0;
}

ShaftDisplay::ShaftDisplay(std::string name, std::shared_ptr<const Dynamics> dynamics,
                           double whirl_scale, double trail_turns)
    : name_(std::move(name)),
      dynamics_(std::move(dynamics)),
      stations_(dynamics_->stations()),
      at_rest_(dynamics_->sketch(Eigen::VectorXd::Zero(dynamics_->dof()), {})),
      picture_scale_(scaleOf(at_rest_)),
      shape_(dynamics_->linearRotor(), publishedOf(stations_)),
      scale_(whirl_scale, kRoom * height() / WhirlScale::kMaxRadius) {
  for (const Station& station : publishedOf(stations_)) {
    places_.push_back({places_.empty() ? name_ : stationName(name_, station),
                       station,
                       {},
                       OrbitTrail(trail_turns)});
  }
}

void ShaftDisplay::setDynamics(std::shared_ptr<const Dynamics> dynamics) {
  dynamics_ = std::move(dynamics);
  stations_ = dynamics_->stations();
  shape_ = ShapeExpansion(dynamics_->linearRotor(), publishedOf(stations_));
}

std::vector<std::string> ShaftDisplay::published() const {
  std::vector<std::string> names;
  for (const Place& place : places_) {
    names.push_back(place.name);
  }
  return names;
}

void ShaftDisplay::update(const std::string& published, const WhirlState& state) {
  const auto place = std::find_if(places_.begin(), places_.end(),
                                  [&](const Place& p) { return p.name == published; });
  if (place == places_.end()) {
    return;
  }
  place->trail.add(state);
  if (!std::isfinite(state.x) || !std::isfinite(state.y)) {
    return;
  }
  place->state = state;
  place->published = true;
  scale_.observe(std::hypot(state.x, state.y), state.time);
  if (std::any_of(places_.begin(), places_.end(),
                  [&](const Place& p) { return !p.published || p.state.step != state.step; })) {
    return;
  }
  shown_ = places_.front().state;
  whirl_.resize(2 * static_cast<Eigen::Index>(places_.size()));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    whirl_.segment<2>(2 * static_cast<Eigen::Index>(i)) << places_[i].state.x, places_[i].state.y;
  }
}

Eigen::Isometry3d ShaftDisplay::placedAt(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d across = boardAxes().col(0);
  const Eigen::Vector3d near = boardAxes().col(2);
  const Eigen::Vector3d along = std::cos(kTowardsViewer) * across + std::sin(kTowardsViewer) * near;
  Eigen::Matrix3d axes;
  axes << Eigen::Vector3d::UnitZ().cross(along), Eigen::Vector3d::UnitZ(), along;
  return Eigen::Translation3d(place +
                              (kShaftBaseHeight + 0.5 * height()) * Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d(axes);
}

Eigen::Vector3d ShaftDisplay::drawnAt(double position, double x, double y) const {
  return {scale_.value() * x, scale_.value() * y, picture_scale_ * (position - at_rest_.centre.x)};
}

Eigen::Isometry3d ShaftDisplay::bodyPose() const {
  const WhirlState& state = shown_ ? *shown_ : places_.front().state;
  return Eigen::Translation3d(drawnAt(places_.front().station.position, state.x, state.y)) *
         Eigen::AngleAxisd(state.shaft_angle, Eigen::Vector3d::UnitZ());
}

double ShaftDisplay::longestRadius(const Eigen::VectorXd& q) const {
  double longest = 0.0;
  for (const Station& station : stations_) {
    longest = std::max(longest, std::hypot(station.along_x.dot(q), station.along_y.dot(q)));
  }
  return longest;
}

void ShaftDisplay::drawBase(MarkerCanvas& canvas) const {
  const double half = 0.5 * picture_scale_ * at_rest_.size;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().y() = -0.5 * (height() + kShaftBaseHeight);
  canvas.box("stand", pose, {0.3 * half, kShaftBaseHeight, 2.0 * half}, kBaseColor);
  canvas.line("bearing_line", {{0.0, 0.0, -half}, {0.0, 0.0, half}}, 0.004, kFaintColor);
}

double ShaftDisplay::inFront(double position) const {
  double half = 0.0;
  for (const Sketch::Disc& disc : at_rest_.discs) {
    if (std::fabs(disc.at.x - position) < kSamePlace * at_rest_.size) {
      half = std::max(half, 0.5 * picture_scale_ * disc.thickness);
    }
  }
  return half;
}

void ShaftDisplay::drawOrbit(const Place& place, const SystemStatus& status,
                             MarkerCanvas& canvas) const {
  Eigen::Isometry3d plane = Eigen::Isometry3d::Identity();
  plane.translation() = drawnAt(place.station.position, 0.0, 0.0);
  plane.translation().z() += kBeforeDisc + inFront(place.station.position);
  MarkerCanvas there = canvas.beside(place.station.name, 0.0).moved(plane);
  std::vector<Eigen::Vector3d> orbit;
  for (const Eigen::Vector2d& point : place.trail.points()) {
    orbit.emplace_back(scale_.value() * point.x(), scale_.value() * point.y(), 0.0);
  }
  there.line("orbit", orbit, 0.012, kOrbitColor, true);
  const bool own = &place == &places_.front();
  const auto further = status.further_limits.find(place.name);
  const std::vector<VibrationLimit> none;
  drawLimits(own                                      ? status.limits
             : further != status.further_limits.end() ? further->second
                                                      : none,
             own ? status.orders.get() : nullptr, scale_.value(), there);
  if (!status.compact && places_.size() > 1) {
    there.text("name", {0.0, -0.5 * height() + 0.05, 0.12}, 0.05, place.station.name, kOrbitColor);
  }
}

void ShaftDisplay::draw(const SystemStatus& status, MarkerCanvas& canvas) const {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(dynamics_->dof());
  const WhirlState& state = shown_ ? *shown_ : places_.front().state;
  if (shown_) {
    q = shape_.at(state.shaft_angle, state.speed, whirl_);
    scale_.observe(longestRadius(q), state.time);
  }
  EvaluationPoint<double> at{};
  at.time = state.time;
  at.angle = state.shaft_angle;
  at.speed = state.speed;
  const double exaggerated = scale_.value() / picture_scale_;
  drawBase(canvas);
  // The sketch's x along the shaft, its y across it, its z up.
  Eigen::Isometry3d along = Eigen::Isometry3d::Identity();
  along.linear() << Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY();
  along.translation().z() = -picture_scale_ * at_rest_.centre.x;
  MarkerCanvas picture = canvas.moved(along);
  drawSketch(dynamics_->sketch(exaggerated * q, at), picture_scale_,
             severityColor(status.alerts, kCalmDiscColor), picture);
  for (const Place& place : places_) {
    drawOrbit(place, status, canvas);
  }
  std::string scales = exaggerationText(scale_.value());
  if (std::fabs(picture_scale_ - 1.0) > 0.005) {
    scales = fmt::format("lengths x {:.2g}, {}", picture_scale_, scales);
  }
  canvas.text("scale", {-0.75, -0.5 * height() - 0.06, -0.3}, status.compact ? 0.11 : 0.066, scales,
              kOrbitColor);
  const Eigen::Vector3d foot(0.0, std::max(0.5 * height() + kShaftTextGap, kLowestText), 0.0);
  drawStatus(name_, whirlLines(state, status), state.speed, status, foot, canvas);
}

}  // namespace whirl_twin
