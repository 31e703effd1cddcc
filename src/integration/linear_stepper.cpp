#include "integration/linear_stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "integration/finite.h"
#include "integration/linear_methods.h"
#include "integration/sliver.h"

namespace whirl_twin {

namespace {

/// Compensated sums, in a loop that the compiler takes several at a time.
void addTo(double* __restrict high, double* __restrict low, const double* __restrict increment,
           Eigen::Index n) noexcept {
  for (Eigen::Index i = 0; i < n; ++i) {
    const double corrected = increment[i] + low[i];
    const double sum = high[i] + corrected;
    low[i] = corrected - (sum - high[i]);
    high[i] = sum;
  }
}

}  // namespace

LinearMotion::LinearMotion(Eigen::Index n)
    : state(Eigen::VectorXd::Zero(2 * n)), low(Eigen::VectorXd::Zero(2 * n)) {}

void LinearMotion::set(const double* position, const double* rate) noexcept {
  q() = Eigen::Map<const Eigen::VectorXd>(position, dof());
  v() = Eigen::Map<const Eigen::VectorXd>(rate, dof());
  low.setZero();
  work = CompensatedSum{};
}

void LinearMotion::advance(const double* increment, double energy) noexcept {
  addTo(state.data(), low.data(), increment, state.size());
  work.add(energy);
}

LinearStep::LinearStep(const LinearModel& model, const std::string& method, double h,
                       const AppliedInputs& inputs)
    : n_(model.mass.rows()), inputs_(inputs) {
  const LinearEquation equation(model, inputs_);
  frequencies_ = equation.frequencies();
  const Eigen::Index size = equation.size();
  y_.setZero(size);
  const LinearStepMap map = linearStepMap(equation, method, h);
  map_ = stepMatrix(map.increment, map.work);
  result_.setZero(map_.rows());
  if (inputs_.haveTables()) {
    for (const LinearStepMap& part : exactParts(equation, std::llround(h * 1e9) + 1)) {
      parts_.push_back(stepMatrix(part.increment, part.work));
    }
  }
}

void LinearStep::apply(PackedMatrix& map, double time, double offset, std::int64_t piece,
                       LinearMotion& motion) noexcept {
  y_.head(2 * n_) = motion.state;
  double* phasor = y_.data() + 2 * n_;
  for (const double frequency : frequencies_) {
    const double cosine = std::cos(frequency * time);  // both together cost little more than one
    const double sine = std::sin(frequency * time);
    *phasor++ = cosine;
    *phasor++ = sine;
  }
  if (inputs_.count() > 0) {
    inputs_.writePairs(offset, piece, 1.0, phasor);
  }
  map.multiply(y_.data(), result_.data());
  motion.advance(result_.data(), y_.dot(result_.segment(2 * n_, y_.size())));
}

void LinearStep::advance(double time, LinearMotion& motion, double offset) noexcept {
  const std::int64_t piece = inputs_.count() > 0 ? wholeNanoseconds(offset) : 0;
  apply(map_, time, offset, piece, motion);
}

void LinearStep::advanceInParts(double time, std::int64_t from, std::int64_t to,
                                LinearMotion& motion) noexcept {
  while (from < to) {
    const std::int64_t corner = std::min(inputs_.nextCorner(from), to);
    const std::int64_t piece = from;
    for (std::size_t k = parts_.size(); k-- > 0;) {
      for (; corner - from >= std::int64_t{1} << k; from += std::int64_t{1} << k) {
        const double offset = static_cast<double>(from) / 1e9;
        apply(parts_[k], time + offset, offset, piece, motion);
      }
    }
  }
}

bool isFinite(const LinearMotion& motion) noexcept {
  // A value that is not finite makes the sum not finite.
  return isFinite(motion.work.high + motion.state.sum());
}

void write(const LinearMotion& motion, double* out) noexcept {
  out = std::copy_n(motion.state.data(), motion.state.size(), out);
  *out = motion.work.high;
}

Eigen::MatrixXd directionsOf(const std::vector<InputInfo>& inputs, Eigen::Index n) {
  Eigen::MatrixXd directions(n, static_cast<Eigen::Index>(inputs.size()));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    directions.col(static_cast<Eigen::Index>(i)) = inputs[i].direction;
  }
  return directions;
}

LinearStepper::LinearStepper(const LinearModel& model, const std::string& method, double step,
                             int substeps, const Inputs* inputs)
    : inputs_(inputs, directionsOf(model.inputs, model.mass.rows())),
      method_(model, method, step / substeps, inputs_),
      halves_(model, method, 0.5 * step / substeps, inputs_),
      parts_(inputs,
             [&](double length) { return LinearStep(model, "exponential", length, inputs_); }),
      substep_(step / substeps),
      substeps_(substeps),
      step_(std::llround(step * 1e9)),
      state_(model.mass.rows()),
      next_(model.mass.rows()),
      finer_(model.mass.rows()) {
  for (const CoordinateInfo& c : model.coordinates) {
    angular_.push_back(c.isAngle());
  }
}

StepStatus LinearStepper::step(double time) noexcept {
  next_ = state_;
  const bool corner = inputs_.nextCorner(0) < step_;
  if (corner) {
    method_.advanceInParts(time, 0, step_, next_);
  } else {
    for (int i = 0; i < substeps_; ++i) {
      method_.advance(time + i * substep_, next_, i * substep_);
    }
  }
  if (!isFinite(next_)) {
    return StepStatus::kNotFinite;
  }
  if (errors_.countStep()) {
    if (corner) {
      errors_.passOver();  // such a step is exact
    } else {
      estimateError(time);
    }
  }
  std::swap(state_, next_);
  return StepStatus::kOk;
}

StepStatus LinearStepper::stepPart(double time, std::int64_t from, std::int64_t to) noexcept {
  next_ = state_;
  if (inputs_.nextCorner(from) < to) {
    method_.advanceInParts(time, from, to, next_);
  } else {
    parts_.advance(from, to, [&](LinearStep& part, double offset, double) {
      part.advance(time + offset, next_, offset);
      return StepStatus::kOk;
    });
  }
  if (!isFinite(next_)) {
    return StepStatus::kNotFinite;
  }
  std::swap(state_, next_);
  return StepStatus::kOk;
}

/// Repeats the step from state_ to next_ as two half steps.
void LinearStepper::estimateError(double time) noexcept {
  finer_ = state_;
  const double h = 0.5 * substep_;
  for (int i = 0; i < 2 * substeps_; ++i) {
    halves_.advance(time + i * h, finer_, i * h);
  }
  errors_.add(dof(), substeps_ * substep_, state_.v().data(), next_.q().data(), next_.v().data(),
              finer_.q().data(), finer_.v().data(),
              [&](std::size_t i) { return angular_[i] != 0; });
}

void LinearStepper::motion(double* out) const noexcept {
  std::copy_n(state_.state.data(), state_.state.size(), out);
}

void LinearStepper::write(double* out) const noexcept {
  whirl_twin::write(state_, out);
}

void LinearStepper::set(const double* q, const double* v) noexcept {
  state_.set(q, v);
  errors_.restart();
}

}  // namespace whirl_twin
