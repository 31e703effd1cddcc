#include "controllers/notch.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "controllers/speed_table.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

struct Notch {
  double rate;       ///< [1/s]
  SpeedTable phase;  ///< [rad]
  double hold;       ///< [-]
  bool pairs;        ///< of probes

  /// e^(j phase); for a shaft in backward rotation its complex conjugate.
  Complex turn(double speed) const noexcept {
    return std::polar(1.0, std::copysign(1.0, speed) * phase.at(speed, 0));
  }
};

class NotchedController final : public Controller {
 public:
  NotchedController(Notch notch, std::unique_ptr<Controller> controller, const ControllerPlan& plan)
      : notch_(std::move(notch)),
        controller_(std::move(controller)),
        rate_(plan.rate),
        parts_(notch_.pairs ? plan.measured / 2 : plan.measured),
        shown_(plan.measured) {}

  void reset() noexcept override {
    std::fill(parts_.begin(), parts_.end(), Complex());
    last_speed_ = kUnknown;
    controller_->reset();
  }
  void exchange(StateImage& image) noexcept override {
    image(parts_, last_speed_);
    controller_->exchange(image);
  }

  void takeOver(const Controller& before) noexcept override {
    if (const auto* const other = dynamic_cast<const NotchedController*>(&before)) {
      parts_ = other->parts_;
      last_speed_ = other->last_speed_;
    }
    controller_->takeOver(before);
  }
  const Controller& law() const noexcept override { return controller_->law(); }

  void update(const ControlSample& sample, double* outputs) noexcept override {
    const double speed = sample.shaft_speed;
    ControlSample shown = sample;
    // Without a speed there is no angle: nothing is subtracted, and the coefficients are kept.
    if (std::isfinite(speed) && speed != 0.0) {
      takeOff(sample, steady(speed));
      shown.values = shown_.data();
    }
    last_speed_ = speed;
    controller_->update(shown, outputs);
  }

  std::vector<double> setpoint() const override { return controller_->setpoint(); }
  bool holds(double speed, double acceleration) const override {
    return !learnsAt(speed, acceleration) || controller_->holds(speed, acceleration);
  }

  /// States: of each pair or probe real and imaginary part of c e^(j theta), then the controller's.
  std::optional<DiscreteStateSpace> linear(double speed) const override {
    const std::optional<DiscreteStateSpace> law = controller_->linear(speed);
    if (!law || !std::isfinite(speed) || speed == 0.0) {
      return law;
    }
    const DiscreteStateSpace filter = filterAt(speed);
    const Index n = filter.states();
    const Index m = law->states();
    DiscreteStateSpace both;
    both.a = MatrixXd::Zero(n + m, n + m);
    both.a.topLeftCorner(n, n) = filter.a;
    both.a.bottomLeftCorner(m, n) = law->b * filter.c;
    both.a.bottomRightCorner(m, m) = law->a;
    both.b.resize(n + m, filter.b.cols());
    both.b << filter.b, law->b;
    both.c.resize(law->c.rows(), n + m);
    both.c << law->d * filter.c, law->c;
    both.d = law->d;
    return both;
  }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  bool learnsAt(double speed, double acceleration) const noexcept {
    return std::abs(acceleration) <= notch_.hold * notch_.rate * std::abs(speed);
  }

  /// Slow enough to adapt: never at the first sample with a speed, which may have any value.
  bool steady(double speed) const noexcept {
    return learnsAt(speed, (speed - last_speed_) * rate_);
  }

