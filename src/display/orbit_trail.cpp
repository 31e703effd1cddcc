#include "display/orbit_trail.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {
namespace {

// rad between points of the line: a 40-gon appears round at the drawn size.
constexpr double kSmoothAdvance = 0.15;
// rad between states beyond which the interpolation polynomial is meaningless.
constexpr double kWidestGap = 2.0;

Eigen::Vector2d hermite(const Eigen::Vector2d& p0, const Eigen::Vector2d& v0,
                        const Eigen::Vector2d& p1, const Eigen::Vector2d& v1, double duration,
                        double s) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * p0 + (s3 - 2.0 * s2 + s) * duration * v0 +
         (3.0 * s2 - 2.0 * s3) * p1 + (s3 - s2) * duration * v1;
}

}  // namespace

OrbitTrail::OrbitTrail(double turns) : turns_(turns) {}

void OrbitTrail::clear() {
  samples_.clear();
  extent_ = 0.0;
}

// Advance of the picture in radians: the rotation of the shaft, or the path of the disc centre
// divided by the size of its orbit (for a circular orbit the rotation of the whirl).
double OrbitTrail::advance(const Sample& from, const Sample& to) const {
  const double turn = std::abs(to.shaft_angle - from.shaft_angle);
  const double way = to.velocity.norm() * (to.time - from.time);
  return extent_ > 0.0 ? std::max(turn, way / extent_) : turn;
}

void OrbitTrail::add(const WhirlState& state) {
  const Sample sample{
      state.time, state.shaft_angle, {state.x, state.y}, {state.x_rate, state.y_rate}};
  if (!sample.position.allFinite() || !sample.velocity.allFinite()) {
    clear();
    return;
  }
  extent_ = std::max(extent_, sample.position.norm());
  if (!samples_.empty()) {
    if (sample.time < newest_.time || advance(newest_, sample) > kWidestGap) {
      clear();
      extent_ = sample.position.norm();
    }
  }
  newest_ = sample;
  const double step = kTwoPi * turns_ / kMaxPoints;
  if (samples_.empty() || advance(samples_.back(), sample) >= std::min(step, kSmoothAdvance)) {
    samples_.push_back(sample);
  }
  while (samples_.size() > kMaxPoints ||
         std::abs(sample.shaft_angle - samples_.front().shaft_angle) > kTwoPi * turns_) {
    samples_.pop_front();
  }
}

std::vector<Eigen::Vector2d> OrbitTrail::points() const {
  std::vector<Eigen::Vector2d> line;
  if (samples_.empty()) {
    return line;
  }
  line.reserve(kMaxPoints);
  // Newest first, so that the limit removes the oldest.
  const Sample* to = &newest_;
  line.push_back(to->position);
  for (auto from = samples_.rbegin(); from != samples_.rend(); ++from) {
    const double duration = to->time - from->time;
    const int pieces = std::max(1, static_cast<int>(advance(*from, *to) / kSmoothAdvance));
    for (int i = pieces - 1; i >= 0 && line.size() < kMaxPoints; --i) {
      line.push_back(hermite(from->position, from->velocity, to->position, to->velocity, duration,
                             static_cast<double>(i) / pieces));
    }
    to = &*from;
  }
  std::reverse(line.begin(), line.end());
  return line;
}

}  // namespace whirl_twin
