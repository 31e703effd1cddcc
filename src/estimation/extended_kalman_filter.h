// Extended Kalman filter of one system of a running machine about the model's own equations. It
// estimates coordinates and rates together with unknown parameters, unbalances, sensor offsets and
// run-outs under probes. For a linear system with known parameters it is exact.
//
// State: coordinates, rates, the numbers of the parameters (estimator_model.h), an unbalance per
// station and a run-out per displacement probe in space-fixed axes, which rotate with the shaft
// (x + i y turned by its angle), and an offset per channel that has one. A step uses the matrix
// exponential of the linearized equations, of a nonlinear system about the middle of the step,
// whose motion is integrated by the classical Runge-Kutta method of order four; process noise by
// the series of van Loan (IEEE Trans. Automatic Control 23, 1978).
//
// While the shaft's angle is not known, the filter of a rotor uses its probes alone: the shaft
// continues at its last speed, synchronous forces at unknown angle count as process noise, and only
// the motion is estimated. Unbalances and run-outs keep their place on the shaft and are turned to
// its angle once that is known again.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/inputs.h"
#include "control/keyphasor.h"
#include "estimation/estimator_model.h"
#include "estimation/estimator_shaft.h"
#include "estimation/estimator_sources.h"
#include "estimation/follow_settings.h"
#include "estimation/kalman_filter.h"
#include "scene/built_scene.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

/// A channel of the filter.
struct EstimatorChannel {
  std::string name;  ///< "source/channel"
  SignalSpec signal;
  double deviation = 0.0;  ///< of its noise, in its unit
  double offset = 0.0;     ///< standard deviation of its offset; 0: the offset is known
  double run_out = 0.0;    ///< [m], standard deviation; 0: none
  /// Set: the channel measures an input and has no signal.
  std::optional<InputFollowing> input = std::nullopt;
};

/// The innovation of a measured value.
struct Innovation {
  double value = 0.0;      ///< measured less predicted, in the channel's unit
  double deviation = 0.0;  ///< predicted standard deviation
  bool used = false;       ///< false: rejected by the gate
  double surest = 0.0;     ///< the deviation without the uncertainty of the shaft's angle
  double normalized() const { return value / deviation; }
  double normalizedSurest() const { return value / surest; }
};

class ExtendedKalmanFilter {
 public:
  ExtendedKalmanFilter(const BuiltScene& scene, std::size_t system, const SystemFollowing& settings,
                       std::vector<EstimatorChannel> channels);

  /// (Re)starts at an instant with an unknown motion and the current estimates of all else. to_twin
  /// [ns]: the twin's instants less these. shaft_deviation [rad]: standard deviation of the shaft's
  /// angle.
  void begin(const ShaftInstant& at, std::int64_t to_twin = 0, double shaft_deviation = 0.0);
  /// Propagates to an instant; the shaft's angle is the cubic between both instants.
  void goTo(const ShaftInstant& there, double shaft_deviation = 0.0);
  /// Measurement update with the current value of a channel; deviation: standard deviation of its
  /// noise, 0: the channel's. Values outside the gate are rejected.
  Innovation take(std::size_t channel, double value, double deviation = 0.0);
  /// The next sample of a channel that measures an input; before its instant is passed.
  void takeInput(std::size_t channel, const InputSample& sample);
  /// Resets the motion, not the other estimates, to its initial uncertainty.
  void forgetMotion();
  /// Also resets all learned estimates. The next call must be begin().
  void startOver();
  /// Are all estimates finite?
  bool isFinite() const;
  /// Predicted coordinates and rates [2 dof] at an instant, without measurements.
  Eigen::VectorXd motionAt(const ShaftInstant& there);

  const std::vector<EstimatorChannel>& channels() const { return channels_; }
  const EstimatorModel& model() const { return model_; }
  const KalmanFilter& filter() const { return filter_; }
  const ShaftInstant& shaft() const { return now_; }
  /// The shaft's angle is not known well enough to be used.
  bool byProbes() const { return by_probes_; }
  Eigen::VectorXd q() const { return filter_.state().head(n_); }
  Eigen::VectorXd v() const { return filter_.state().segment(n_, n_); }
  EvaluationPoint<double> moment() const;

  double parameter(std::size_t index) const;
  double parameterDeviation(std::size_t index) const;  ///< in its unit
  /// A linear combination of coordinates and rates [2 dof], and its standard deviation.
  KalmanFilter::Expected combined(const Eigen::VectorXd& row) const;
  /// Stations whose whirl is published.
  const std::vector<Station>& unbalanceStations() const { return stations_; }
  /// At a station, relative to the shaft's phase reference: x and y [kg m].
  Eigen::Vector2d unbalance(std::size_t station) const;
  Eigen::Matrix2d unbalanceCovariance(std::size_t station) const;
  double offset(std::size_t channel) const;

