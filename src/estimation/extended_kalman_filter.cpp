#include "estimation/extended_kalman_filter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

/// Innovation gate: values further from the prediction, in standard deviations, are rejected.
constexpr double kGate = 6.0;
/// Until then the motion is too uncertain for estimating parameters.
constexpr double kFilterSettling = 0.05;  // s
/// Largest useful standard deviation of the shaft's angle: with a larger one the probes alone give
/// more information on the synchronous motion.
constexpr double kAngleOfUse = 0.2;  // rad

// Initial standard deviations of coordinates and rates.
constexpr double kStartAngle = 1.0;      // rad
constexpr double kStartPlace = 1.0;      // natural lengths
constexpr double kStartWhirl = 1.0e-3;   // m
constexpr double kStartRate = 10.0;      // relative to the coordinate's, 1/s
constexpr double kStartWhirlRate = 1.0;  // m/s

std::vector<EstimatorParameter> parametersOf(const BuiltSystem& system,
                                             const SystemFollowing& settings) {
  std::vector<EstimatorParameter> all;
  for (const ParameterSettings& p : settings.parameters) {
    EstimatorParameter followed;
    followed.path = p.path;
    followed.start = *system.parameter(p.path);
    all.push_back(followed);
  }
  return all;
}

}  // namespace

ExtendedKalmanFilter::ExtendedKalmanFilter(const BuiltScene& scene, std::size_t system,
                                           const SystemFollowing& settings,
                                           std::vector<EstimatorChannel> channels)
    : channels_(std::move(channels)),
      settings_(settings),
      model_(scene.systems[system], parametersOf(*scene.systems[system], settings)),
      spec_(scene.systems[system]->spec),
      longest_(scene.scene.step),
      n_(model_.dof()),
      m_(static_cast<Eigen::Index>(settings.parameters.size())),
      unbalance_(2 * n_ + m_),
      inputs_(scene.inputsOf(*scene.systems[system])),
      measured_inputs_(scene.systems[system]->dynamics->inputs().size()) {
  for (const EstimatorChannel& channel : channels_) {
    if (channel.input) {
      measured_inputs_[channel.input->input].emplace(channel.input->hold, channel.input->deviation);
    }
  }
  const Dynamics& dynamics = *scene.systems[system]->dynamics;
  if (settings.unbalance.deviation > 0.0) {
    for (const Station& station : dynamics.stations()) {
      if (stations_.empty() || station.published) {
        stations_.push_back(station);
      }
    }
  }
  run_out_ = unbalance_ + 2 * static_cast<Eigen::Index>(stations_.size());
  Eigen::Index next = run_out_;
  for (const EstimatorChannel& channel : channels_) {
    run_out_of_.push_back(channel.run_out > 0.0 ? std::exchange(next, next + 2) : -1);
  }
  offset_ = next;
  for (const EstimatorChannel& channel : channels_) {
    offset_of_.push_back(channel.offset > 0.0 ? next++ : -1);
  }
  filter_ = KalmanFilter(Eigen::VectorXd::Zero(next), Eigen::VectorXd::Zero(next));
  startOver();
  by_parameter_ = Eigen::MatrixXd::Zero(n_, m_);
  angles_ = Eigen::VectorXd::Zero(n_);
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (Eigen::Index i = 0; i < n_; ++i) {
    angles_[i] = coordinates[static_cast<std::size_t>(i)].isAngle() ? 1.0 : 0.0;
  }
}

void ExtendedKalmanFilter::startOver() {
  Eigen::VectorXd deviation = Eigen::VectorXd::Zero(filter_.size());
  for (Eigen::Index i = 0; i < m_; ++i) {
    deviation[2 * n_ + i] = settings_.parameters[static_cast<std::size_t>(i)].number.deviation;
  }
  deviation.segment(unbalance_, run_out_ - unbalance_).setConstant(settings_.unbalance.deviation);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (run_out_of_[i] >= 0) {
      deviation.segment(run_out_of_[i], 2).setConstant(channels_[i].run_out);
    }
    if (offset_of_[i] >= 0) {
      deviation[offset_of_[i]] = channels_[i].offset;
    }
  }
  filter_ = KalmanFilter(Eigen::VectorXd::Zero(filter_.size()), deviation);
}

