#include "mechanics/magnetic_bearing.h"

#include <cmath>

namespace whirl_twin {

namespace {

constexpr double kWithinGap = 0.1;  // a whirl that is large

}  // namespace

MagneticBearing::MagneticBearing(double ki, double bias, double gap, double saturation)
    : ki_(ki), bias_(bias), gap_(gap), saturation_(saturation), k_(0.25 * ki * gap * gap / bias) {}

MagneticBearing::Pole MagneticBearing::pole(double current, double gap) const noexcept {
  if (!(current > 0.0)) {
    return {0.0, 0.0, 0.0};
  }
  const double force = k_ * (current / gap) * (current / gap);
  if (force >= saturation_) {
    return {saturation_, 0.0, 0.0};
  }
  return {force, 2.0 * force / current, 2.0 * force / gap};
}

MagneticBearing::Force MagneticBearing::axis(double current, double place) const noexcept {
  const Pole ahead = pole(bias_ + current, gap_ - place);
  const Pole behind = pole(bias_ - current, gap_ + place);
  return {ahead.force - behind.force, ahead.by_current + behind.by_current,
          ahead.by_gap + behind.by_gap, ahead.force + behind.force};
}

bool MagneticBearing::push(const LocalState& at, NodalForce& out) const noexcept {
  if (!(std::fabs(at.place[0]) < gap_ && std::fabs(at.place[1]) < gap_)) {
    return false;
  }
  out.size = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Force f = axis(at.input[i], at.place[i]);
    out.force[i] = f.force - ki_ * at.input[i] - ks() * at.place[i];
    out.size += f.both;
  }
  return true;
}

LocalSlopes MagneticBearing::slopes(const LocalState& at) const noexcept {
  const Force x = axis(at.input[0], at.place[0]);
  const Force y = axis(at.input[1], at.place[1]);
  return {Eigen::Vector2d(ks() - x.by_place, ks() - y.by_place).asDiagonal(),
          Eigen::Matrix2d::Zero(),
          Eigen::Vector2d(x.by_current - ki_, y.by_current - ki_).asDiagonal()};
}

double MagneticBearing::length() const {
  return kWithinGap * gap_;
}

double MagneticBearing::room(const Eigen::Vector2d& place) const noexcept {
  return gap_ - place.cwiseAbs().maxCoeff();
}

}  // namespace whirl_twin
