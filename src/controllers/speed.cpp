// Speed controller of a shaft, by the torque of its motor: feedforward along a planned set-point
// (speed_planner.h), and a PI law for the residual error. With sampling period T, measured speed w,
// set-point w* and e = w* - w,
//
//   u(k)     = J (w*(k + 1) - w*(k)) / T + d w*(k) + kp e(k) + I(k)
//   I(k + 1) = I(k) + T (ki e(k) + (cut(u(k)) - u(k)) / tracking_time),   I(0) = 0
//
// cut() limits to the motor torque available at that speed, and to the limit of the actuator; the
// output is cut(u). The set-point starts at the speed of the first sample with zero acceleration,
// and stays within the motor's capability less a reserve. Where no plan leads to the speed wanted,
// it stays there. On a parameter change during the run, it is planned again from its current speed
// and acceleration.
//
// A shaft captured by a resonance is freed and tries again (capture_supervisor.h), then without the
// reserve; one whose motor is known not to bring it through a range stays below.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"
#include "control/speed_planner.h"
#include "controllers/anti_windup.h"
#include "controllers/capture_supervisor.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/speed_trajectory.h"
#include "messages/input_error.h"
#include "models/settings.h"

namespace whirl_twin {

namespace {

using Eigen::MatrixXd;

/// Plans of set-points.
struct SpeedPlanners {
  SpeedPlanner first;    ///< to the target speed, past the bands
  SpeedPlanner retreat;  ///< through anything
  SpeedPlanner again;    ///< through the bands after a capture
};

class SpeedControl final : public Controller {
 public:
  SpeedControl(const ShaftLimits& limits, SpeedPlanners planners, CaptureSupervisor supervisor,
               const ParameterValues& values, const AntiWindup& anti_windup,
               const ControllerPlan& plan)
      : limits_(limits),
        planners_(std::move(planners)),
        supervisor_(std::move(supervisor)),
        impassable_(plan.impassable),
        wanted_(values.at("speed")),
        kp_(values.at("kp")),
        ki_(values.at("ki")),
        period_(1.0 / plan.rate),
        limit_(plan.limits[0]),
        anti_windup_(anti_windup) {
    for (const SpeedPlanner* planner : {&planners_.first, &planners_.retreat, &planners_.again}) {
      const SpeedPlan room = planner->staying(0.0);
      set_points_.pieces.resize(std::max(set_points_.pieces.size(), room.pieces.size()));
    }
  }

  void reset() noexcept override {
    started_ = false;
    supervisor_.reset(false);
  }
  void exchange(StateImage& image) noexcept override {
    image(supervisor_, set_points_.pieces, set_points_.count, set_points_.target,
          set_points_.duration, cursor_, started_, at_limit_, up_, target_, first_, last_, next_,
          integral_);
    image.requireWithin(set_points_.count, std::size_t{0}, set_points_.pieces.size());
    image.requireWithin(cursor_.piece, std::size_t{0}, set_points_.count);
  }

  void update(const ControlSample& sample, double* outputs) noexcept override {
    const double speed = sample.values[0];
    if (!std::isfinite(speed)) {
      outputs[0] = speed;  // not finite, and handled as such
      return;
    }
    if (!started_) {
      begin(speed, 0.0, sample.index);
    }
    supervise(speed, sample.index);
    const double now = next_;
    last_ = sample.index;
    next_ = cursor_.at(set_points_, planTime(last_ + 1)).speed;
    const double e = now - speed;
    const double wanted = limits_.inertia * (next_ - now) / period_ + limits_.motor.drag * now;
    const double u = wanted + kp_ * e + integral_;
    const double most = std::min(limit_, limits_.torque(speed));
    const double upwards = supervisor_.unloads() ? 0.0 : most;
    const double cut = up_ > 0.0 ? std::clamp(u, -most, upwards) : std::clamp(u, -upwards, most);
    at_limit_ = up_ * u >= most;
    integral_ += period_ * anti_windup_.integrand(kp_, ki_, e, u, cut);
    outputs[0] = cut;
  }