bool ExtendedKalmanFilter::isFinite() const {
  bool finite = std::isfinite(filter_.state().sum()) && std::isfinite(filter_.covariance().trace());
  for (std::size_t i = 0; i < static_cast<std::size_t>(m_); ++i) {
    finite = finite && std::isfinite(parameter(i));
  }
  return finite;
}

void ExtendedKalmanFilter::begin(const ShaftInstant& at, std::int64_t to_twin,
                                 double shaft_deviation) {
  to_twin_ = to_twin;
  by_probes_ = !(shaft_deviation <= kAngleOfUse);
  shaft_deviation_ = shaft_deviation;
  turnWhatTurns(at.angle.remainder - now_.angle.remainder);
  now_ = at;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    filter_.state()[i] = spec_.q[k];
    filter_.state()[n_ + i] = spec_.v[k];
  }
  forgetMotion();
}

void ExtendedKalmanFilter::forgetMotion() {
  const Dynamics& dynamics = *model_.system()->dynamics;
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (Eigen::Index i = 0; i < n_; ++i) {
    const bool angle = coordinates[static_cast<std::size_t>(i)].isAngle();
    const double place = angle                ? kStartAngle
                         : dynamics.isRotor() ? kStartWhirl
                                              : kStartPlace * dynamics.naturalLength();
    filter_.forget(i, place);
    filter_.forget(n_ + i, dynamics.isRotor() && !angle ? kStartWhirlRate : kStartRate * place);
  }
  began_ = now_.time;
}

EvaluationPoint<double> ExtendedKalmanFilter::moment() const {
  return {static_cast<double>(now_.time + to_twin_) * kNanosecond, now_.angle.remainder, now_.speed,
          0.0};
}

/// Extrapolates the shaft at constant speed.
ShaftInstant ExtendedKalmanFilter::onward(std::int64_t time) const {
  return {time, advance(now_.angle, now_.speed, time - now_.time), now_.speed};
}

void ExtendedKalmanFilter::goTo(const ShaftInstant& there, double shaft_deviation) {
  if (there.time <= now_.time) {
    return;
  }
  const bool known = shaft_deviation <= kAngleOfUse;
  const bool found = by_probes_ && known;
  by_probes_ = by_probes_ || !known;
  for (const ShaftInstant& part : partsOf(found ? onward(there.time) : there)) {
    resume(part);
  }
  if (found) {
    turnWhatTurns(there.angle.remainder - now_.angle.remainder);
    now_ = there;
    by_probes_ = false;
  }
  shaft_deviation_ = shaft_deviation;
  for (std::optional<EstimatorInput>& input : measured_inputs_) {
    if (input) {
      input->forgetBefore(now_.time);
    }
  }
}

Eigen::VectorXd ExtendedKalmanFilter::motionAt(const ShaftInstant& there) {
  Eigen::VectorXd state = filter_.state();
  if (there.time > now_.time) {
    ShaftInstant from = now_;
    for (const ShaftInstant& part : partsOf(by_probes_ ? onward(there.time) : there)) {
      state = moved(state, pathBetween(from, part));
      from = part;
    }
  }
  return state.head(2 * n_);
}

void ExtendedKalmanFilter::takeInput(std::size_t channel, const InputSample& sample) {
  measured_inputs_[channels_[channel].input->input]->take(sample);
}

