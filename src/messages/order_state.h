// The synchronous components (orders) of a whirl and its non-synchronous residual.
#pragma once

#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

/// A rotor's whirl, analysed over some turns: orders by a tracking filter (signal/order_filter.h),
/// non-synchronous components, precession of the motion about its mean.
struct OrderState {
  static constexpr MessageKind kKind{"orders", "OrderState", "*/orders"};

  Instant at;
  std::string system;
  bool valid = false;         ///< the shaft has made enough turns for orders
  double delay = 0.0;         ///< [s], delay of the following values
  double window = 0.0;        ///< [s], length of the data used
  double speed = 0.0;         ///< [rad/s], of the shaft, at that time
  double mean_x = 0.0;        ///< [m], where the orbit is centred: sag, gap
  double mean_y = 0.0;        ///< [m]
  double peak_to_peak = 0.0;  ///< [m], the larger of those along x and y
  double precession = 0.0;    ///< [-], 1 with the rotation, -1 against it, 0 on a line
  bool forward = true;        ///< the motion runs in the direction of rotation
  double noise = 0.0;         ///< [m], root mean square of the residual beside orders and
                              ///< non-synchronous components
  std::vector<double> order;  ///< [-], times the angle of the shaft
  std::vector<double> forward_amplitude;   ///< [m], of each
  std::vector<double> forward_lag;         ///< [rad], lag relative to the phase reference, -pi..pi
  std::vector<double> backward_amplitude;  ///< [m]
  std::vector<double> backward_lag;        ///< [rad]
  std::vector<double> deviation;           ///< [m], standard deviation of an amplitude, from noise
                                           ///< and change
  std::vector<double> line_frequency;      ///< [rad/s], largest first
  std::vector<double> line_ratio;          ///< [-], to the speed
  std::vector<double> line_forward;        ///< [m], amplitude in the direction of rotation
  std::vector<double> line_backward;       ///< [m], against it
  std::vector<double> line_growth;         ///< [1/s]

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head(TWIN_FIELD(system));
    visit(TWIN_FIELD(valid), "", requireFlag);
    visit.numbers("s", TWIN_FIELD(delay), TWIN_FIELD(window));
    visit(TWIN_FIELD(speed), "rad/s");
    visit.numbers("m", TWIN_FIELD(mean_x), TWIN_FIELD(mean_y), TWIN_FIELD(peak_to_peak));
    visit(TWIN_FIELD(precession), "-");
    visit(TWIN_FIELD(forward), "", requireFlag);
    visit(TWIN_FIELD(noise), "m");
    const auto order = TWIN_FIELD(order);
    visit.array(TWIN_FIELD(orders), order, "-");
    visit.along(order, TWIN_FIELD(forward_amplitude), "m");
    visit.along(order, TWIN_FIELD(forward_lag), "rad");
    visit.along(order, TWIN_FIELD(backward_amplitude), "m");
    visit.along(order, TWIN_FIELD(backward_lag), "rad");
    visit.along(order, TWIN_FIELD(deviation), "m");
    const auto line = TWIN_FIELD(line_frequency);
    visit.array(TWIN_FIELD(lines), line, "rad/s");
    visit.along(line, TWIN_FIELD(line_ratio), "-");
    visit.numbersAlong(line, "m", TWIN_FIELD(line_forward), TWIN_FIELD(line_backward));
    visit.along(line, TWIN_FIELD(line_growth), "1/s");
  }
};

}  // namespace whirl_twin::state
