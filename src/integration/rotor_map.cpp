#include "integration/rotor_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "integration/matrix_exponential.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr std::array<std::size_t, 2> kNodes{8, 16};
constexpr std::array<double, 2> kBetween{0.0, 0.92};  // of -1 ... 1: no nodes of either
constexpr double kNarrowest = 1.0e-6;                 // of the speed

double node(std::size_t i, std::size_t count) {
  return std::cos((2.0 * static_cast<double>(i) + 1.0) * kPi / (2.0 * static_cast<double>(count)));
}

}  // namespace

/// By the barycentric formula.
Eigen::MatrixXd MapOverSpeed::Part::at(double speed) const {
  const double x = (2.0 * speed - low - high) / (high - low);
  const std::size_t count = values.size();
  std::vector<double> shares(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double apart = x - node(i, count);
    if (apart == 0.0) {
      return values[i];
    }
    const double angle =
        (2.0 * static_cast<double>(i) + 1.0) * kPi / (2.0 * static_cast<double>(count));
    shares[i] = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle) / apart;
    sum += shares[i];
  }
  Eigen::MatrixXd value = shares[0] / sum * values[0];
  for (std::size_t i = 1; i < count; ++i) {
    value += shares[i] / sum * values[i];
  }
  return value;
}

MapOverSpeed::MapOverSpeed(const Sample& sample, double low, double high, const Size& size,
                           double tolerance, double rounding) {
  add(sample, low, high, size, tolerance, rounding, kInfinity);
}

void MapOverSpeed::add(const Sample& sample, double low, double high, const Size& size,
                       double tolerance, double rounding, double before) {
  double error = 0.0;
  for (const std::size_t count : kNodes) {
    Part part{low, high, {}};
    for (std::size_t i = 0; i < count; ++i) {
      part.values.push_back(sample(0.5 * (low + high) + 0.5 * (high - low) * node(i, count)));
    }
    error = 0.0;
    for (const double x : kBetween) {
      const double speed = 0.5 * (low + high) + 0.5 * x * (high - low);
      const Eigen::MatrixXd exact = sample(speed);
      error = std::max(error, size(part.at(speed) - exact, exact));
    }
    // What no longer falls is the rounding of a very stiff rotor's map.
    const bool at_rounding = count == kNodes.back() && error < rounding && error > 0.5 * before;
    if (error <= tolerance || at_rounding) {
      parts_.push_back(std::move(part));
      return;
    }
  }
  const double middle = 0.5 * (low + high);
  if (!(high - low > kNarrowest * (1.0 + std::fabs(middle)))) {
    throw RunFailure(
        "the rotor's matrices change too fast with speed for its step: shorten the step");
  }
  add(sample, low, middle, size, tolerance, rounding, error);
  add(sample, middle, high, size, tolerance, rounding, error);
}

Eigen::MatrixXd MapOverSpeed::at(double speed) const {
  const auto part = std::find_if(parts_.begin(), parts_.end() - 1,
                                 [speed](const Part& p) { return speed <= p.high; });
  return part->at(speed);
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Re[F psi] as two columns, by the real and the imaginary part of psi.
MatrixXd columns(const ForceChannel& channel) {
  MatrixXd c(channel.amplitude.size(), 2);
  c << channel.amplitude.real(), -channel.amplitude.imag();
  return c;
}

}  // namespace

std::vector<ForceChannel> forceChannels(const LinearRotor& rotor) {
  std::vector<ForceChannel> channels;
  for (const ShaftForce& force : rotor.forces) {
    const auto same = std::find_if(channels.begin(), channels.end(), [&](const ForceChannel& c) {
      return c.harmonic == force.harmonic && c.inertial == force.inertial;
    });
    if (same == channels.end()) {
      channels.push_back({force.amplitude, force.harmonic, force.inertial});
    } else {
      same->amplitude += force.amplitude;
    }
  }
  return channels;
}

Index RotorMap::inputs(Index dof, std::size_t channels, const AppliedInputs& acting, int degree) {
  Index size = 2 * dof + 2 * static_cast<Index>(channels) * (degree + 1) + 1;
  for (Index k = 0; k < acting.count(); ++k) {
    size += acting.columns(k, degree);
  }
  return size;
}