  /// Numbers of the parameters (estimator_model.h), their standard deviations, and the sum of their
  /// variances.
  Eigen::VectorXd numbers() const { return filter_.state().segment(2 * n_, m_); }
  double numberDeviation(Eigen::Index i) const { return filter_.deviation(2 * n_ + i); }
  double parameterVariance() const;
  /// From now on linearizes at these numbers, independent of the estimate, without an allowance for
  /// errors of the derivatives. False where they are invalid for the system.
  bool holdModel(const Eigen::VectorXd& numbers);
  /// Likewise at the current estimate. Until now the estimate was on a straight line: a number that
  /// has grown by d has made the parameter 1 + d times as large, and becomes log(1 + d).
  bool holdModelHere();
  void releaseModel() { held_ = false; }
  bool holdsModel() const { return held_; }
  bool hasOffset(std::size_t channel) const { return offset_of_[channel] >= 0; }

  /// All estimates besides the motion: numbers of the parameters, unbalances and run-outs (x, y)
  /// relative to the shaft's phase reference, offsets.
  Eigen::VectorXd learned() const;
  Eigen::MatrixXd learnedCovariance() const;
  /// Random-walk intensity of each of these: variance per time.
  Eigen::VectorXd learnedWalk() const;

 private:
  /// Step of a linear system, and the conditions it was computed for.
  struct KeptStep {
    MotionStep step;
    double speed = 0.0;         // [rad/s]
    Eigen::MatrixXd by_state;   // accelerations [n x 2n]
    std::int64_t version = -1;  // of the model
  };

  void resume(const ShaftInstant& there);
  std::vector<ShaftInstant> partsOf(const ShaftInstant& there) const;
  ShaftPath pathBetween(const ShaftInstant& from, const ShaftInstant& to);
  ShaftInstant onward(std::int64_t time) const;
  void turnWhatTurns(double angle);
  void setTurning(double angle);
  Eigen::VectorXd moved(const Eigen::VectorXd& state, const ShaftPath& path);
  Eigen::VectorXd inputsAt(const ShaftPath& path, double part) const;
  const KeptStep& stepFor(const ShaftPath& path);
  /// Propagates the covariance over a step; unbalances and run-outs turn by the path's angle.
  void spread(const MotionStep& step, const ShaftPath& path);
  Eigen::MatrixXd turningNoise(const ShaftPath& path);
  Eigen::MatrixXd inputNoise(const ShaftPath& path) const;
  /// Derivatives of the accelerations by the unbalances at a fraction of the path [n x 2 stations].
  Eigen::MatrixXd unbalanceColumns(const ShaftPath& path, double part) const;
  Eigen::VectorXd rowOf(std::size_t channel) const;
  double nearTo(std::size_t channel, double value, const KalmanFilter::Expected& expected) const;
  double derivativeDoubt() const;

  std::vector<EstimatorChannel> channels_;
  SystemFollowing settings_;
  EstimatorModel model_;
  SystemSpec spec_;
  std::vector<Station> stations_;  // with an unbalance to be estimated
  std::int64_t longest_;           // [ns], longest step
  Eigen::Index n_, m_;
  Eigen::Index unbalance_, run_out_, offset_;         // first indices in the state
  std::vector<Eigen::Index> run_out_of_, offset_of_;  // of each channel; -1: none
  Inputs inputs_;                                     // of the scene; none where it has none
  std::vector<std::optional<EstimatorInput>> measured_inputs_;  // of each input of the system
  std::int64_t to_twin_ = 0;  // [ns], from its instants to the twin's
  Eigen::VectorXd angles_;    // 1 for each coordinate that is an angle, else 0
  KalmanFilter filter_;
  ShaftInstant now_;
  bool by_probes_ = false;
  bool held_ = false;                   // linearized at fixed numbers
  Eigen::VectorXd held_at_;             // these
  double shaft_deviation_ = 0.0;        // [rad], while the angle is known
  std::int64_t began_ = 0;              // [ns]
  Eigen::MatrixXd by_parameter_;        // of the last step, at its middle [n x m]
  Eigen::MatrixXd station_directions_;  // times M^-1, now [n x 2 stations]
  std::array<KeptStep, 4> steps_;       // the most recent ones
  std::size_t next_step_ = 0;
  Eigen::MatrixXd transition_, noise_;
};

}  // namespace whirl_twin
