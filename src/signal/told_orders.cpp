#include "signal/told_orders.h"

#include <cmath>
#include <limits>

namespace whirl_twin {

state::OrderState toldOrders(const OrbitEstimate& e) {
  state::OrderState s;
  s.valid = e.valid;
  s.delay = e.delay;
  s.window = e.window;
  s.speed = e.speed;
  s.mean_x = e.mean.real();
  s.mean_y = e.mean.imag();
  s.peak_to_peak = e.peak_to_peak;
  s.precession = e.precession;
  s.forward = e.precession >= 0.0;
  s.noise = e.noise;
  for (const OrderVector& order : e.orders) {
    s.order.push_back(order.order);
    s.forward_amplitude.push_back(std::abs(order.forward));
    s.forward_lag.push_back(order.forwardLag());
    s.backward_amplitude.push_back(std::abs(order.backward));
    s.backward_lag.push_back(order.backwardLag());
    s.deviation.push_back(order.deviation);
  }
  for (const SpectralLine& line : e.lines) {
    s.line_frequency.push_back(line.frequency);
    s.line_ratio.push_back(e.speed == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                          : line.frequency / std::fabs(e.speed));
    s.line_forward.push_back(e.speed < 0.0 ? line.backward : line.forward);
    s.line_backward.push_back(e.speed < 0.0 ? line.forward : line.backward);
    s.line_growth.push_back(line.growth);
  }
  return s;
}

}  // namespace whirl_twin
