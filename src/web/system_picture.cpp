#include "web/system_picture.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "mechanics/round_number.h"
#include "reports/figure.h"

namespace whirl_twin {

namespace {

constexpr double kDeflection = 0.07;  // of the picture's size, of a magnified motion
constexpr double kForgetting = 0.98;  // of the radius of late, from picture to picture
constexpr double kTiny = 1.0e-15;     // of the picture's size: no motion

}  // namespace

Sketch discRotorSketch(double x, double y, double angle) {
  constexpr int kRods = 12;          // of the bent shaft
  constexpr double kSpan = 0.9;      // between the bearings
  constexpr double kGround = -0.36;  // below the shaft
  const auto at = [&](double along) {
    const double bent = std::sin(kPi * (along / kSpan + 0.5));
    return SketchPoint{along, bent * x, bent * y};
  };
  Sketch sketch;
  sketch.size = 1.2;
  sketch.height = 0.75;
  sketch.centre = {0.0, 0.0, -0.08};
  sketch.spatial = true;
  for (int i = 0; i < kRods; ++i) {
    sketch.rods.push_back({at(kSpan * (static_cast<double>(i) / kRods - 0.5)),
                           at(kSpan * (static_cast<double>(i + 1) / kRods - 0.5)), 0.02,
                           SketchRole::kBody});
  }
  sketch.discs.push_back(
      {at(0.0), {1.0, 0.0, 0.0}, 0.22, 0.06, angle - 0.5 * kPi, SketchRole::kMass});
  for (const double end : {-0.5 * kSpan, 0.5 * kSpan}) {
    sketch.rods.push_back(
        {{end - 0.03, 0.0, 0.0}, {end + 0.03, 0.0, 0.0}, 0.05, SketchRole::kSupport});
    sketch.rods.push_back({{end, 0.0, -0.05}, {end, 0.0, kGround}, 0.015, SketchRole::kSupport});
    sketch.boxes.push_back({{end, 0.0, kGround}, {0.14, 0.14, 0.03}, 0.0, SketchRole::kSupport});
  }
  sketch.tracer = at(0.0);
  sketch.has_tracer = true;
  return sketch;
}

SystemPicture::SystemPicture(const Dynamics& dynamics) : rotor_(dynamics.isRotor()) {
  if (rotor_) {
    names_ = {"x", "y", "x_rate", "y_rate"};
  } else {
    for (const CoordinateInfo& one : dynamics.coordinates()) {
      names_.push_back(one.name);
    }
  }
  values_.resize(names_.size());
}

void SystemPicture::clearSamples() {
  times_.clear();
  speeds_.clear();
  path_.clear();
  for (std::vector<double>& values : values_) {
    values.clear();
  }
  passed_ = 0;
}

void SystemPicture::restart() {
  clearSamples();
  stride_ = 1;
  longest_ = 0.0;
}

void SystemPicture::sample(const PictureMotion& motion, const Dynamics& dynamics) {
  if (passed_++ % stride_ != 0) {
    return;
  }
  if (times_.size() == kMaxSamples) {  // every other of them, from now on, too
    const auto thin = [](auto& all) {
      for (std::size_t i = 0; 2 * i < all.size(); ++i) {
        all[i] = all[2 * i];
      }
      all.resize((all.size() + 1) / 2);
    };
    thin(times_);
    thin(speeds_);
    thin(path_);
    for (std::vector<double>& values : values_) {
      thin(values);
    }
    stride_ *= 2;
  }
  times_.push_back(motion.at.time);
  speeds_.push_back(motion.shaft.speed);
  if (rotor_) {
    const WhirlMotion& whirl = motion.whirl;
    values_[0].push_back(whirl.x);
    values_[1].push_back(whirl.y);
    values_[2].push_back(whirl.x_rate);
    values_[3].push_back(whirl.y_rate);
    longest_ = std::max(longest_, whirl.radius());
    return;
  }
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i].push_back(motion.q[static_cast<Eigen::Index>(i)]);
  }
  path_.push_back(sketch(motion, dynamics).tracer);
}

/// The magnification stays while the motion is well visible, so that the picture is calm.
void SystemPicture::magnify(double radius, double size) {
  longest_ = std::max(radius, kForgetting * longest_);
  if (!std::isfinite(longest_) || longest_ < kTiny * size) {
    return;
  }
  const double shown = magnification_ * longest_ / size;
  if (shown > kDeflection || shown < 0.2 * kDeflection) {
    magnification_ = roundDown125(kDeflection * size / longest_);
  }
}

Sketch SystemPicture::rotorSketch(const PictureMotion& motion, const Dynamics& dynamics) {
  const EvaluationPoint<double>& at = motion.shaft;
  const Sketch still = dynamics.sketch(Eigen::VectorXd::Zero(dynamics.dof()), at);
  if (still.empty() || motion.q.size() == 0) {
    magnify(motion.whirl.radius(), 1.0);
    return discRotorSketch(magnification_ * motion.whirl.x, magnification_ * motion.whirl.y,
                           at.angle);
  }
  Eigen::VectorXd q = motion.q;
  double radius = 0.0;
  for (const Station& station : dynamics.stations()) {
    radius = std::max(radius, std::hypot(station.along_x.dot(q), station.along_y.dot(q)));
  }
  magnify(radius, still.size);
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (coordinates[i].name != "spin") {  // the angle of a shaft that a motor turns
      q[static_cast<Eigen::Index>(i)] *= magnification_;
    }
  }
  return dynamics.sketch(q, at);
}

Sketch SystemPicture::sketch(const PictureMotion& motion, const Dynamics& dynamics) {
  return rotor_ ? rotorSketch(motion, dynamics) : dynamics.sketch(motion.q, motion.shaft);
}

/// Of a rotor from its samples, magnified as its sketch is now; x: where it is along the shaft [m].
Json SystemPicture::path(double x) const {
  Json points = Json::array();
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const SketchPoint at =
        rotor_ ? SketchPoint{x, magnification_ * values_[0][i], magnification_ * values_[1][i]}
               : path_[i];
    points.push_back({at.x, at.y, at.z});
  }
  return points;
}

Json SystemPicture::take(const PictureMotion& motion, const Dynamics& dynamics) {
  const bool runs = motion.stopped.empty() && (rotor_ || motion.q.size() > 0);
  const Sketch drawn = runs ? sketch(motion, dynamics) : Sketch{};
  Json json = {{"step", motion.at.step},
               {"time", motion.at.time},
               {"stopped", motion.stopped},
               {"speed", motion.shaft.speed},
               {"angle", motion.shaft.angle},
               {"magnification", rotor_ ? magnification_ : 1.0},
               {"names", names_},
               {"sketch", drawn.empty() ? Json() : sketchJson(drawn)},
               {"samples",
                {{"time", times_},
                 {"speed", speeds_},
                 {"values", values_},
                 {"path", drawn.has_tracer ? path(drawn.tracer.x) : Json::array()}}}};
  clearSamples();
  stride_ = std::max<std::size_t>(1, stride_ / 2);
  return json;
}

}  // namespace whirl_twin
