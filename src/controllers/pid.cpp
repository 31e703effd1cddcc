// A PID controller for each pair of measured quantity and output, axis by axis. With sampling
// period T, measurement y and e = setpoint - y,
//
//   u(k)     = kp e(k) + I(k) + D(k)
//   I(k + 1) = I(k) + T (ki e(k) + (cut(u(k)) - u(k)) / tracking_time),   I(0) = 0
//   D(k)     = (derivative_time D(k - 1) - kd (y(k) - y(k - 1))) / (derivative_time + T),  D(0) = 0
//
// (K. J. Astrom, R. M. Murray, Feedback Systems, Princeton 2008, sec. 10.5.) The derivative acts on
// the measurement, so that a set-point step gives no derivative kick; nor does the first sample,
// which has no predecessor. cut() is the limit of the actuator: the output is u itself, which the
// actuator limits and counts. Instead of that back-calculation, clamping stops the integral while
// it drives u further beyond the limit.
//
// Gains may be scheduled over the speed of a shaft. The integral is stored in units of the output,
// so that it has no jump where they change. On a change of gains during the run, I absorbs the
// change of the kp and kd terms at the last sample, so that u has no jump; without integral action,
// which would let that offset decay, I is unchanged.
#include <algorithm>
#include <cmath>
#include <utility>

#include "control/transfer_function.h"
#include "controllers/anti_windup.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/speed_table.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

struct Gains {
  double kp, ki, kd;
};

class Pid final : public Controller {
 public:
  Pid(SpeedTable gains, const ParameterValues& values, const AntiWindup& anti_windup,
      const ControllerPlan& plan)
      : gains_(std::move(gains)),
        setpoint_(values.at("setpoint")),
        period_(1.0 / plan.rate),
        anti_windup_(anti_windup),
        limits_(plan.limits),
        axes_(plan.outputs) {
    const double derivative_time = values.at("derivative_time");
    remembered_ = derivative_time / (derivative_time + period_);
    slope_gain_ = 1.0 / (derivative_time + period_);
  }

  void reset() noexcept override {
    std::fill(axes_.begin(), axes_.end(), Axis{});
    started_ = false;
    speed_ = 0.0;
  }
  void exchange(StateImage& image) noexcept override { image(axes_, started_, speed_); }

  void update(const ControlSample& sample, double* outputs) noexcept override {
    // If the keyphasor of the shaft is lost the last speed is used.
    speed_ = std::isfinite(sample.shaft_speed) ? sample.shaft_speed : speed_;
    const Gains g = gainsAt(speed_);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      Axis& axis = axes_[i];
      const double y = sample.values[i];
      const double e = setpoint_ - y;
      const double last = started_ ? axis.last : y;
      axis.slope = remembered_ * axis.slope + slope_gain_ * (y - last);
      axis.last = y;
      const double u = g.kp * e + axis.integral - g.kd * axis.slope;
      axis.integral += period_ * anti_windup_.integrand(g.kp, g.ki, e, u,
                                                        std::clamp(u, -limits_[i], limits_[i]));
      outputs[i] = u;
    }
    started_ = true;
  }

  void takeOver(const Controller& before) noexcept override {
    const auto* const other = dynamic_cast<const Pid*>(&before.law());
    if (other == nullptr) {
      return;
    }
    axes_ = other->axes_;
    started_ = other->started_;
    speed_ = other->speed_;
    const Gains had = other->gainsAt(speed_);
    const Gains has = gainsAt(speed_);
    if (started_ && has.ki != 0.0) {
      for (Axis& axis : axes_) {
        axis.integral +=
            (had.kp - has.kp) * (other->setpoint_ - axis.last) - (had.kd - has.kd) * axis.slope;
      }
    }
  }

  std::vector<double> setpoint() const override {
    return std::vector<double>(axes_.size(), setpoint_);
  }

  /// States, of each axis: I, then the part of the next D known before its sample.
  std::optional<DiscreteStateSpace> linear(double shaft_speed) const override {
    const Gains g = gainsAt(shaft_speed);
    const Index integrals = gains_.zero(1) ? 0 : 1;
    const Index states = integrals + (gains_.zero(2) ? 0 : 1);
    DiscreteStateSpace law{MatrixXd::Zero(states, states), MatrixXd::Zero(states, 1),
                           MatrixXd::Ones(1, states),
                           MatrixXd::Constant(1, 1, -(g.kp + g.kd * slope_gain_))};
    if (integrals > 0) {
      law.a(0, 0) = 1.0;
      law.b(0, 0) = -period_ * g.ki;
    }
    if (states > integrals) {
      law.a(integrals, integrals) = remembered_;
      law.b(integrals, 0) = (1.0 - remembered_) * slope_gain_ * g.kd;
    }
    return onEachAxis(law, static_cast<Index>(axes_.size()));
  }

 private:
  struct Axis {
    double integral = 0.0;
    double slope = 0.0;  // of y, filtered
    double last = 0.0;
  };

  Gains gainsAt(double speed) const noexcept {
    return {gains_.at(speed, 0), gains_.at(speed, 1), gains_.at(speed, 2)};
  }

  SpeedTable gains_;  // kp, ki, kd
  double setpoint_;
  double period_;      // [s]
  double remembered_;  // [-], of the last slope
  double slope_gain_;  // [1/s], of a difference
  AntiWindup anti_windup_;
  std::vector<double> limits_;
  std::vector<Axis> axes_;
  bool started_ = false;
  double speed_ = 0.0;  // [rad/s]
};

SpeedTable gainsOf(const ParameterValues& values, const Settings& settings) {
  SpeedTable gains(settings, "gains", {"kp", "ki", "kd"});
  for (const char* name : {"kp", "ki", "kd"}) {
    if (!gains.empty() && values.at(name) != 0.0) {
      throw SetupError(name, "must not be given with gains");
    }
  }
  return gains.empty() ? SpeedTable({values.at("kp"), values.at("ki"), values.at("kd")}) : gains;
}

std::unique_ptr<Controller> makePid(const ParameterValues& values, const Settings& settings,
                                    const ControllerPlan& plan) {
  requireAxes(plan, "kp");
  return std::make_unique<Pid>(gainsOf(values, settings), values,
                               antiWindupOf(values, settings, plan.rate), plan);
}

}  // namespace

ControllerInfo pidInfo() {
  ControllerInfo info;
  info.name = "pid";
  info.summary = "proportional, integral and derivative, axis by axis";
  info.parameters = {
      {"kp", "output/measured", Range::kAny, "proportional gain", 0.0, ""},
      {"ki", "output/measured/s", Range::kAny, "integral gain", 0.0, ""},
      {"kd", "output s/measured", Range::kAny, "derivative gain", 0.0, ""},
      {"derivative_time", "s", Range::kNotNegative,
       "time constant of the derivative's filter; 0: backward difference", 0.0, ""},
      {"setpoint", "measured", Range::kAny, "of the measured signal", 0.0, ""},
      trackingTimeInfo(),
  };
  info.settings = {antiWindupSetting(),
                   speedTableSetting("gains", "replaces kp, ki and kd, over the shaft's speed",
                                     {{"kp", "output/measured", Range::kAny, 0.0},
                                      {"ki", "output/measured/s", Range::kAny, 0.0},
                                      {"kd", "output s/measured", Range::kAny, 0.0}})};
  info.make = makePid;
  return info;
}

}  // namespace whirl_twin
