#include "estimation/unbalance_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kHalfBand = 3.0e-3;  // relative to the lowest natural frequency

/// q' = v, v' = -M^-1 ((K + N) q + (C + G) v).
Eigen::MatrixXd stateMatrix(const Linearization& at) {
  const Eigen::Index n = at.mass.rows();
  const Lu mass(at.mass);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -mass.solve(at.stiffness + at.circulatory);
  a.bottomRightCorner(n, n) = -mass.solve(at.damping + at.gyroscopic);
  return a;
}

}  // namespace

DrivenWhirl::DrivenWhirl(const LinearRotor& rotor, const std::vector<ShaftForce>& forces)
    : rotor_(rotor), forces_(rotor.dof(), static_cast<Eigen::Index>(forces.size())) {
  for (std::size_t j = 0; j < forces.size(); ++j) {
    forces_.col(static_cast<Eigen::Index>(j)) = forces[j].amplitude;
    inertial_.push_back(forces[j].inertial);
  }
  setModes(0.0);
  const Eigen::ArrayXd sizes = middle_.cwiseAbs();
  double lowest = sizes.maxCoeff();
  for (const double size : sizes) {
    lowest = size > 1.0e-6 * sizes.maxCoeff() ? std::min(lowest, size) : lowest;
  }
  half_band_ = kHalfBand * lowest;
}

void DrivenWhirl::setModes(double centre) {
  const Eigen::Index n = rotor_.dof();
  const Linearization at = rotor_.matrices(centre);
  const EigenPairs eigen = eigenPairs(stateMatrix(at));
  centre_ = centre;
  middle_ = eigen.values;
  shapes_ = eigen.vectors;
  inverse_ = ComplexLu(shapes_).inverse();
  if (!inverse_.allFinite()) {
    throw RunFailure("the rotor has critically damped modes without independent mode shapes");
  }
  slope_ = Eigen::VectorXcd::Zero(middle_.size());
  if (rotor_.speed_dependent && half_band_ > 0.0) {
    const Eigen::MatrixXd change = (stateMatrix(rotor_.matrices(centre + half_band_)) -
                                    stateMatrix(rotor_.matrices(centre - half_band_))) /
                                   (2.0 * half_band_);
    slope_ = (inverse_ * change.cast<std::complex<double>>() * shapes_).diagonal();
  }
  const ComplexLu mass(at.mass.cast<std::complex<double>>());
  excitation_ = inverse_.rightCols(n) * mass.solve(forces_);
}

/// Selects the mode shapes of the speed's band.
void DrivenWhirl::setSpeed(double speed) {
  constexpr double kBeyond = 1.2;  // hysteresis at the edges of a band
  speed_ = speed;
  if (!rotor_.speed_dependent || std::fabs(speed - centre_) < kBeyond * half_band_) {
    return;
  }
  const Eigen::MatrixXcd state = shapes_ * modal_;
  setModes(2.0 * half_band_ * std::round(speed / (2.0 * half_band_)));
  modal_ = inverse_ * state;
}

void DrivenWhirl::start(double speed) {
  modal_ = Eigen::MatrixXcd::Zero(middle_.size(), forces_.cols());
  setSpeed(speed);
  for (Eigen::Index k = 0; k < modal_.rows(); ++k) {
    const std::complex<double> away =
        kImaginaryUnit * speed - middle_[k] - slope_[k] * (speed - centre_);
    for (Eigen::Index j = 0; j < modal_.cols(); ++j) {
      const double factor = inertial_[static_cast<std::size_t>(j)] ? speed * speed : 1.0;
      modal_(k, j) = away == 0.0 ? 0.0 : excitation_(k, j) * factor / away;
    }
  }
}

void DrivenWhirl::advance(double time, double turn, double speed) {
  const double before = speed_;
  const double mean = turn / time;
  setSpeed(speed);
  // Of theta = mean t + ((speed - before) / (2 time)) t (t - time) the second term is small:
  // replaced by its mean.
  const std::complex<double> bent = 1.0 - kImaginaryUnit * (speed - before) * time / 12.0;
  const std::complex<double> turned = std::polar(1.0, turn);
  for (Eigen::Index k = 0; k < modal_.rows(); ++k) {
    const std::complex<double> s = middle_[k] + slope_[k] * (0.5 * (before + speed) - centre_);
    const std::complex<double> decayed = std::exp(s * time);
    const std::complex<double> away = kImaginaryUnit * mean - s;
    const bool resonant = std::abs(away) * time < 1.0e-7;
    const std::complex<double> steady =
        resonant ? time * decayed : (turned - decayed) / away * bent;
    // -(e^(i theta))'' integrated by parts.
    const std::complex<double> inertial =
        -(kImaginaryUnit * speed * turned - kImaginaryUnit * before * decayed) -
        s * (turned - decayed) - s * s * steady;
    for (Eigen::Index j = 0; j < modal_.cols(); ++j) {
      const std::complex<double> pushed =
          inertial_[static_cast<std::size_t>(j)] ? inertial : steady;
      modal_(k, j) = (decayed * modal_(k, j) + excitation_(k, j) * pushed) / turned;
    }
  }
}

