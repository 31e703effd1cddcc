#include "integration/linear_step.h"

#include <algorithm>
#include <cmath>

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
                       const ActingInputs& inputs)
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

}  // namespace whirl_twin
