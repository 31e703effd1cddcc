// The speed of a shaft, by the torque of its motor: what it takes to follow a planned set-point
// (speed_planner.h), and a PI law for what is left. With samples T apart, w the speed that is
// measured, w* the set-point and e = w* - w,
//
//   u(k)     = J (w*(k + 1) - w*(k)) / T + d w*(k) + kp e(k) + I(k)
//   I(k + 1) = I(k) + T (ki e(k) + (cut(u(k)) - u(k)) / tracking_time),   I(0) = 0
//
// cut() is what the motor can give at that speed, and the limit of the actuator; cut(u) is given.
// The set-point starts at the speed of the first sample, at rest in its acceleration, and keeps to
// what the motor can do less a reserve. Where no plan leads to the speed wanted, it stays there.
// Where parameters are changed while it runs, it is planned anew from the speed and acceleration
// that it has.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "control/speed_planner.h"
#include "controllers/anti_windup.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

using Eigen::MatrixXd;

constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();

class SpeedControl final : public Controller {
 public:
  SpeedControl(const ShaftLimits& limits, SpeedPlanner planner, const ParameterValues& values,
               const AntiWindup& anti_windup, const ControllerPlan& plan)
      : limits_(limits),
        planner_(std::move(planner)),
        target_(values.at("speed")),
        kp_(values.at("kp")),
        ki_(values.at("ki")),
        period_(1.0 / plan.rate),
        limit_(plan.limits[0]),
        anti_windup_(anti_windup),
        set_points_(planner_.staying(0.0)) {}

  void reset() noexcept override { started_ = false; }

  void update(const ControlSample& sample, double* outputs) noexcept override {
    const double speed = sample.values[0];
    if (!started_ && std::isfinite(speed)) {
      begin(speed, 0.0, sample.index);
    }
    if (!started_) {
      outputs[0] = speed;  // no number, and not taken for one
      return;
    }
    const double now = next_;
    last_ = sample.index;
    next_ = cursor_.at(set_points_, planTime(last_ + 1)).speed;
    const double e = now - speed;
    const double wanted = limits_.inertia * (next_ - now) / period_ + limits_.motor.drag * now;
    const double u = wanted + kp_ * e + integral_;
    const double most = std::min(limit_, limits_.torque(speed));
    const double cut = std::clamp(u, -most, most);
    integral_ += period_ * anti_windup_.integrand(kp_, ki_, e, u, cut);
    outputs[0] = cut;
  }

  /// The set-point goes on from where it is, speed and acceleration.
  void takeOver(const Controller& before) noexcept override {
    const auto* const other = dynamic_cast<const SpeedControl*>(&before.law());
    if (other == nullptr || !other->started_) {
      return;
    }
    const SpeedSegment next =
        PlanCursor{}.at(other->set_points_, other->planTime(other->last_ + 1));
    begin(next.speed, next.acceleration, other->last_ + 1);
    last_ = other->last_;
    integral_ = other->integral_;
  }

  /// Where the motor can give what is asked, about a set-point that stays.
  std::optional<DiscreteStateSpace> linear(double) const override {
    const Eigen::Index states = ki_ == 0.0 ? 0 : 1;
    return DiscreteStateSpace{MatrixXd::Ones(states, states),
                              MatrixXd::Constant(states, 1, -period_ * ki_),
                              MatrixXd::Ones(1, states), MatrixXd::Constant(1, 1, -kp_)};
  }

 private:
  /// [s], of a sample, since the set-points begin.
  double planTime(std::int64_t index) const noexcept {
    return period_ * static_cast<double>(index - first_);
  }

  void begin(double speed, double acceleration, std::int64_t index) noexcept {
    started_ = true;
    first_ = index;
    integral_ = 0.0;
    next_ = speed;
    cursor_ = {};
    if (!planner_.plan(speed, acceleration, target_, set_points_)) {
      set_points_.count = 0;
      set_points_.target = speed;
    }
  }

  ShaftLimits limits_;
  SpeedPlanner planner_;
  double target_;  // [rad/s]
  double kp_;      // [N m s/rad]
  double ki_;      // [N m/rad]
  double period_;  // [s]
  double limit_;   // [N m], of the actuator
  AntiWindup anti_windup_;
  SpeedPlan set_points_;
  PlanCursor cursor_;
  bool started_ = false;
  std::int64_t first_ = 0;  // sample
  std::int64_t last_ = 0;   // likewise
  double next_ = 0.0;       // [rad/s], set-point of the next sample
  double integral_ = 0.0;   // [N m]
};

