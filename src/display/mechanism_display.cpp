#include "display/mechanism_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "display/sketch_drawing.h"
#include "display/status_text.h"

namespace whirl_twin {

namespace {

constexpr Color kName{0.90F, 0.92F, 0.94F};
constexpr double kThinnest = 0.004;  // m, minimum length, to keep a zero bar visible

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
    // The name is on the side of the line opposite to the bar.
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

namespace {

// Sizes of the picture [m]. Machines are drawn to scale up to the available space.
constexpr double kWidestMechanism = 1.5;
constexpr double kTallestMechanism = 1.3;
constexpr double kNarrowestMechanism = 1.0;
constexpr double kMechanismBaseHeight = 0.04;
constexpr double kBoardThickness = 0.02;
constexpr double kMechanismTextGap = 0.14;  // between the picture and its text
constexpr double kNoShaft = std::numeric_limits<double>::quiet_NaN();
constexpr double kFacing = -0.55;  // rad about the vertical, towards the viewer of the row

constexpr Color kBoard{0.17F, 0.21F, 0.26F};
constexpr Color kCalmMass{0.30F, 0.62F, 0.52F};
constexpr Color kTrail{0.95F, 0.60F, 0.95F};
constexpr double kHullLifetime = 0.5;  // s, wall time

bool allFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

// Are coordinates of these names those of the model?
bool isOf(const std::vector<std::string>& name, const Dynamics* dynamics) {
  if (dynamics == nullptr) {
    return false;
  }
  const std::vector<CoordinateInfo> own = dynamics->coordinates();
  return std::equal(own.begin(), own.end(), name.begin(), name.end(),
                    [](const CoordinateInfo& c, const std::string& n) { return c.name == n; });
}

std::vector<CoordinateInfo> coordinatesOf(const std::vector<std::string>& name,
                                          const Dynamics* dynamics) {
  return isOf(name, dynamics) ? dynamics->coordinates() : coordinatesByName(name);
}

}  // namespace

MechanismDisplay::MechanismDisplay(std::string name, std::shared_ptr<const Dynamics> dynamics)
    : name_(std::move(name)), dynamics_(std::move(dynamics)) {}

void MechanismDisplay::update(const PendulumState& state, const EvaluationPoint<double>& shaft) {
  if (!allFinite(state.angle) || !std::isfinite(state.time) ||
      state.name.size() != state.angle.size()) {
    trail_.clear();
    return;
  }
  state_ = state;
  shaft_ = shaft;
  coordinates_ = coordinatesOf(state.name, dynamics_.get());
  sketch_ = {};
  if (isOf(state.name, dynamics_.get())) {
    sketch_ =
        dynamics_->sketch(Eigen::Map<const Eigen::VectorXd>(
                              state.angle.data(), static_cast<Eigen::Index>(state.angle.size())),
                          shaft);
  }
  if (sketch_.empty()) {
    bars_.update(coordinates_, state.angle, state.time);
  }
  if (!trail_.empty() && (state.time < trail_.back().time || !sketch_.has_tracer)) {
    trail_.clear();
  }
  if (sketch_.has_tracer && (trail_.empty() || state.time - trail_.back().time >= kTrailStep)) {
    trail_.push_back({state.time, toVector(sketch_.tracer)});
  }
  while (!trail_.empty() && state.time - trail_.front().time > kTrailTime) {
    trail_.pop_front();
  }
}

void MechanismDisplay::measure(const std::vector<double>& place) {
  measured_ = {};
  if (dynamics_ && place.size() == static_cast<std::size_t>(dynamics_->dof()) && allFinite(place)) {
    measured_ = dynamics_->sketch(
        Eigen::Map<const Eigen::VectorXd>(place.data(), static_cast<Eigen::Index>(place.size())),
        shaft_);
  }
}

double MechanismDisplay::pictureScale() const {
  if (sketch_.empty()) {
    return 1.0;
  }
  const double tall = sketch_.height > 0.0 ? sketch_.height : sketch_.size;
  return std::min(std::clamp(sketch_.size, kNarrowestMechanism, kWidestMechanism) / sketch_.size,
                  kTallestMechanism / tall);
}

double MechanismDisplay::width() const {
  return sketch_.empty() ? CoordinateBars::kWidth : pictureScale() * sketch_.size;
}

double MechanismDisplay::height() const {
  if (sketch_.empty()) {
    return CoordinateBars::kHeight;
  }
  return pictureScale() * (sketch_.height > 0.0 ? sketch_.height : sketch_.size);
}

Eigen::Vector3d MechanismDisplay::centre() const {
  return sketch_.empty() ? Eigen::Vector3d::Zero().eval()
                         : (pictureScale() * toVector(sketch_.centre)).eval();
}

Eigen::Isometry3d MechanismDisplay::placedAt(const Eigen::Vector3d& place) const {
  Eigen::Matrix3d axes;
  axes << Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ();
  const double facing = sketch_.spatial ? 0.0 : kFacing;
  const Eigen::Isometry3d turned = Eigen::Translation3d(place) *
                                   Eigen::AngleAxisd(facing, Eigen::Vector3d::UnitZ()) *
                                   Eigen::Isometry3d(axes);
  return turned * Eigen::Translation3d(
                      Eigen::Vector3d(0, 0, kMechanismBaseHeight + 0.5 * height()) - centre());
}

Eigen::Isometry3d MechanismDisplay::bodyPose() const {
  const Eigen::Vector3d body = toVector(sketch_.tracer);
  Eigen::Isometry3d pose(Eigen::Translation3d(pictureScale() * body));
  for (const Sketch::Rod& rod : sketch_.rods) {
    const Eigen::Vector3d back = toVector(rod.from) - toVector(rod.to);
    if ((toVector(rod.to) - body).norm() < 1e-9 * sketch_.size && back.norm() > 0.0) {
      pose.linear() =
          Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), back).toRotationMatrix();
    }
  }
  return pose;
}