// In x = L^T q, L L^T = M, rates over the highest frequency, forcing over the deflection it causes:
// then the norm of h A is that of frequency times step, whatever the units and the masses.
RotorMap::RotorMap(const LinearRotor& rotor, const std::vector<ForceChannel>& channels,
                   const AppliedInputs& acting, double speed, double h, int degree)
    : n_(rotor.dof()),
      h_(h),
      l_(rotor.matrices(speed)),
      channels_(channels),
      acting_(acting),
      degree_(degree) {
  const Index size = inputs(n_, channels.size(), acting, degree);
  const Cholesky mass(l_.mass);
  const MatrixXd to_q = mass.solveUpper(MatrixXd::Identity(n_, n_));  // q = to_q x
  const MatrixXd stiffness = to_q.transpose() * (l_.stiffness + l_.circulatory) * to_q;
  const MatrixXd damping = to_q.transpose() * (l_.damping + l_.gyroscopic) * to_q;
  const double rate = powerOfTwo(std::sqrt(stiffness.cwiseAbs().maxCoeff()));

  scale_.setZero(size, size);  // scaled y = scale y
  unscale_.setZero(size, size);
  scale_.topLeftCorner(n_, n_) = mass.lower().transpose();
  unscale_.topLeftCorner(n_, n_) = to_q;
  scale_.block(n_, n_, n_, n_) = scale_.topLeftCorner(n_, n_) / rate;
  unscale_.block(n_, n_, n_, n_) = rate * to_q;
  a_.setZero(size, size);
  a_.block(0, n_, n_, n_).diagonal().setConstant(rate);
  a_.block(n_, 0, n_, n_) = -stiffness / rate;
  a_.block(n_, n_, n_, n_) = -damping;

  Index input = 2 * n_;
  for (const ForceChannel& channel : channels) {
    const MatrixXd forcing = to_q.transpose() * columns(channel);
    const double deflection = powerOfTwo(forcing.cwiseAbs().maxCoeff() / (rate * rate));
    const double frequency = channel.harmonic * speed;
    a_.block(n_, input, n_, 2) = forcing / (rate * deflection);
    for (int k = 0; k <= degree; ++k, input += 2) {
      scale_.diagonal().segment(input, 2).setConstant(deflection);
      unscale_.diagonal().segment(input, 2).setConstant(1.0 / deflection);
      a_(input, input + 1) = -frequency;
      a_(input + 1, input) = frequency;
      if (k < degree) {
        a_(input, input + 2) = a_(input + 1, input + 3) = (k + 1) / h;
      }
    }
  }
  const Eigen::VectorXd load = to_q.transpose() * rotor.load;
  const double deflection = powerOfTwo(load.cwiseAbs().maxCoeff() / (rate * rate));
  scale_(input, input) = deflection;
  unscale_(input, input) = 1.0 / deflection;
  a_.block(n_, input, n_, 1) = load / (rate * deflection);
  ++input;
  for (Index k = 0; k < acting.count(); ++k) {
    const Eigen::VectorXd force = to_q.transpose() * acting.directions().col(k);
    const double size_of_it = powerOfTwo(force.cwiseAbs().maxCoeff() / (rate * rate));
    const Index columns = acting.columns(k, degree);
    scale_.diagonal().segment(input, columns).setConstant(size_of_it);
    unscale_.diagonal().segment(input, columns).setConstant(1.0 / size_of_it);
    a_.block(n_, input, n_, 1) = force / (rate * size_of_it);
    if (acting.isPair(k)) {
      a_.block(input, input, 2, 2) = acting.generator(k, h);
    } else {
      for (Index power = 0; power + 1 < columns; ++power) {
        a_(input + power, input + power + 1) = static_cast<double>(power + 1) / h;
      }
    }
    input += columns;
  }
}

MatrixXd RotorMap::unscaledIncrement(const MatrixXd& e) const {
  return unscale_.topLeftCorner(2 * n_, 2 * n_) * e.topRows(2 * n_) * scale_;
}

MatrixXd RotorMap::increment() const {
  return unscaledIncrement(exponentialLessIdentity<Eigen::Dynamic>(MatrixXd(h_ * a_)));
}

MatrixXd RotorMap::power(bool driven) const {
  MatrixXd s = MatrixXd::Zero(a_.rows(), a_.rows());
  s.block(n_, n_, n_, n_) = -l_.damping;
  s.block(n_, 0, n_, n_) = -0.5 * l_.circulatory;
  s.block(0, n_, n_, n_) = s.block(n_, 0, n_, n_).transpose();
  Index input = 2 * n_;
  for (const ForceChannel& channel : channels_) {
    if (driven) {
      s.block(n_, input, n_, 2) = 0.5 * columns(channel);
      s.block(input, n_, 2, n_) = s.block(n_, input, n_, 2).transpose();
    }
    input += 2 * (degree_ + 1);
  }
  ++input;
  for (Index k = 0; k < acting_.count(); ++k) {
    s.block(n_, input, n_, 1) = 0.5 * acting_.directions().col(k);
    s.block(input, n_, 1, n_) = s.block(n_, input, n_, 1).transpose();
    input += acting_.columns(k, degree_);
  }
  return s;
}

MatrixXd RotorMap::work(bool driven) const {
  const MatrixXd scaled = unscale_.transpose() * power(driven) * unscale_;
  return scale_.transpose() * quadraticIntegral<Eigen::Dynamic>(a_, scaled, h_) * scale_;
}

std::vector<RotorStepMatrices> RotorMap::parts() const {
  const double nanosecond = 1e-9;
  MatrixXd e = exponentialLessIdentity<Eigen::Dynamic>(MatrixXd(nanosecond * a_));
  MatrixXd w = quadraticIntegral<Eigen::Dynamic>(
      a_, MatrixXd(unscale_.transpose() * power() * unscale_), nanosecond);
  std::vector<RotorStepMatrices> all;
  const std::int64_t longest = std::llround(h_ * 1e9);
  for (std::int64_t length = 1; length <= longest; length *= 2) {
    all.push_back({unscaledIncrement(e), scale_.transpose() * w * scale_});
    twiceAsLong<Eigen::Dynamic>(e, w);
  }
  return all;
}

}  // namespace whirl_twin
