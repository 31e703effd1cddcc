#include "integration/local_forces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace whirl_twin {

namespace {

constexpr int kMostRounds = 30;
constexpr double kLastRoom = 0.1;  // a pole's pull grows without bound there
constexpr double kSame = 1.0e-14;  // of what forces are differences of

/// The cubic of a force over a step, its coefficients of 1, tau, tau^2, tau^3.
std::array<double, 4> course(double from, double from_rate, double to, double to_rate, double h) {
  const double change = to - from;
  return {from, h * from_rate, 3.0 * change - h * (2.0 * from_rate + to_rate),
          h * (from_rate + to_rate) - 2.0 * change};
}

}  // namespace

LocalForces::LocalForces(std::vector<LocalForce> forces, const Inputs* inputs, Eigen::Index dof)
    : forces_(std::move(forces)),
      inputs_(inputs),
      directions_(dof, 2 * static_cast<Eigen::Index>(forces_.size())),
      from_(dof),
      start_(forces_.size()),
      end_(forces_.size()),
      found_(forces_.size()) {
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    directions_.col(2 * static_cast<Eigen::Index>(k)) = forces_[k].along_x;
    directions_.col(2 * static_cast<Eigen::Index>(k) + 1) = forces_[k].along_y;
  }
}

/// At an offset [s] into the piece of the inputs that `start` [s] is in.
bool LocalForces::pushes(const LinearMotion& motion, double start, double offset,
                         std::vector<LocalPush>& out) const noexcept {
  const auto piece = static_cast<std::int64_t>(std::floor(start * 1e9 + 1e-3));
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const LocalForce& force = forces_[k];
    LocalState at;
    at.place = {force.along_x.dot(motion.q()), force.along_y.dot(motion.q())};
    at.rate = {force.along_x.dot(motion.v()), force.along_y.dot(motion.v())};
    for (std::size_t i = 0; inputs_ != nullptr && i < 2; ++i) {
      const std::size_t input = force.inputs[i];
      if (inputs_->isHarmonic(input)) {
        const InputSignal& signal = inputs_->signal(input);
        const double phase = inputs_->phase(input) + signal.frequency * offset;
        at.input[i] = signal.amplitude * std::cos(phase);
        at.input_rate[i] = -signal.amplitude * signal.frequency * std::sin(phase);
      } else {
        const SignalPiece line = inputs_->piece(input, piece);
        at.input[i] = line.at(offset);
        at.input_rate[i] = line.slopeAt(offset);
      }
    }
    if (!force.law->push(at, out[k])) {
      return false;
    }
  }
  return true;
}

bool LocalForces::nearlyTouches(const LinearMotion& motion) const noexcept {
  return std::any_of(forces_.begin(), forces_.end(), [&](const LocalForce& force) {
    const Eigen::Vector2d place(force.along_x.dot(motion.q()), force.along_y.dot(motion.q()));
    return force.law->room(place) < kLastRoom * force.law->room(Eigen::Vector2d::Zero());
  });
}

StepStatus LocalForces::advance(RotorStep& step, const Drive& drive, double offset, double h,
                                LinearMotion& motion) noexcept {
  if (!pushes(motion, offset, offset, start_)) {
    return StepStatus::kNoGap;
  }
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      end_[k].force[i] = start_[k].force[i] + h * start_[k].rate[i];
      end_[k].rate[i] = start_[k].rate[i];
    }
  }
  from_ = motion;
  for (int round = 0; round < kMostRounds; ++round) {
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        step.push(2 * k + i, course(start_[k].force[i], start_[k].rate[i], end_[k].force[i],
                                    end_[k].rate[i], h));
      }
    }
    motion = from_;
    step.restart();
    const StepStatus status = step.advance(drive, offset, motion);
    if (status != StepStatus::kOk) {
      return status;
    }
    if (!pushes(motion, offset, offset + h, found_)) {
      return StepStatus::kNoGap;
    }
    bool same = true;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        same = same && std::fabs(found_[k].force[i] - end_[k].force[i]) <= kSame * found_[k].size;
      }
    }
    std::swap(end_, found_);
    if (same) {
      return StepStatus::kOk;
    }
  }
  return nearlyTouches(motion) ? StepStatus::kNoGap : StepStatus::kNotConverged;
}

}  // namespace whirl_twin
