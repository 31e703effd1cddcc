// A linear-quadratic-Gaussian regulator: an lqr on the states estimated by a Kalman filter, x~
// before the sample y and x^ after it,
//
//   x^ = x~(k) + M (y(k) - setpoint - c x~(k)),   u(k) = -K x^,   x~(k + 1) = A x^ + B cut(u(k)),
//
// x~(0) = 0, with the steady-state gains (K of `lqr`, M for the given noise). The filter includes
// the limits, cut(), which prevents windup; it includes no delay.
#include <algorithm>
#include <cmath>

#include "analysis/riccati.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/quadratic_settings.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct LqgGains {
  MatrixXd a, b, c;    ///< of the discretized plant
  MatrixXd feedback;   ///< K
  MatrixXd estimator;  ///< M
};

class Lqg final : public Controller {
 public:
  Lqg(LqgGains gains, VectorXd setpoint, const std::vector<double>& limits)
      : gains_(std::move(gains)),
        setpoint_(std::move(setpoint)),
        limits_(Eigen::Map<const VectorXd>(limits.data(), static_cast<Index>(limits.size()))),
        predicted_(VectorXd::Zero(gains_.a.rows())),
        estimate_(predicted_),
        surprise_(setpoint_.size()),
        cut_(limits_.size()) {}

  void reset() noexcept override { predicted_.setZero(); }
  void exchange(StateImage& image) noexcept override { image(predicted_); }

  void update(const ControlSample& sample, double* outputs) noexcept override {
    surprise_ = Eigen::Map<const VectorXd>(sample.values, setpoint_.size()) - setpoint_;
    surprise_.noalias() -= gains_.c * predicted_;
    estimate_ = predicted_;
    estimate_.noalias() += gains_.estimator * surprise_;
    Eigen::Map<VectorXd> u(outputs, limits_.size());
    u.noalias() = -gains_.feedback * estimate_;
    cut_ = u.cwiseMax(-limits_).cwiseMin(limits_);
    predicted_.noalias() = gains_.a * estimate_;
    predicted_.noalias() += gains_.b * cut_;
  }

  std::vector<Gain> gains() const override {
    return {{"feedback", gains_.feedback}, {"estimator", gains_.estimator}};
  }

  void takeOver(const Controller& before) noexcept override {
    if (const auto* const other = dynamic_cast<const Lqg*>(&before.law())) {
      predicted_ = other->predicted_;
    }
  }

  std::vector<double> setpoint() const override {
    return {setpoint_.data(), setpoint_.data() + setpoint_.size()};
  }

  std::optional<DiscreteStateSpace> linear(double) const override {
    const Index n = gains_.a.rows();
    const MatrixXd closed = gains_.a - gains_.b * gains_.feedback;
    const MatrixXd kept = MatrixXd::Identity(n, n) - gains_.estimator * gains_.c;
    return DiscreteStateSpace{closed * kept, closed * gains_.estimator, -gains_.feedback * kept,
                              -gains_.feedback * gains_.estimator};
  }

 private:
  LqgGains gains_;
  VectorXd setpoint_;
  VectorXd limits_;
  VectorXd predicted_;
  // Work space of update(), preallocated.
  VectorXd estimate_, surprise_, cut_;
};

/// Covariance accumulated in a period [s] from the density of the process noise.
MatrixXd gathered(const MatrixXd& a, const MatrixXd& density, double period) {
  const MatrixXd none = MatrixXd::Zero(a.rows(), 1);
  return sampledPlant(a.transpose(), none, {density, MatrixXd::Identity(1, 1)}, period).cost.state;
}

std::unique_ptr<Controller> makeLqg(const ParameterValues&, const Settings& settings,
                                    const ControllerPlan& plan) {
  const LinearPlant& plant = plantOf(plan);
  const Index n = plant.a.rows();
  const Index inputs = plant.b.cols();
  const double period = 1.0 / plan.rate;
  LqgGains gains;
  gains.feedback = regulatorGain(settings, plant, plan.rate);
  const MatrixXd process = weightOf(settings, "process_noise", n, "a number per state");
  const MatrixXd sensor =
      weightOf(settings, "sensor_noise", plant.c.rows(), "a number per measured signal");
  const SampledPlant sampled = sampledPlant(
      plant.a, plant.b, {MatrixXd::Zero(n, n), MatrixXd::Identity(inputs, inputs)}, period);
  gains.a = sampled.a;
  gains.b = sampled.b;
  gains.c = plant.c;
  gains.estimator = foundFor("process_noise", [&] {
    return discreteEstimator(gains.a, gains.c, gathered(plant.a, process, period), sensor).gain;
  });
  return std::make_unique<Lqg>(std::move(gains), setpointOf(settings, plan), plan.limits);
}

}  // namespace

ControllerInfo lqgInfo() {
  ControllerInfo info;
  info.name = "lqg";
  info.summary = "linear-quadratic regulator with states estimated by a Kalman filter";
  info.settings = regulatorSettings();
  SettingInfo process{"process_noise", SettingKind::kMatrix, "state^2/s",
                      "process-noise density of each state's rate: a row, or a symmetric "
                      "matrix"};
  SettingInfo sensor{"sensor_noise", SettingKind::kMatrix, "measured^2",
                     "variance of each sample: a row, or a symmetric matrix"};
  process.required = true;
  sensor.required = true;
  info.settings.push_back(process);
  info.settings.push_back(sensor);
  info.settings.push_back(setpointSetting());
  info.make = makeLqg;
  return info;
}

}  // namespace whirl_twin