Motor motorOf(const Settings& settings, double drag) {
  const std::vector<TableRow>& rows = settings.tables.at("motor");
  if (rows.empty() || rows.size() > Motor::kMostPoints) {
    throw SetupError(
        "motor", fmt::format("must have 1 to {} rows, found {}", Motor::kMostPoints, rows.size()));
  }
  Motor motor;
  motor.drag = drag;
  for (const TableRow& row : rows) {
    const MotorPoint point{row.numbers.at("speed"), row.numbers.at("torque")};
    if (motor.count > 0 && !(point.speed > motor.points[motor.count - 1].speed)) {
      throw SetupError(fmt::format("motor[{}].speed", motor.count),
                       fmt::format("must be > {} rad/s, the row before, found {}",
                                   motor.points[motor.count - 1].speed, point.speed));
    }
    motor.points[motor.count++] = point;
  }
  return motor;
}

ExclusionBands bandsOf(const Settings& settings) {
  std::vector<SpeedBand> bands;
  const auto given = settings.tables.find("avoid");
  if (given != settings.tables.end()) {
    for (const TableRow& row : given->second) {
      bands.push_back({row.numbers.at("from"), row.numbers.at("to")});
    }
  }
  try {
    return ExclusionBands(bands);
  } catch (const Refusal& error) {
    throw SetupError("avoid", error.what());
  }
}

std::unique_ptr<Controller> makeSpeed(const ParameterValues& values, const Settings& settings,
                                      const ControllerPlan& plan) {
  if (plan.measured != 1 || plan.outputs != 1) {
    throw SetupError("speed", fmt::format("is of one shaft: its speed is measured, a torque on it "
                                          "acted on, found {} measured, {} acted on",
                                          plan.measured, plan.outputs));
  }
  const ShaftLimits limits{motorOf(settings, values.at("drag")), values.at("inertia"),
                           values.at("reserve"), values.at("max_acceleration")};
  if (!(limits.reserve < 1.0)) {
    throw SetupError("reserve", fmt::format("must be < 1, found {}", limits.reserve));
  }
  const SpeedPlanner planner(limits, values.at("max_jerk"), bandsOf(settings));
  const double speed = values.at("speed");
  const double allowed = planner.allowed(speed, kRequired);
  if (allowed != speed) {
    throw SetupError("speed", fmt::format("must lie outside of the bands to avoid, found {}; "
                                          "nearest edge {:g}",
                                          speed, allowed));
  }
  SpeedPlan set_points = planner.staying(0.0);
  if (!planner.plan(0.0, 0.0, speed, set_points)) {
    throw SetupError("speed",
                     fmt::format("must be one that the motor reaches, with what it takes to cross "
                                 "the bands to avoid: up to {:.6g} rad/s, found {}",
                                 planner.highest(), speed));
  }
  return std::make_unique<SpeedControl>(limits, planner, values,
                                        antiWindupOf(values, settings, plan.rate), plan);
}

}  // namespace

ControllerInfo speedInfo() {
  ControllerInfo info;
  info.name = "speed";
  info.summary = "speed of a shaft by its motor's torque, along a planned set-point";
  info.parameters = {
      {"speed", "rad/s", Range::kAny, "to which it brings the shaft", std::nullopt, ""},
      {"max_acceleration", "rad/s^2", Range::kPositive, "of the set-point", std::nullopt, ""},
      {"max_jerk", "rad/s^3", Range::kPositive, "of the set-point", std::nullopt, ""},
      {"inertia", "kg m^2", Range::kPositive, "that the motor accelerates", std::nullopt, ""},
      {"drag", "N m s/rad", Range::kNotNegative, "that the motor has to overcome", 0.0, ""},
      {"reserve", "-", Range::kNotNegative,
       "share of the motor's torque that the set-point leaves alone, < 1", 0.1, ""},
      {"kp", "N m s/rad", Range::kNotNegative, "gain on what the speed is off its set-point", 0.0,
       ""},
      {"ki", "N m/rad", Range::kNotNegative, "integral gain", 0.0, ""},
      trackingTimeInfo(),
  };
  SettingInfo motor{"motor", SettingKind::kTable, "",
                    "the most torque it gives, either way, over the speed: straight lines between "
                    "rows, constant beyond"};
  motor.required = true;
  motor.columns = {{"speed", "rad/s", Range::kNotNegative, kRequired},
                   {"torque", "N m", Range::kNotNegative, kRequired}};
  SettingInfo avoid{"avoid", SettingKind::kTable, "",
                    "bands of speed that it passes at the largest acceleration and does not stay "
                    "in"};
  avoid.columns = {{"from", "rad/s", Range::kPositive, kRequired},
                   {"to", "rad/s", Range::kPositive, kRequired}};
  info.settings = {antiWindupSetting(), motor, avoid};
  info.make = makeSpeed;
  return info;
}

}  // namespace whirl_twin
