#include "integration/input_force.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "integration/sliver.h"

namespace whirl_twin {

// Here once, and not with the steps of every model and method.
InputForce::InputForce() = default;
InputForce::InputForce(const InputForce& other) = default;
InputForce& InputForce::operator=(const InputForce& other) = default;
InputForce::~InputForce() = default;

InputForce::InputForce(const Inputs* inputs, const std::vector<InputInfo>& directions)
    : inputs_(inputs) {
  if (inputs == nullptr) {
    return;
  }
  if (inputs->count() != directions.size()) {
    throw std::logic_error("a system has been given inputs that its model does not have");
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::VectorXd& direction = directions[i].direction;
    held_.resize(static_cast<std::size_t>(direction.size()));
    if (inputs->acts(i)) {
      const InputSignal& signal = inputs->signal(i);
      acting_.push_back({i,
                         inputs->isHarmonic(i),
                         signal.amplitude,
                         signal.frequency,
                         {direction.data(), direction.data() + direction.size()},
                         {},
                         0.0});
    }
  }
}

double InputForce::nextCorner(double offset) const noexcept {
  const std::int64_t corner = inputs_->nextCorner(wholeNanoseconds(offset));
  return corner == Inputs::kNever ? std::numeric_limits<double>::max()
                                  : static_cast<double>(corner) / 1e9;
}

void InputForce::enter(double offset) noexcept {
  std::fill(held_.begin(), held_.end(), 0.0);
  varies_ = false;
  for (Acting& acting : acting_) {
    if (acting.harmonic) {
      acting.phase = inputs_->phase(acting.input);
      varies_ = true;
      continue;
    }
    acting.piece = inputs_->piece(acting.input, wholeNanoseconds(offset));
    if (acting.piece.slope != 0.0) {
      varies_ = true;
      continue;
    }
    for (std::size_t j = 0; j < held_.size(); ++j) {
      held_[j] += acting.piece.value * acting.direction[j];
    }
  }
}

void InputForce::at(double offset, double* all, double* varying) const noexcept {
  std::copy(held_.begin(), held_.end(), all);
  std::fill_n(varying, held_.size(), 0.0);
  if (!varies_) {
    return;
  }
  for (const Acting& acting : acting_) {
    if (!acting.harmonic && acting.piece.slope == 0.0) {
      continue;
    }
    const double u = acting.harmonic
                         ? acting.amplitude * std::cos(acting.phase + acting.frequency * offset)
                         : acting.piece.at(offset);
    for (std::size_t j = 0; j < held_.size(); ++j) {
      varying[j] += u * acting.direction[j];
    }
  }
  for (std::size_t j = 0; j < held_.size(); ++j) {
    all[j] += varying[j];
  }
}

void InputForce::now(double* all) const noexcept {
  std::fill_n(all, held_.size(), 0.0);
  for (const Acting& acting : acting_) {
    const double u = inputs_->value(acting.input, 0.0);
    for (std::size_t j = 0; j < held_.size(); ++j) {
      all[j] += u * acting.direction[j];
    }
  }
}

}  // namespace whirl_twin