  /// The set-point continues from its current speed and acceleration; the count of captures
  /// restarts.
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

  state::Supervision supervision() const noexcept override { return supervisor_.state(); }

  /// Without an integral the feedforward of the drag counts as set-point.
  std::vector<double> setpoint() const override {
    const bool counts = ki_ == 0.0 && kp_ > 0.0;
    return {wanted_ * (counts ? 1.0 + limits_.motor.drag / kp_ : 1.0)};
  }

  /// Where the motor is not saturated, about a constant set-point.
  std::optional<DiscreteStateSpace> linear(double) const override {
    const Eigen::Index states = ki_ == 0.0 ? 0 : 1;
    return DiscreteStateSpace{MatrixXd::Ones(states, states),
                              MatrixXd::Constant(states, 1, -period_ * ki_),
                              MatrixXd::Ones(1, states), MatrixXd::Constant(1, 1, -kp_)};
  }

 private:
  struct SetPoint {
    double speed = 0.0, acceleration = 0.0;  // [rad/s], [rad/s^2]
  };

  /// [s], of a sample, since the start of the set-points.
  double planTime(std::int64_t index) const noexcept {
    return period_ * static_cast<double>(index - first_);
  }

  void begin(double speed, double acceleration, std::int64_t index) noexcept {
    started_ = true;
    integral_ = 0.0;
    at_limit_ = false;
    up_ = std::copysign(1.0, wanted_);
    target_ = wanted_;
    const bool refused =
        impassable_ && up_ * wanted_ > impassable_->from && up_ * speed < impassable_->to;
    supervisor_.reset(refused);
    if (refused) {
      target_ = up_ * supervisor_.runUpOf(*impassable_);
    }
    follow(planners_.first, {speed, acceleration}, target_, index);
  }

  void supervise(double speed, std::int64_t index) noexcept {
    switch (supervisor_.look({up_ * speed, up_ * target_, limits_.rise(speed), at_limit_,
                              cursor_.piece == set_points_.count})) {
      case CaptureSupervisor::Order::kNone:
        break;
      case CaptureSupervisor::Order::kUnload:
      case CaptureSupervisor::Order::kReturn:
        integral_ = 0.0;
        follow(planners_.retreat, {speed, 0.0}, up_ * supervisor_.runUpOf(supervisor_.band()),
               index);
        break;
      case CaptureSupervisor::Order::kRetry:
        follow(planners_.again, {next_, 0.0}, target_, index);
        break;
    }
  }

  /// A new plan, from the set-point of this sample on; a constant one, where there is none.
  void follow(const SpeedPlanner& planner, const SetPoint& from, double to,
              std::int64_t index) noexcept {
    first_ = index;
    next_ = from.speed;
    cursor_ = {};
    if (!planner.plan(from.speed, from.acceleration, to, set_points_)) {
      set_points_.count = 0;
      set_points_.target = from.speed;
    }
  }