Eigen::VectorXd ExtendedKalmanFilter::rowOf(std::size_t channel) const {
  const EstimatorChannel& c = channels_[channel];
  Eigen::VectorXd h = Eigen::VectorXd::Zero(filter_.size());
  const auto coordinate = static_cast<Eigen::Index>(c.signal.coordinate);
  switch (c.signal.kind) {
    case SignalSpec::Kind::kCoordinate:
      h[coordinate] = 1.0;
      break;
    case SignalSpec::Kind::kRate:
      h[n_ + coordinate] = 1.0;
      break;
    case SignalSpec::Kind::kDisplacement: {
      const Station at = model_.system()->dynamics->places()[c.signal.station];
      const double cosine = std::cos(c.signal.direction), sine = std::sin(c.signal.direction);
      h.head(n_) = cosine * at.along_x + sine * at.along_y;
      if (run_out_of_[channel] >= 0) {
        h[run_out_of_[channel]] = cosine;
        h[run_out_of_[channel] + 1] = sine;
      }
      break;
    }
  }
  if (offset_of_[channel] >= 0) {
    h[offset_of_[channel]] = 1.0;
  }
  return h;
}

/// Unwraps an encoder that counts within a turn: if the angle is known, to the value nearest to the
/// prediction.
double ExtendedKalmanFilter::nearTo(std::size_t channel, double value,
                                    const KalmanFilter::Expected& expected) const {
  constexpr double kKnown = 0.1 * kTwoPi;
  const SignalSpec& signal = channels_[channel].signal;
  const bool angle = signal.kind == SignalSpec::Kind::kCoordinate &&
                     angles_[static_cast<Eigen::Index>(signal.coordinate)] > 0.0;
  return angle && expected.deviation < kKnown
             ? value - kTwoPi * std::round((value - expected.value) / kTwoPi)
             : value;
}

Innovation ExtendedKalmanFilter::take(std::size_t channel, double value, double deviation) {
  const Eigen::VectorXd h = rowOf(channel);
  double by_shaft = 0.0;
  double noise = deviation > 0.0 ? deviation : channels_[channel].deviation;
  if (by_probes_ && run_out_of_[channel] >= 0) {
    noise = std::hypot(noise, filter_.state().segment<2>(run_out_of_[channel]).norm());
  } else if (!by_probes_ && shaft_deviation_ > 0.0 && now_.speed != 0.0) {
    // An error of the shaft's angle shifts the synchronous motion accordingly.
    by_shaft = shaft_deviation_ * std::hypot(h.head(n_).dot(q()), h.head(n_).dot(v()) / now_.speed);
    noise = std::hypot(noise, by_shaft);
  }
  const KalmanFilter::Expected expected = filter_.expect(h, noise);
  value = nearTo(channel, value, expected);
  Innovation innovation{value - expected.value, expected.deviation, false};
  innovation.surest = std::sqrt((expected.deviation - by_shaft) * (expected.deviation + by_shaft));
  if (!(std::fabs(innovation.value) <= kGate * innovation.deviation)) {
    return innovation;
  }
  innovation.used = true;
  const bool settled = now_.time - began_ > std::llround(kFilterSettling / kNanosecond);
  const double known = expected.deviation * expected.deviation - noise * noise;
  const double doubt = settled ? std::min(1.0, derivativeDoubt()) : 0.0;
  filter_.take(h, value, std::sqrt(noise * noise + doubt * std::max(0.0, known)),
               settled && !by_probes_ ? filter_.size() : 2 * n_);
  return innovation;
}

/// Variance factor for errors of the linearization. Their relative size is about the uncertainty of
/// the estimate (in radians and logarithms): this fraction of the predicted variance counts as
/// noise, otherwise a filter with a poor initial estimate soon becomes overconfident.
double ExtendedKalmanFilter::derivativeDoubt() const {
  double doubt = held_ ? 0.0 : parameterVariance();
  if (!model_.system()->dynamics->linear()) {
    doubt += filter_.covariance().diagonal().head(n_).cwiseProduct(angles_).sum();
  }
  return doubt;
}

double ExtendedKalmanFilter::parameterVariance() const {
  return filter_.covariance().diagonal().segment(2 * n_, m_).sum();
}

bool ExtendedKalmanFilter::holdModel(const Eigen::VectorXd& numbers) {
  held_ = model_.follow(numbers);
  held_at_ = numbers;
  return held_;
}

