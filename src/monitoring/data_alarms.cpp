#include "monitoring/data_alarms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "algebra/constants.h"

namespace whirl_twin {
namespace {

constexpr double kNeverReceived = -kInfinity;

}  // namespace

DataLostAlarm::DataLostAlarm(const std::vector<std::string>& systems,
                             const SharedSettings& settings)
    : settings_(settings),
      all_(alert_type::kEverybody, alert_type::kDataLost, settings, ""),
      last_arrival_(kNeverReceived),
      flowing_since_(kNeverReceived) {
  for (const std::string& system : systems) {
    systems_.push_back({Alarm(system, alert_type::kDataLost, settings), kNeverReceived});
  }
}

void DataLostAlarm::received(const std::string& source, double wall_time, double time,
                             AlertList& alerts) {
  if (wall_time - last_arrival_ > settings_->data_timeout) {
    flowing_since_ = wall_time;
  }
  last_arrival_ = wall_time;
  for (System& system : systems_) {
    if (system.alarm.subject() == source) {
      system.received_at = wall_time;
    }
    evaluate(system, wall_time, time, alerts);
  }
}

void DataLostAlarm::tick(double wall_time, double time, bool paused, AlertList& alerts) {
  if (last_arrival_ == kNeverReceived) {
    return;
  }
  const bool lost = wall_time - last_arrival_ > settings_->data_timeout && !paused;
  all_.updateAt(
      wall_time, time, warningIf(lost), alerts,
      [](state::Alert& alert) {
        alert.text = "no states are received: nothing is monitored";
        return "all data lost";
      },
      [] { return "states are received again"; });
}

void DataLostAlarm::evaluate(System& system, double wall_time, double time,
                             AlertList& alerts) const {
  // After a pause the silence counts from when the first source came back.
  const double silence = wall_time - std::max(system.received_at, flowing_since_);
  const AlarmCondition condition = silence > settings_->data_timeout      ? AlarmCondition::kWarning
                                   : system.received_at >= flowing_since_ ? AlarmCondition::kClear
                                                                          : AlarmCondition::kHold;
  system.alarm.updateAt(
      wall_time, time, condition, alerts,
      [&](state::Alert& alert) {
        alert.text = fmt::format(
            "no state for {:.1f} s of wall time, while those of other systems arrive", silence);
        return "data lost";
      },
      [&] { return "states are received again"; });
}

void LcmLostAlarm::update(double wall_time, double time, std::uint64_t failed, AlertList& alerts) {
  const std::uint64_t lost = before_ && failed > *before_ ? failed - *before_ : 0;
  before_ = failed;
  alarm_.updateAt(
      wall_time, time, warningIf(lost > 0), alerts,
      [&](state::Alert& alert) {
        alert.text = fmt::format(
            "LCM could not send {} messages, {} since the twin was started: LCM logs and "
            "subscribers miss them; check the multicast route",
            lost, failed);
        return "LCM";
      },
      [&] {
        return fmt::format("LCM sends again; {} messages were lost since the twin was started",
                           failed);
      });
}

void StateAlarm::updateEnergy(double time, double residual, AlertList& alerts) {
  const AlarmSettings& settings = energy_.settings();
  const double limit = std::fmax(settings.energy_residual, tolerance_);
  AlarmCondition condition =
      levelCondition(std::abs(residual), limit, kInfinity, settings.hysteresis);
  const bool above = isRaising(condition);
  if (above && !energy_above_) {
    condition = AlarmCondition::kHold;
  }
  energy_above_ = above;
  energy_.update(
      time, condition, alerts,
      [&](state::Alert& alert) {
        alert.text =
            fmt::format("energy residual {:.2g}, above {:g}: shorten the step", residual, limit);
        return "energy residual";
      },
      [&] { return fmt::format("energy residual normal again, {:.2g}", residual); });
}

void StateAlarm::updateAccuracy(double time, double estimate, double tolerance, AlertList& alerts) {
  tolerance_ = tolerance;  // NaN: not chosen by `auto`
  accuracy_.update(
      time, levelCondition(estimate, tolerance, kInfinity, accuracy_.settings().hysteresis), alerts,
      [&](state::Alert& alert) {
        alert.text = fmt::format(
            "error about {:.1g} over the horizon, above the tolerance {:g}: shorten the step",
            estimate, tolerance);
        return "accuracy";
      },
      [&] { return fmt::format("error within the tolerance again, {:.1g}", estimate); });
}

void StateAlarm::updateStopped(double time, StepStatus status, const std::string& why,
                               AlertList& alerts) {
  const std::string& system = stopped_.subject();
  // Over the network it may come without.
  const std::string text = why.empty() ? system + ": stopped, cause not reported" : why;
  const bool stopped = status != StepStatus::kOk;
  const bool cleared = stopped_.step(time, dangerIf(stopped)) == ConditionAlarm::Change::kCleared;
  const char* const type =
      status == StepStatus::kNotFinite ? alert_type::kNotFinite : alert_type::kStopped;
  if (stopped_type_ != nullptr && (cleared || (stopped && type != stopped_type_))) {
    alerts.clear(system, stopped_type_, time, cleared ? system + ": runs again" : text);
    stopped_type_ = nullptr;
  }
  if (stopped_.active() && stopped) {
    stopped_type_ = type;
    state::Alert alert;
    alert.system = system;
    alert.type = type;
    alert.severity = stopped_.state().severity();
    alert.time = time;
    alert.text = text;
    alerts.raise(std::move(alert), text);
  }
}

void ValidityAlarm::setDynamics(std::shared_ptr<const Dynamics> dynamics) {
  dynamics_ = std::move(dynamics);
  has_conditions_ = hasConditions(*dynamics_);
}

void ValidityAlarm::update(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const EvaluationPoint<double>& at, AlertList& alerts) {
  if (!has_conditions_) {
    return;
  }
  std::string broken;
  try {
    broken = brokenText(validity(*dynamics_, q, v, at), Margins::kLeftOut);
  } catch (const std::exception&) {  // numbers beyond the range of double: nothing is known
    hold();
    return;
  }
  alarm_.update(
      at.time, warningIf(!broken.empty()), alerts,
      [&](state::Alert& alert) {
        alert.text = fmt::format("its equations are not valid: {}", broken);
        return broken;
      },
      [&] { return "its equations are valid again"; });
}

}  // namespace whirl_twin