  ShaftLimits limits_;
  SpeedPlanners planners_;
  CaptureSupervisor supervisor_;
  std::optional<SpeedBand> impassable_;
  double wanted_;  // [rad/s]
  double kp_;      // [N m s/rad]
  double ki_;      // [N m/rad]
  double period_;  // [s]
  double limit_;   // [N m], of the actuator
  AntiWindup anti_windup_;
  SpeedPlan set_points_;
  PlanCursor cursor_;
  bool started_ = false;
  bool at_limit_ = false;   // of its torque, in the direction up_, at the previous sample
  double up_ = 1.0;         // sign of the target speed
  double target_ = 0.0;     // [rad/s], to where it goes
  std::int64_t first_ = 0;  // sample
  std::int64_t last_ = 0;   // likewise
  double next_ = 0.0;       // [rad/s], set-point of the next sample
  double integral_ = 0.0;   // [N m]
};

Motor motorOf(const Settings& settings, double drag) {
  const std::vector<TableRow>& rows = settings.tables.at("motor");
  if (rows.empty() || rows.size() > Motor::kMaxPoints) {
    throw SetupError(
        "motor", fmt::format("must have 1 to {} rows, found {}", Motor::kMaxPoints, rows.size()));
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

/// The bands in its parameters and those about critical speeds.
ExclusionBands bandsOf(const Settings& settings, const ControllerPlan& plan) {
  std::vector<SpeedBand> bands = plan.critical_bands;
  const auto given = settings.tables.find("avoid");
  if (given != settings.tables.end()) {
    for (const TableRow& row : given->second) {
      bands.push_back({row.numbers.at("from"), row.numbers.at("to")});
    }
  }
  try {
    return ExclusionBands(bands);
  } catch (const InputError& error) {
    throw SetupError("avoid", error.what());
  }
}

ShaftLimits limitsOf(const ParameterValues& values, const Settings& settings) {
  return {motorOf(settings, values.at("drag")), values.at("inertia"), values.at("reserve"),
          values.at("max_acceleration")};
}

/// After a capture: with the full torque.
ShaftLimits limitsAgain(ShaftLimits limits, const ParameterValues& values) {
  limits.reserve = 0.0;
  limits.max_acceleration = values.at("retry_acceleration");
  return limits;
}

double runUpOf(const ParameterValues& values) {
  const double acceleration = values.at("retry_acceleration");
  return acceleration * acceleration / (2.0 * values.at("max_jerk"));
}

/// The bands in the upward direction; those separated by less than a run-up are merged.
std::vector<SpeedBand> upwardBands(const ExclusionBands& avoid, double run_up) {
  std::vector<SpeedBand> bands;
  for (const SpeedBand& band : avoid.bands()) {
    if (band.from < 0.0) {
      continue;
    }
    if (!bands.empty() && band.from - bands.back().to < run_up) {
      bands.back().to = band.to;
    } else {
      bands.push_back(band);
    }
  }
  return bands;
}

/// Checks that do not depend on bands.
void check(const ParameterValues& values, const ControllerPlan& plan) {
  if (plan.measured != 1 || plan.outputs != 1) {
    throw SetupError("speed", fmt::format("must measure the speed of one shaft and act on it with "
                                          "a torque, found {} measured, {} acted on",
                                          plan.measured, plan.outputs));
  }
  if (!(values.at("reserve") < 1.0)) {
    throw SetupError("reserve", fmt::format("must be < 1, found {}", values.at("reserve")));
  }
  if (values.at("retry_acceleration") < values.at("max_acceleration")) {
    throw SetupError("retry_acceleration",
                     fmt::format("must be at least max_acceleration, {} rad/s^2, found {}",
                                 values.at("max_acceleration"), values.at("retry_acceleration")));
  }
}

/// Checks that a planner reaches the target speed from rest.
void checkSpeed(const SpeedPlanner& planner, double speed, const std::string& for_what) {
  const double allowed = planner.allowed(speed, kNaN);
  if (allowed != speed) {
    throw SetupError(
        "speed",
        fmt::format(
            "must be outside the barred speed ranges{}, found {} rad/s; nearest edge {:g} rad/s",
            for_what, speed, allowed));
  }
  SpeedPlan set_points = planner.staying(0.0);
  if (!planner.plan(0.0, 0.0, speed, set_points)) {
    throw SetupError(
        "speed", fmt::format("must be at most {:.6g} rad/s in magnitude, up to which the motor's "
                             "torque, less reserve and drag, accelerates and brakes the "
                             "shaft{}; found {} rad/s",
                             planner.highest(), for_what, speed));
  }
}

std::unique_ptr<Controller> makeSpeed(const ParameterValues& values, const Settings& settings,
                                      const ControllerPlan& plan) {
  check(values, plan);
  const ShaftLimits limits = limitsOf(values, settings);
  const ShaftLimits again = limitsAgain(limits, values);
  const ExclusionBands avoid = bandsOf(settings, plan);
  const double jerk = values.at("max_jerk");
  const SpeedPlanners planners{{limits, jerk, avoid}, {again, jerk, {}}, {again, jerk, avoid}};
  checkSpeed(planners.first, values.at("speed"), "");
  checkSpeed(planners.again, values.at("speed"), " at retry_acceleration");
  const CaptureSupervisor supervisor({upwardBands(avoid, runUpOf(values)), runUpOf(values),
                                      values.at("retry_acceleration"), values.at("tries"),
                                      1.0 / plan.rate});
  return std::make_unique<SpeedControl>(limits, planners, supervisor, values,
                                        antiWindupOf(values, settings, plan.rate), plan);
}

}  // namespace

SpeedTrajectory speedWayOf(const ParameterValues& values, const Settings& settings,
                           const ControllerPlan& plan) {
  check(values, plan);
  const double run_up = runUpOf(values);
  return {limitsOf(values, settings), plan.limits[0], values.at("speed"), run_up,
          upwardBands(bandsOf(settings, plan), run_up)};
}

ControllerInfo speedInfo() {
  ControllerInfo info;
  info.name = "speed";
  info.summary = "speed control of a shaft by its motor's torque, along a planned set-point";
  info.parameters = {
      {"speed", "rad/s", Range::kAny, "target speed of the shaft", std::nullopt, ""},
      {"max_acceleration", "rad/s^2", Range::kPositive, "of the set-point", std::nullopt, ""},
      {"max_jerk", "rad/s^3", Range::kPositive, "of the set-point", std::nullopt, ""},
      {"inertia", "kg m^2", Range::kPositive, "accelerated by the motor", std::nullopt, ""},
      {"drag", "N m s/rad", Range::kNotNegative, "viscous drag on the shaft", 0.0, ""},
      {"reserve", "-", Range::kNotNegative,
       "fraction of the motor's torque kept in reserve by the set-point, < 1", 0.1, ""},
      {"kp", "N m s/rad", Range::kNotNegative, "proportional gain on the speed error", 0.0, ""},
      {"ki", "N m/rad", Range::kNotNegative, "integral gain", 0.0, ""},
      trackingTimeInfo(),
  };
  info.parameters.push_back({"retry_acceleration", "rad/s^2", Range::kPositive,
                             "of the set-point after a resonance capture", std::nullopt,
                             "max_acceleration"});
  info.parameters.push_back(
      {"tries", "-", Range::kCount,
       "attempts to cross a barred range after a capture, before it stays below", 3.0, ""});
  info.parameters.push_back(
      {"margin", "-", Range::kNotNegative,
       "half-width of a barred range, relative to the critical speed; 0: as API 617 requires", 0.0,
       ""});
  SettingInfo critical{"critical_speeds", SettingKind::kChoice, "",
                       "also bar ranges about the critical speeds of the driven systems"};
  critical.choices = {"false", "true"};
  SettingInfo weak{"weak_motor", SettingKind::kChoice, "",
                   "a barred range that needs more than the motor's torque: stay below, or try"};
  weak.choices = {"refuse", "try"};
  SettingInfo motor{
      "motor", SettingKind::kTable, "",
      "largest torque in both directions over the speed: linear between rows, constant outside"};
  motor.required = true;
  motor.columns = {{"speed", "rad/s", Range::kNotNegative, kRequired},
                   {"torque", "N m", Range::kNotNegative, kRequired}};
  SettingInfo avoid{
      "avoid", SettingKind::kTable, "",
      "barred speed ranges that it crosses at the largest acceleration and does not stay "
      "in"};
  avoid.columns = {{"from", "rad/s", Range::kPositive, kRequired},
                   {"to", "rad/s", Range::kPositive, kRequired}};
  info.settings = {antiWindupSetting(), motor, avoid, critical, weak};
  info.make = makeSpeed;
  return info;
}

}  // namespace whirl_twin