namespace {

constexpr double kMaxReadingGap = 2.0;  // s: up to it the shaft's motion is interpolated
constexpr double kFinestSteps = 1.5;    // of the usual interval, for a single step
constexpr double kMaxSteps = 20000.0;

/// Force of a unit of unbalance at a station.
ShaftForce unitUnbalance(const Station& station) {
  return {station.along_x.cast<std::complex<double>>() - kImaginaryUnit * station.along_y, 1, true};
}

std::vector<ShaftForce> forcesOf(const LinearRotor& rotor,
                                 const std::vector<BalancingPlane>& planes) {
  std::vector<ShaftForce> forces;
  for (const BalancingPlane& plane : planes) {
    forces.push_back(unitUnbalance(plane.station));
  }
  // Whirl due to the model's bow is known; only the whirl due to unbalance is fitted.
  ShaftForce bow{Eigen::VectorXcd::Zero(rotor.dof()), 1, false};
  for (const ShaftForce& force : rotor.forces) {
    if (force.harmonic == 1 && !force.inertial) {
      bow.amplitude += force.amplitude;
    }
  }
  forces.push_back(bow);
  return forces;
}

/// Probe reading of e^(i w t).
std::complex<double> seen(const RotorProbe& probe, double speed) {
  const std::complex<double> delayed = std::polar(1.0, -speed * probe.delay);
  return probe.bandwidth > 0.0
             ? delayed / (1.0 + kImaginaryUnit * speed / (kTwoPi * probe.bandwidth))
             : delayed;
}

}  // namespace

UnbalanceFit::UnbalanceFit(const LinearRotor& rotor, const std::vector<BalancingPlane>& planes,
                           const std::vector<RotorProbe>& probes)
    : planes_(planes),
      probes_(probes),
      whirl_(rotor, forcesOf(rotor, planes)),
      weight_(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(probes.size()))),
      noise_known_(std::all_of(probes.begin(), probes.end(),
                               [](const RotorProbe& probe) { return probe.deviation > 0.0; })),
      offset_(Eigen::VectorXd::Constant(weight_.size(), std::nan(""))) {
  if (planes.empty() || probes.empty()) {
    throw std::invalid_argument("UnbalanceFit: expected a plane and a probe");
  }
  first_mean_ = 2 * static_cast<Eigen::Index>(planes.size());
  for (std::size_t c = 0; c < probes.size(); ++c) {
    run_out_place_.push_back(probes[c].run_out_known ? -1 : first_mean_);
    first_mean_ += probes[c].run_out_known ? 0 : 2;
    if (noise_known_) {
      weight_[static_cast<Eigen::Index>(c)] = 1.0 / probes[c].deviation;
    }
  }
  equations_ = JackknifeLeastSquares(first_mean_ + weight_.size(), weight_.size());
}

/// Advances the rotor with the shaft; over some missing samples with an interpolated motion. False:
/// it was restarted.
bool UnbalanceFit::turnTo(const ProbeReading& reading) {
  const double time = reading.time - last_.time;
  const double turn = kTwoPi * static_cast<double>(reading.turns - last_.turns) +
                      (reading.remainder - last_.remainder);
  const double skew = turn - 0.5 * (last_.speed + reading.speed) * time;
  // After a loss of the shaft's phase the number of turns may be different.
  if (!started_ || !(time > 0.0) || time > kMaxReadingGap || std::fabs(skew) > 0.5 * kTwoPi) {
    whirl_.start(reading.speed);
    started_ = true;
    return false;
  }
  // An unusual interval, such as that of two stamps too close, is soon forgotten.
  step_ = step_ == 0.0 ? time : step_;
  const int steps = time > kFinestSteps * step_
                        ? static_cast<int>(std::ceil(std::min(time / step_ - 1.0e-6, kMaxSteps)))
                        : 1;
  step_ = std::clamp(time, 0.5 * step_, 2.0 * step_);
  const double part = 1.0 / steps;
  const double change = reading.speed - last_.speed;
  double turned = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double at = i * part;
    const double now =
        i == steps ? turn : at * time * (last_.speed + 0.5 * change * at) + at * skew;
    whirl_.advance(part * time, now - turned, last_.speed + change * at);
    turned = now;
  }
  return true;
}

