// What is known of one system of a running machine: its coordinates and rates, and beside them what
// nobody has told, its parameters, an unbalance, zeros of sensors, run-out under probes. An
// extended Kalman filter about the model's own equations; of a linear system it is exact.
//
// The state: coordinates, rates, the numbers of the parameters (followed_model.h), for each station
// an unbalance and for each displacement probe a run-out as they lie in space, which turn with the
// shaft (x + i y turned by its angle), and a zero for each channel that has one. A step goes by the
// matrix exponential of the linearized equations, of a nonlinear system about the middle of the
// step, whose motion Runge-Kutta's method of order four follows; noise by the series of van Loan
// (IEEE Trans. Automatic Control 23, 1978).
//
// Where the shaft's angle is not known, a rotor is followed by its probes alone: the shaft goes on
// at its speed, what the forces that turn with it may be at any angle counts as noise, and nothing
// is learned but the motion. Unbalances and run-outs stay where they are on the shaft, and are
// turned to where it is found again.
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
#include "estimation/follow_settings.h"
#include "estimation/followed_model.h"
#include "estimation/followed_shaft.h"
#include "estimation/followed_sources.h"
#include "estimation/kalman_filter.h"
#include "scene/built_scene.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

/// A channel as a filter takes it.
struct FollowedChannel {
  std::string name;  ///< "source/channel"
  SignalSpec signal;
  double deviation = 0.0;  ///< of its noise, in its unit
  double offset = 0.0;     ///< deviation of its zero; 0: its zero is known
  double run_out = 0.0;    ///< [m], deviation; 0: none
  /// It shows what acts on an input, and there is no signal.
  std::optional<InputFollowing> input = std::nullopt;
};

/// What a measured value did.
struct Innovation {
  double value = 0.0;      ///< measured less expected, in the channel's unit
  double deviation = 0.0;  ///< that it was expected to have
  bool used = false;       ///< false: too far off to be of this motion
  double surest = 0.0;     ///< the deviation that it had if the shaft's angle were known exactly
  double normalized() const { return value / deviation; }
  double normalizedSurest() const { return value / surest; }
};

class SystemFilter {
 public:
  SystemFilter(const BuiltScene& scene, std::size_t system, const SystemFollowing& settings,
               std::vector<FollowedChannel> channels);

  /// Begins anew at an instant, knowing nothing of the motion, and of all else what is known.
  /// to_twin [ns]: what its instants are less than the twin's. The shaft's angle there is known to
  /// a deviation [rad].
  void begin(const ShaftInstant& at, std::int64_t to_twin = 0, double shaft_deviation = 0.0);
  /// Goes on, the shaft's motion being the cubic between here and there.
  void goTo(const ShaftInstant& there, double shaft_deviation = 0.0);
  /// Takes what a channel shows now, with noise of a standard deviation, else (0) of the channel's;
  /// a value too far off is refused.
  Innovation take(std::size_t channel, double value, double deviation = 0.0);
  /// The next sample of a channel that shows an input, before its instant is passed.
  void takeInput(std::size_t channel, const InputSample& sample);
  /// The motion, not the rest, is as at the beginning again: what was believed of it is wrong.
  void forgetMotion();
  /// Forgets all that was learned, too. The next is begin().
  void startOver();
  /// Are they numbers, all that it tells?
  bool isFinite() const;
  /// Coordinates and rates [2 dof] further on, where nothing is measured.
  Eigen::VectorXd motionAt(const ShaftInstant& there);

  const std::vector<FollowedChannel>& channels() const { return channels_; }
  const FollowedModel& model() const { return model_; }
  const KalmanFilter& filter() const { return filter_; }
  const ShaftInstant& shaft() const { return now_; }
  /// The shaft's angle is not known well enough to be of use.
  bool byProbes() const { return by_probes_; }
  Eigen::VectorXd q() const { return filter_.state().head(n_); }
  Eigen::VectorXd v() const { return filter_.state().segment(n_, n_); }
  Moment<double> moment() const;

  double parameter(std::size_t index) const;
  double parameterDeviation(std::size_t index) const;  ///< in its unit
  /// A linear combination of coordinates and rates [2 dof], and its standard deviation.
  KalmanFilter::Expected combined(const Eigen::VectorXd& row) const;
  /// Of stations whose whirl is published.
  const std::vector<Station>& unbalanceStations() const { return stations_; }
  /// At a station, from the shaft's phase mark: amount along x and y [kg m].
  Eigen::Vector2d unbalance(std::size_t station) const;
  Eigen::Matrix2d unbalanceCovariance(std::size_t station) const;
  double offset(std::size_t channel) const;

