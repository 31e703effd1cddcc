// A shaft on its way from one instant to another: its angle is the cubic through angles and speeds.
#pragma once

#include <cstdint>

#include "control/keyphasor.h"
#include "control/sensor.h"
#include "mechanics/moment.h"

namespace whirl_twin {

class ShaftPath {
 public:
  /// to_twin [ns]: what the instants are less than the twin's.
  ShaftPath(const ShaftInstant& from, const ShaftInstant& to, std::int64_t to_twin);

  /// At a part of the way there, from 0 to 1; its time is the twin's.
  Moment<double> at(double part) const;
  std::int64_t from() const { return from_.time; }  ///< [ns]
  double duration() const { return turn_.length; }  ///< [s]
  double turned() const { return turn_.to; }        ///< [rad], in all
  double startAngle() const { return angle_; }      ///< [rad], without whole turns
  /// At an instant [ns] on the way, not at its ends.
  ShaftInstant instantAt(std::int64_t time) const;

 private:
  ShaftInstant from_;
  double start_;     // [s], simulated
  double angle_;     // [rad], at the start, without whole turns
  CubicPiece turn_;  // [rad], since the start
};

}  // namespace whirl_twin
