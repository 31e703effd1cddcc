// Energy-based swing-up of a pendulum and its stabilization upright.
//
// With theta = 0 hanging and w0 the frequency of small oscillations there, the energy relative to
// that of a lift from the pivot's height is e = theta'^2 / (2 w0^2) - cos(theta); upright and at
// rest e = 1. A torque drives it with theta', an acceleration of its pivot along the horizontal
// against theta' cos(theta):
//
//   u = drive cut(energy_gain (1 - e)) sign(theta'),  or  -drive cut(...) sign(theta' cos(theta)),
//
// cut() to +-1 (K. J. Astrom, K. Furuta, "Swinging up a pendulum by energy control", Automatica 36
// (2000) 287). Within `catch` of the upright, sqrt(phi^2 + (theta' / w0)^2), phi the angle from it,
// a state feedback takes over, u = -gain (phi, theta', what else is measured); beyond `release` it
// swings again. Between the two it keeps its mode (hysteresis).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"

namespace whirl_twin {

namespace {

class SwingUp final : public Controller {
 public:
  SwingUp(const ParameterValues& values, bool by_torque, const Eigen::MatrixXd& gain)
      : frequency_(values.at("frequency")),
        drive_(values.at("drive")),
        energy_gain_(values.at("energy_gain")),
        catch_(values.at("catch")),
        release_(values.at("release")),
        by_torque_(by_torque),
        gain_(gain.data(), gain.data() + gain.size()) {}

  void reset() noexcept override { caught_ = false; }
  void exchange(StateImage& image) noexcept override { image(caught_); }

  void takeOver(const Controller& before) noexcept override {
    if (const auto* const other = dynamic_cast<const SwingUp*>(&before.law())) {
      caught_ = other->caught_;
    }
  }

  void update(const ControlSample& sample, double* outputs) noexcept override {
    const double* y = sample.values;
    const double from_upright = std::remainder(y[0] - kPi, 2.0 * kPi);
    const double away = std::hypot(from_upright, y[1] / frequency_);
    caught_ = away <= (caught_ ? release_ : catch_);
    outputs[0] = caught_ ? holding(from_upright, y) : swinging(y[0], y[1]);
  }

  std::optional<DiscreteStateSpace> linear(double) const override { return std::nullopt; }

 private:
  double holding(double from_upright, const double* y) const noexcept {
    double u = -gain_[0] * from_upright;
    for (std::size_t i = 1; i < gain_.size(); ++i) {
      u -= gain_[i] * y[i];
    }
    return u;
  }

  double swinging(double angle, double rate) const noexcept {
    const double turning = rate / frequency_;
    const double missing = 1.0 - (0.5 * turning * turning - std::cos(angle));
    const double along = by_torque_ ? rate : -rate * std::cos(angle);
    return std::copysign(drive_, along) * std::clamp(energy_gain_ * missing, -1.0, 1.0);
  }

  double frequency_;        // [rad/s]
  double drive_;            // of the output
  double energy_gain_;      // [-]
  double catch_, release_;  // [rad]
  bool by_torque_;
  std::vector<double> gain_;
  bool caught_ = false;
};

std::unique_ptr<Controller> makeSwingUp(const ParameterValues& values, const Settings& settings,
                                        const ControllerPlan& plan) {
  const Eigen::MatrixXd& gain = settings.matrices.at("gain");
  if (plan.measured < 2 || plan.outputs != 1) {
    throw SetupError("gain", fmt::format("must measure an angle, its rate and further signals, and "
                                         "act on one input, found {} measured, {} acted on",
                                         plan.measured, plan.outputs));
  }
  requireSize("gain", gain, 1, static_cast<Eigen::Index>(plan.measured),
              "a number per measured signal");
  if (!(values.at("release") >= values.at("catch"))) {
    throw SetupError("release", fmt::format("must be >= catch = {} rad, found {}",
                                            values.at("catch"), values.at("release")));
  }
  if (!(values.at("drive") <= plan.limits[0])) {
    throw SetupError(
        "drive",
        fmt::format("must be <= actuator.limit = {}, both in the unit of the input, found {}",
                    plan.limits[0], values.at("drive")));
  }
  return std::make_unique<SwingUp>(values, settings.choices.at("by") == "torque", gain);
}

}  // namespace

ControllerInfo swingUpInfo() {
  ControllerInfo info;
  info.name = "swing_up";
  info.summary = "swings a pendulum up by energy control and stabilizes it upright";
  info.parameters = {
      {"frequency", "rad/s", Range::kPositive, "natural frequency of the hanging pendulum, angle 0",
       std::nullopt, ""},
      {"drive", "output", Range::kPositive, "largest output during the swing-up", std::nullopt, ""},
      {"energy_gain", "-", Range::kPositive,
       "full drive while the energy error (2 from hanging to upright) is >= 1/energy_gain", 10.0,
       ""},
      {"catch", "rad", Range::kPositive, "angle from upright at which the feedback starts", 0.3,
       ""},
      {"release", "rad", Range::kPositive, "angle from upright at which the feedback stops", 0.6,
       ""},
  };
  SettingInfo gain{"gain", SettingKind::kMatrix, "output/measured",
                   "of the state feedback: a row, for angle, rate, further signals "
                   "measured"};
  gain.required = true;
  SettingInfo by{
      "by", SettingKind::kChoice, "",
      "kind of output: a torque on the pendulum, or horizontal acceleration or force at its pivot"};
  by.choices = {"torque", "pivot"};
  info.settings = {gain, by};
  info.make = makeSwingUp;
  return info;
}

}  // namespace whirl_twin
