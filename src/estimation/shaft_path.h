// A shaft on its way from one instant to another: its angle is the cubic through angles and speeds.
#pragma once

#include <cstdint>
#include <vector>

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
  double duration() const { return turn_.length; }  ///< [s]
  double turned() const { return turn_.to; }        ///< [rad], in all
  double startAngle() const { return angle_; }      ///< [rad], without whole turns
  /// Instants that part the way into so many pieces, the last of them its end.
  std::vector<ShaftInstant> parted(std::int64_t pieces) const;

 private:
  ShaftInstant from_, to_;
  double start_;     // [s], simulated
  double angle_;     // [rad], at the start, without whole turns
  CubicPiece turn_;  // [rad], since the start
};

}  // namespace whirl_twin