bool ExtendedKalmanFilter::holdModelHere() {
  const Eigen::Index all = filter_.size();
  transition_.setIdentity(all, all);
  noise_.setZero(all, all);
  for (Eigen::Index i = 0; i < m_; ++i) {
    const double grown = numbers()[i] - held_at_[i];
    if (grown > 0.0) {
      filter_.state()[2 * n_ + i] = held_at_[i] + std::log1p(grown);
      transition_(2 * n_ + i, 2 * n_ + i) = 1.0 / (1.0 + grown);
    }
  }
  filter_.propagate(transition_, noise_);
  return holdModel(numbers());
}

double ExtendedKalmanFilter::parameter(std::size_t index) const {
  return model_.parameters()[index].value(numbers()[static_cast<Eigen::Index>(index)]);
}

double ExtendedKalmanFilter::parameterDeviation(std::size_t index) const {
  const Eigen::Index i = static_cast<Eigen::Index>(index);
  return model_.parameters()[index].deviation(numbers()[i], filter_.deviation(2 * n_ + i));
}

Eigen::Vector2d ExtendedKalmanFilter::unbalance(std::size_t station) const {
  const Eigen::Vector2d turned =
      filter_.state().segment<2>(unbalance_ + 2 * static_cast<Eigen::Index>(station));
  return Eigen::Rotation2Dd(-now_.angle.remainder) * turned;
}

Eigen::Matrix2d ExtendedKalmanFilter::unbalanceCovariance(std::size_t station) const {
  const Eigen::Index i = unbalance_ + 2 * static_cast<Eigen::Index>(station);
  const Eigen::Rotation2Dd back(-now_.angle.remainder);
  return back.toRotationMatrix() * filter_.covariance().block<2, 2>(i, i) *
         back.toRotationMatrix().transpose();
}

Eigen::VectorXd ExtendedKalmanFilter::learned() const {
  Eigen::VectorXd numbers = filter_.state().tail(filter_.size() - 2 * n_);
  const Eigen::Rotation2Dd back(-now_.angle.remainder);
  for (Eigen::Index i = unbalance_ - 2 * n_; i < offset_ - 2 * n_; i += 2) {
    numbers.segment<2>(i) = back * Eigen::Vector2d(numbers.segment<2>(i));
  }
  return numbers;
}

Eigen::MatrixXd ExtendedKalmanFilter::learnedCovariance() const {
  const Eigen::Index all = filter_.size() - 2 * n_;
  Eigen::MatrixXd back = Eigen::MatrixXd::Identity(all, all);
  for (Eigen::Index i = unbalance_ - 2 * n_; i < offset_ - 2 * n_; i += 2) {
    back.block<2, 2>(i, i) = Eigen::Rotation2Dd(-now_.angle.remainder).toRotationMatrix();
  }
  return back * filter_.covariance().bottomRightCorner(all, all) * back.transpose();
}

Eigen::VectorXd ExtendedKalmanFilter::learnedWalk() const {
  Eigen::VectorXd walk = Eigen::VectorXd::Zero(filter_.size() - 2 * n_);
  for (Eigen::Index i = 0; i < m_; ++i) {
    walk[i] = settings_.parameters[static_cast<std::size_t>(i)].number.walk;
  }
  walk.segment(m_, run_out_ - unbalance_).setConstant(settings_.unbalance.walk);
  return walk.cwiseAbs2();
}

KalmanFilter::Expected ExtendedKalmanFilter::combined(const Eigen::VectorXd& row) const {
  Eigen::VectorXd h = Eigen::VectorXd::Zero(filter_.size());
  h.head(2 * n_) = row;
  return filter_.expect(h, 0.0);
}

double ExtendedKalmanFilter::offset(std::size_t channel) const {
  return offset_of_[channel] < 0 ? 0.0 : filter_.state()[offset_of_[channel]];
}

}  // namespace whirl_twin