  void takeOff(const ControlSample& sample, bool learn) noexcept {
    const Complex angle = std::polar(1.0, sample.shaft_angle.remainder);
    const Complex learning =
        learn ? notch_.rate / rate_ * notch_.turn(sample.shaft_speed) * std::conj(angle)
              : Complex();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Complex turning = parts_[i] * angle;
      const double* y = sample.values + (notch_.pairs ? 2 * i : i);
      if (notch_.pairs) {
        shown_[2 * i] = y[0] - turning.real();
        shown_[2 * i + 1] = y[1] - turning.imag();
        parts_[i] += learning * Complex(shown_[2 * i], shown_[2 * i + 1]);
      } else {
        shown_[i] = y[0] - 2.0 * turning.real();
        parts_[i] += learning * shown_[i];
      }
    }
  }

  /// From the measurement to the controller's input.
  DiscreteStateSpace filterAt(double speed) const {
    const auto parts = static_cast<Index>(parts_.size());
    const Index width = notch_.pairs ? 2 : 1;
    const Complex turn = std::polar(1.0, speed / rate_);
    const Complex learning = notch_.rate / rate_ * notch_.turn(speed) * turn;
    const auto matrix = [](Complex z) {
      return (Eigen::Matrix2d() << z.real(), -z.imag(), z.imag(), z.real()).finished();
    };
    DiscreteStateSpace filter;
    filter.a = MatrixXd::Zero(2 * parts, 2 * parts);
    filter.b = MatrixXd::Zero(2 * parts, width * parts);
    filter.c = MatrixXd::Zero(width * parts, 2 * parts);
    const MatrixXd b = matrix(learning).leftCols(width);
    const MatrixXd c = (notch_.pairs ? -1.0 : -2.0) * MatrixXd::Identity(width, 2);
    const MatrixXd a = matrix(turn) + b * c;
    for (Index i = 0; i < parts; ++i) {
      filter.a.block(2 * i, 2 * i, 2, 2) = a;
      filter.b.block(2 * i, width * i, 2, width) = b;
      filter.c.block(width * i, 2 * i, width, 2) = c;
    }
    filter.d = MatrixXd::Identity(width * parts, width * parts);
    return filter;
  }

  Notch notch_;
  std::unique_ptr<Controller> controller_;
  double rate_;                 // [Hz]
  std::vector<Complex> parts_;  // c of each pair or probe
  std::vector<double> shown_;
  double last_speed_ = kUnknown;
};

Notch notchOf(const ParameterValues& values, const Settings& settings, const ControllerPlan& plan) {
  const double rate = values.at("notch_rate");
  if (!(rate < plan.rate)) {
    throw SetupError(
        "notch_rate",
        fmt::format("must be well below the controller's rate {} Hz, found {}", plan.rate, rate));
  }
  const bool pairs = settings.choices.at("notch_axes") == "pairs";
  if (pairs && plan.measured % 2 != 0) {
    throw SetupError("notch_axes",
                     fmt::format("pairs must have probes in pairs, the second 90 degrees ahead, "
                                 "found {} measured; single treats each by "
                                 "itself",
                                 plan.measured));
  }
  SpeedTable phases(settings, "notch_phases", {"phase"});
  if (phases.empty()) {
    phases = SpeedTable({values.at("notch_phase")});
  } else if (values.at("notch_phase") != 0.0) {
    throw SetupError("notch_phase", "must not be given with notch_phases");
  }
  return {rate, std::move(phases), values.at("notch_hold"), pairs};
}

}  // namespace

ControllerInfo withNotch(ControllerInfo info) {
  info.parameters.push_back({"notch_rate", "1/s", Range::kNotNegative,
                             "rate at which a notch adapts to the synchronous motion; 0: no notch",
                             0.0, ""});
  info.parameters.push_back({"notch_phase", "rad", Range::kAny,
                             "of the notch, best - arg S at the shaft's speed", 0.0, ""});
  info.parameters.push_back({"notch_hold", "-", Range::kNotNegative,
                             "it adapts while the relative speed change is less than this per "
                             "1/notch_rate",
                             0.1, ""});
  info.settings.push_back(
      speedTableSetting("notch_phases", "replaces notch_phase, over the shaft's speed",
                        {{"phase", "rad", Range::kAny, std::numeric_limits<double>::quiet_NaN()}}));
  SettingInfo axes{"notch_axes", SettingKind::kChoice, "",
                   "measured signals are pairs of probes, the second 90 degrees ahead, or each by "
                   "itself"};
  axes.choices = {"pairs", "single"};
  info.settings.push_back(axes);
  info.make = [make = info.make](const ParameterValues& values, const Settings& settings,
                                 const ControllerPlan& plan) -> std::unique_ptr<Controller> {
    std::unique_ptr<Controller> controller = make(values, settings, plan);
    if (values.at("notch_rate") == 0.0) {
      return controller;
    }
    return std::make_unique<NotchedController>(notchOf(values, settings, plan),
                                               std::move(controller), plan);
  };
  return info;
}

}  // namespace whirl_twin