  /// The numbers of the parameters (followed_model.h), their deviations, and their variances
  /// summed.
  Eigen::VectorXd numbers() const { return filter_.state().segment(2 * n_, m_); }
  double numberDeviation(Eigen::Index i) const { return filter_.deviation(2 * n_ + i); }
  double parameterVariance() const;
  /// Derivatives are those at these numbers from now on, wherever the estimate goes, and are taken
  /// for right. False where a system cannot have them.
  bool holdModel(const Eigen::VectorXd& numbers);
  /// Likewise, of where the estimate has come to. Until now it went by a straight line: a number
  /// that has grown by d has made the parameter 1 + d times as large, and is log(1 + d) for that.
  bool holdModelHere();
  void releaseModel() { held_ = false; }
  bool holdsModel() const { return held_; }
  bool hasOffset(std::size_t channel) const { return offset_of_[channel] >= 0; }

  /// All that is estimated beside the motion: numbers of the parameters, unbalances and run-outs
  /// (x, y) from the shaft's phase mark, offsets.
  Eigen::VectorXd learned() const;
  Eigen::MatrixXd learnedCovariance() const;
  /// Of each of these: its own change in a time t has the variance this times t.
  Eigen::VectorXd learnedWalk() const;

 private:
  /// Of a linear system, and what it was made for.
  struct KeptStep {
    MotionStep step;
    double speed = 0.0;         // [rad/s]
    Eigen::MatrixXd by_state;   // accelerations [n x 2n]
    std::int64_t version = -1;  // of the model
  };

  void goOn(const ShaftInstant& there);
  std::vector<ShaftInstant> partsOf(const ShaftInstant& there) const;
  ShaftPath pathBetween(const ShaftInstant& from, const ShaftInstant& to);
  ShaftInstant onward(std::int64_t time) const;
  void turnWhatTurns(double angle);
  void setTurning(double angle);
  Eigen::VectorXd moved(const Eigen::VectorXd& state, const ShaftPath& path);
  Eigen::VectorXd inputsAt(const ShaftPath& path, double part) const;
  const KeptStep& stepFor(const ShaftPath& path);
  /// The covariance goes through a step; unbalances and run-outs turn by the path's angle.
  void spread(const MotionStep& step, const ShaftPath& path);
  Eigen::MatrixXd turningNoise(const ShaftPath& path);
  Eigen::MatrixXd inputNoise(const ShaftPath& path) const;
  /// Accelerations by unbalances, on the way [n x 2 stations].
  Eigen::MatrixXd unbalanceColumns(const ShaftPath& path, double part) const;
  Eigen::VectorXd rowOf(std::size_t channel) const;
  double nearTo(std::size_t channel, double value, const KalmanFilter::Expected& expected) const;
  double derivativeDoubt() const;

  std::vector<FollowedChannel> channels_;
  SystemFollowing settings_;
  FollowedModel model_;
  SystemSpec spec_;
  std::vector<Station> stations_;  // with an unbalance to be found
  std::int64_t longest_;           // [ns], step
  Eigen::Index n_, m_;
  Eigen::Index unbalance_, run_out_, offset_;         // where they begin in the state
  std::vector<Eigen::Index> run_out_of_, offset_of_;  // of each channel; -1: none
  Inputs inputs_;  // as the scene gives them; none where it gives none
  std::vector<std::optional<FollowedInput>> measured_inputs_;  // of each that the system has
  std::int64_t to_twin_ = 0;  // [ns], from its instants to the twin's
  Eigen::VectorXd angles_;    // 1 for each coordinate that is an angle, else 0
  KalmanFilter filter_;
  ShaftInstant now_;
  bool by_probes_ = false;
  bool held_ = false;                   // the model stays at the numbers that it is set up for
  Eigen::VectorXd held_at_;             // these
  double shaft_deviation_ = 0.0;        // [rad], where it is not by the probes
  std::int64_t began_ = 0;              // [ns]
  Eigen::MatrixXd by_parameter_;        // of the last step, in its middle [n x m]
  Eigen::MatrixXd station_directions_;  // M^-1 of them, now [n x 2 stations]
  std::array<KeptStep, 4> steps_;       // the last that were made
  std::size_t next_step_ = 0;
  Eigen::MatrixXd transition_, noise_;
};

}  // namespace whirl_twin