void UnbalanceFit::take(const ProbeReading& reading) {
  if (!std::isfinite(reading.time) || !std::isfinite(reading.remainder) ||
      !std::isfinite(reading.speed)) {
    return;
  }
  const double since = reading.time - last_.time;
  const bool goes_on = turnTo(reading);
  last_ = reading;
  if (!reading.values.array().isFinite().any()) {
    return;
  }
  duration_ += goes_on ? since : 0.0;
  const bool first = samples_ == 0;
  lowest_speed_ = first ? reading.speed : std::min(lowest_speed_, reading.speed);
  highest_speed_ = first ? reading.speed : std::max(highest_speed_, reading.speed);
  ++samples_;
  const Eigen::MatrixXcd amplitudes = whirl_.amplitudes();
  const std::complex<double> turned = std::polar(1.0, reading.remainder);
  for (std::size_t c = 0; c < probes_.size(); ++c) {
    const double value = reading.values[static_cast<Eigen::Index>(c)];
    if (std::isfinite(value)) {
      double& offset = offset_[static_cast<Eigen::Index>(c)];
      offset = std::isnan(offset) ? value : offset;  // keeps digits in case of a large gap
      add(c, value - offset, amplitudes, turned, reading.speed);
    }
  }
}

void UnbalanceFit::add(std::size_t probe, double value, const Eigen::MatrixXcd& amplitudes,
                       std::complex<double> turned, double speed) {
  const RotorProbe& at = probes_[probe];
  const auto c = static_cast<Eigen::Index>(probe);
  const double weight = weight_[c];
  const std::complex<double> shown = weight * seen(at, speed) * turned;
  const auto planes = static_cast<Eigen::Index>(planes_.size());
  const Eigen::RowVectorXcd whirl = at.along.transpose() * amplitudes;

  std::vector<Eigen::Index> places;
  std::vector<double> row;
  const auto put = [&](Eigen::Index place, std::complex<double> factor) {
    places.insert(places.end(), {place, place + 1});
    row.insert(row.end(), {factor.real(), -factor.imag()});
  };
  for (Eigen::Index j = 0; j < planes; ++j) {
    put(2 * j, whirl[j] * shown);
  }
  double rest = weight * value - (whirl[planes] * shown).real();
  if (run_out_place_[probe] >= 0) {
    put(run_out_place_[probe], shown);
  } else {
    rest -= (at.run_out * shown).real();
  }
  places.push_back(first_mean_ + c);
  row.push_back(weight);

  equations_.add(places, row, rest);
}

UnbalanceEstimate UnbalanceFit::estimate() const {
  const JackknifeSolution solution = equations_.solve();
  const auto phasor = [&](Eigen::Index place) {
    const auto k = static_cast<std::size_t>(place);
    PhasorEstimate estimate;
    estimate.value = {solution.x[place], solution.x[place + 1]};
    estimate.deviation = std::max(solution.deviation[place], solution.deviation[place + 1]);
    estimate.identifiable = solution.identifiable[k] && solution.identifiable[k + 1];
    return estimate;
  };
  UnbalanceEstimate result;
  for (std::size_t j = 0; j < planes_.size(); ++j) {
    result.planes.push_back(phasor(2 * static_cast<Eigen::Index>(j)));
  }
  for (std::size_t c = 0; c < probes_.size(); ++c) {
    result.run_outs.push_back(run_out_place_[c] >= 0
                                  ? phasor(run_out_place_[c])
                                  : PhasorEstimate{probes_[c].run_out, 0.0, true});
  }
  for (Eigen::Index i = 0; i < solution.unidentifiable.cols(); ++i) {
    const auto part = [&](Eigen::Index place) {
      return place < 0 ? std::complex<double>()
                       : std::complex<double>(solution.unidentifiable(place, i),
                                              solution.unidentifiable(place + 1, i));
    };
    UnidentifiableCombination combination;
    for (std::size_t j = 0; j < planes_.size(); ++j) {
      combination.planes.push_back(part(2 * static_cast<Eigen::Index>(j)));
    }
    for (const Eigen::Index place : run_out_place_) {
      combination.run_outs.push_back(part(place));
    }
    result.unidentifiable.push_back(std::move(combination));
  }
  result.samples = samples_;
  result.lowest_speed = lowest_speed_;
  result.highest_speed = highest_speed_;
  result.duration = duration_;
  const double weights = weight_.squaredNorm() / static_cast<double>(probes_.size());
  const double values = std::max(1.0, static_cast<double>(solution.values));
  result.synchronous = std::sqrt(solution.explained / values / weights);
  result.noise = std::sqrt(solution.variance / weights);
  result.beyond_noise = noise_known_ ? std::sqrt(solution.variance) : 0.0;
  return result;
}

}  // namespace whirl_twin