void MechanismDisplay::drawBoard(MarkerCanvas& canvas) const {
  const Eigen::Vector3d middle = centre();
  const double foot = middle.z() - 0.5 * height();
  const auto at = [&](double y, double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(middle.x(), y, z));
  };
  if (sketch_.spatial) {
    // A bracket is placed at its back edge.
    canvas.box("stand", at(0.14 * width(), foot - 0.5 * kMechanismBaseHeight),
               {0.5 * width(), 0.88 * width(), kMechanismBaseHeight}, kBaseColor);
    return;
  }
  const double board = kBoardDistance * width() + 0.5 * kBoardThickness;
  canvas.box("stand", at(board - 0.09, foot - 0.5 * kMechanismBaseHeight),
             {width() + 0.1, 0.34, kMechanismBaseHeight}, kBaseColor);
  canvas.box("stand", at(board, middle.z()), {width(), kBoardThickness, height()}, kBoard);
}

void MechanismDisplay::drawTrail(MarkerCanvas& canvas) const {
  std::vector<Eigen::Vector3d> path;
  path.reserve(trail_.size() + 1);
  for (const auto& point : trail_) {
    path.push_back(pictureScale() * point.position);
  }
  path.push_back(pictureScale() * toVector(sketch_.tracer));
  canvas.line("trail", path, 0.012, kTrail, true);
}

std::vector<std::string> MechanismDisplay::lines(const SystemStatus& status) const {
  std::vector<std::string> lines = {coordinateText(coordinates_, state_.angle)};
  if (dynamics_ && dynamics_->hasShaft()) {
    lines.push_back(speedText(shaft_.speed));
  }
  lines.push_back(energyText(state_));
  if (status.live.margin) {
    const auto& margin = *status.live.margin;
    if (!margin.coordinate.empty()) {
      lines.push_back("about " +
                      coordinateText(coordinatesOf(margin.coordinate, dynamics_.get()),
                                     margin.operating_point) +
                      ":");
    }
    const auto margins = marginLines(margin);
    lines.insert(lines.end(), margins.begin(), margins.end());
  }
  return lines;
}

void MechanismDisplay::draw(const SystemStatus& status, MarkerCanvas& canvas) const {
  if (coordinates_.empty()) {
    return;
  }
  const Color mass = severityColor(status.alerts, kCalmMass);
  const Eigen::Vector3d middle = centre();
  drawBoard(canvas);
  if (sketch_.empty()) {
    bars_.draw(mass, canvas);
  } else {
    drawSketch(sketch_, pictureScale(), mass, canvas);
    if (!measured_.empty()) {
      MarkerCanvas hull = canvas.beside("measured", kHullLifetime);
      drawHull(measured_, pictureScale(), hull);
    }
    if (sketch_.has_tracer) {
      drawTrail(canvas);
    }
    if (std::abs(pictureScale() - 1.0) > 0.005) {
      const double before = sketch_.spatial ? -0.3 * width() - 0.14 : -0.3;  // the base
      canvas.text("scale", {middle.x(), before, middle.z() - 0.5 * height()}, 0.06,
                  fmt::format("lengths x {:.2g}", pictureScale()), kTrail);
    }
  }
  const Eigen::Vector3d foot(middle.x(), 0.0, middle.z() + 0.5 * height() + kMechanismTextGap);
  const bool shaft = dynamics_ && dynamics_->hasShaft();
  drawStatus(name_, lines(status), shaft ? shaft_.speed : kNoShaft, status, foot, canvas);
}

}  // namespace whirl_twin
