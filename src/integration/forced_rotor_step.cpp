#include "integration/forced_rotor_step.h"

#include <algorithm>
#include <cmath>

#include "integration/rotor_map.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<double, 3> kTimes = kRadauNodes;
constexpr int kMaxRounds = 30;       // of a run-up
constexpr double kAgreed = 1.0e-12;  // of a run-up's forces

/// The coefficients of 1, tau, tau^2 of the quadratic that is 1 at node j and 0 at the others.
std::array<double, 3> atNode(std::size_t j) {
  const double a = kTimes[(j + 1) % 3];
  const double b = kTimes[(j + 2) % 3];
  const double size = (kTimes[j] - a) * (kTimes[j] - b);
  return {a * b / size, -(a + b) / size, 1.0 / size};
}

std::array<std::array<double, 3>, 3> courseOfNodes() {
  return {atNode(0), atNode(1), atNode(2)};
}

MatrixXd directionsOf(const std::vector<LocalForce>& forces, Index dof) {
  MatrixXd all(dof, 2 * static_cast<Index>(forces.size()));
  for (std::size_t k = 0; k < forces.size(); ++k) {
    all.col(2 * static_cast<Index>(k)) = forces[k].along_x;
    all.col(2 * static_cast<Index>(k) + 1) = forces[k].along_y;
  }
  return all;
}

}  // namespace

ForcedRotorStep::ForcedRotorStep(const LinearRotor& rotor, double h,
                                 const std::pair<double, double>& speeds,
                                 const std::vector<double>& constant_speeds,
                                 const RotorForcing& forcing)
    : forces_(forcing.forces),
      inputs_(forcing.inputs),
      h_(h),
      steady_(!rotor.speed_dependent),
      acting_(forcing.inputs, forcing.directions, directionsOf(forces_, rotor.dof())),
      torque_(forcing.torque),
      whole_(rotor, h, speeds, constant_speeds, acting_,
             forcing.spin == nullptr ? AuditedWork::kAll : AuditedWork::kWithoutShaft),
      from_(rotor.dof()) {
  if (forcing.spin != nullptr) {
    spin_.emplace(rotor, *forcing.spin, h);
  }
  const bool changes = speeds.second > speeds.first;
  for (std::size_t i = 0; (!forces_.empty() || spin_) && changes && i + 1 < kNodes; ++i) {
    to_nodes_.emplace_back(rotor, kTimes[i] * h, speeds, std::vector<double>(), acting_,
                           AuditedWork::kNone);
  }
  if (forces_.empty()) {
    return;
  }
  for (const double speed : constant_speeds) {
    responses_.push_back(response(rotor, speed));
  }
  if (changes) {
    responses_.push_back(response(rotor, 0.5 * (speeds.first + speeds.second)));
  }
  const Index n = unknowns();
  states_.resize(kNodes * forces_.size());
  places_.setZero(2 * n);
  moved_.setZero(2 * n);
  for (VectorXd* each :
       {&given_, &forced_, &law_, &sizes_, &rounding_, &residual_, &start_, &change_}) {
    each->setZero(n);
  }
  slopes_.setZero(n, 4);
  jacobian_.setZero(n, n);
  pivots_.resize(static_cast<std::size_t>(n));
  result_.setZero(PackedMatrix(MatrixXd::Zero(2 * n, 1)).rows());
}

/// By the maps to each node, where a step that starts with y is after a part c of it: courses over
/// the step are courses over its part with their powers of c.
ForcedRotorStep::Response ForcedRotorStep::response(const LinearRotor& rotor, double speed) const {
  const Index n = rotor.dof();
  const std::vector<ForceChannel> channels = forceChannels(rotor);
  const Index inputs = RotorMap::inputs(n, channels.size(), acting_, 0);
  const Index first_input = 2 * n + 2 * static_cast<Index>(channels.size()) + 1;
  const auto places = static_cast<Index>(4 * forces_.size());
  const auto pushed = static_cast<Index>(2 * forces_.size());
  const auto courses = courseOfNodes();
  MatrixXd start = MatrixXd::Zero(2 * unknowns(), inputs);
  MatrixXd force = MatrixXd::Zero(2 * unknowns(), unknowns());
  for (std::size_t node = 0; node < kNodes; ++node) {
    const double c = kTimes[node];
    MatrixXd reached = RotorMap(rotor, channels, acting_, speed, c * h_, 0).increment();
    reached.leftCols(2 * n) += MatrixXd::Identity(2 * n, 2 * n);
    Index column = first_input;
    for (Index k = 0; k < acting_.count(); ++k) {
      const Index columns = acting_.columns(k, 0);
      for (Index power = 0; !acting_.isHarmonic(k) && power < columns; ++power) {
        reached.col(column + power) *= std::pow(c, static_cast<double>(power));
      }
      column += columns;
    }
    MatrixXd seen(places, inputs);
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const auto row = static_cast<Index>(4 * k);
      seen.row(row) = forces_[k].along_x.transpose() * reached.topRows(n);
      seen.row(row + 1) = forces_[k].along_y.transpose() * reached.topRows(n);
      seen.row(row + 2) = forces_[k].along_x.transpose() * reached.bottomRows(n);
      seen.row(row + 3) = forces_[k].along_y.transpose() * reached.bottomRows(n);
    }
    const Index pushes = inputs - pushed * (AppliedInputs::kDegree + 1);
    for (std::size_t j = 0; j < kNodes; ++j) {
      for (Index k = 0; k < pushed; ++k) {
        const Index power = pushes + k * (AppliedInputs::kDegree + 1);
        force.block(static_cast<Index>(node) * places, static_cast<Index>(j) * pushed + k, places,
                    1) = courses[j][0] * seen.col(power) + courses[j][1] * seen.col(power + 1) +
                         courses[j][2] * seen.col(power + 2);
      }
    }
    seen.rightCols(inputs - pushes).setZero();
    start.middleRows(static_cast<Index>(node) * places, places) = seen;
  }
  return {speed, PackedMatrix(start), force};
}

const ForcedRotorStep::Response& ForcedRotorStep::responseNear(double speed) const noexcept {
  return *std::min_element(responses_.begin(), responses_.end(),
                           [speed](const Response& a, const Response& b) {
                             return std::fabs(a.speed - speed) < std::fabs(b.speed - speed);
                           });
}

/// At a time [s] after begin(), in the piece that starts at or before `piece` [ns].
double ForcedRotorStep::inputAt(std::size_t input, double time, std::int64_t piece) const noexcept {
  if (inputs_->isHarmonic(input)) {
    const InputSignal& signal = inputs_->signal(input);
    return signal.amplitude * std::cos(inputs_->phase(input) + signal.frequency * time);
  }
  return inputs_->piece(input, piece).at(time);
}

/// Of the nodes of a step from offset [s] on.
void ForcedRotorStep::setInputs(double offset) noexcept {
  if (inputs_ == nullptr) {
    return;
  }
  const auto piece = static_cast<std::int64_t>(std::floor(offset * 1e9 + 1e-3));
  for (std::size_t node = 0; node < kNodes; ++node) {
    const double time = offset + kTimes[node] * h_;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      LocalState& at = states_[node * forces_.size() + k];
      for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t input = forces_[k].inputs[i];
        at.input[i] = input != LocalForce::kNoInput ? inputAt(input, time, piece) : at.input[i];
      }
    }
  }
}

/// On the spin, from outside and of the laws.
double ForcedRotorStep::torqueAt(std::size_t node, double offset) const noexcept {
  double sum = 0.0;
  if (inputs_ != nullptr && torque_ != LocalForce::kNoInput && inputs_->acts(torque_)) {
    const double time = offset + kTimes[node] * h_;
    // A breakpoint in between takes effect at the next node.
    sum = inputAt(torque_, time, static_cast<std::int64_t>(std::floor(time * 1e9 - 1e-3)));
  }
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    sum += forces_[k].law->moment(states_[node * forces_.size() + k]);
  }
  return sum;
}

/// The courses that forced_ has over a part of the step, `length` of it.
void ForcedRotorStep::pushCourses(RotorStep& step, double length) noexcept {
  static const auto kCourses = courseOfNodes();
  const auto pushed = static_cast<Index>(2 * forces_.size());
  for (Index k = 0; k < pushed; ++k) {
    std::array<double, 4> course{};
    double scale = 1.0;
    for (std::size_t power = 0; power < 3; ++power, scale *= length) {
      for (std::size_t node = 0; node < kNodes; ++node) {
        course[power] +=
            scale * kCourses[node][power] * forced_[static_cast<Index>(node) * pushed + k];
      }
    }
    step.push(static_cast<std::size_t>(k), course);
  }
}

void ForcedRotorStep::readPlaces(const LinearMotion& motion, std::size_t node) noexcept {
  double* place = places_.data() + 4 * node * forces_.size();
  for (const LocalForce& force : forces_) {
    *place++ = force.along_x.dot(motion.q());
    *place++ = force.along_y.dot(motion.q());
    *place++ = force.along_x.dot(motion.v());
    *place++ = force.along_y.dot(motion.v());
  }
}

/// The forces at the present state of the rotor, at all nodes.
bool ForcedRotorStep::begin(const LinearMotion& motion) noexcept {
  for (std::size_t node = 0; node < kNodes; ++node) {
    readPlaces(motion, node);
  }
  moved_ = places_;
  return pushes(moved_, forced_);
}

StepStatus ForcedRotorStep::advance(const Drive& drive, double offset,
                                    LinearMotion& motion) noexcept {
  if (forces_.empty()) {
    return whole_.advance(drive, offset, motion);
  }
  for (std::size_t node = 0; node < kNodes; ++node) {
    const double speed = drive.at(offset + kTimes[node] * h_).speed;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      states_[node * forces_.size() + k].speed = speed;
    }
  }
  setInputs(offset);
  if (!begin(motion)) {
    return StepStatus::kNoGap;
  }
  std::size_t which = 0;
  if (const double* const start = whole_.constantStart(drive, offset, motion, which)) {
    responses_[which].start.multiply(start, result_.data());
    places_ = result_.head(places_.size());
    given_.setZero();
    predict(responses_[which].force);
    const StepStatus status = solve(responses_[which].force);
    if (status != StepStatus::kOk) {
      return status;
    }
    pushCourses(whole_, 1.0);
    return whole_.advance(drive, offset, motion);
  }
  return changingStep(drive, offset, motion);
}

/// From the start of the step, from_, to one of its nodes.
template <class Shaft>
StepStatus ForcedRotorStep::goTo(std::size_t node, const Shaft& shaft, double offset,
                                 LinearMotion& motion) noexcept {
  RotorStep& step = node < to_nodes_.size() ? to_nodes_[node] : whole_;
  pushCourses(step, kTimes[node]);
  motion = from_;
  step.restart();
  const StepStatus status = step.move(shaft, offset, motion);
  readPlaces(motion, node);
  return status;
}

/// The rotor having been taken along to places_ with the forces forced_: those of the laws.
StepStatus ForcedRotorStep::findForces(const Response& response, int round, bool& agreed) noexcept {
  given_ = forced_;
  if (round == 0) {
    predict(response.force);
  }
  const StepStatus status = solve(response.force);
  agreed = status == StepStatus::kOk;
  for (Index i = 0; agreed && i < given_.size(); ++i) {
    agreed = std::fabs(forced_[i] - given_[i]) <= kAgreed * (sizes_[i] + rounding_[i]);
  }
  return status;
}

StepStatus ForcedRotorStep::changingStep(const Drive& drive, double offset,
                                         LinearMotion& motion) noexcept {
  if (to_nodes_.empty()) {
    return StepStatus::kOutOfRange;
  }
  const Response& response = responseNear(drive.at(offset).speed);
  from_ = motion;
  for (int round = 0; round < kMaxRounds; ++round) {
    StepStatus status = StepStatus::kOk;
    for (std::size_t node = 0; status == StepStatus::kOk && node < kNodes; ++node) {
      status = goTo(node, drive, offset, motion);
    }
    bool agreed = true;
    status = status == StepStatus::kOk ? findForces(response, round, agreed) : status;
    if (status == StepStatus::kOk && steady_ && !agreed) {
      // The places that the forces were found for are those that they lead to.
      status = goTo(kNodes - 1, drive, offset, motion);
      agreed = true;
    }
    if (status != StepStatus::kOk) {
      return status;
    }
    if (agreed) {
      motion.work.add(whole_.work(drive, offset, from_.state, motion.state));
      return StepStatus::kOk;
    }
  }
  return StepStatus::kNotConverged;
}

StepStatus ForcedRotorStep::advance(double offset, SpinMotion& spin,
                                    LinearMotion& motion) noexcept {
  spin_->begin(offset, spin, motion);
  setInputs(offset);
  const auto setSpeeds = [&] {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i].speed = spin_->speed(i / forces_.size());
    }
  };
  setSpeeds();
  if (!begin(motion)) {
    return StepStatus::kNoGap;
  }
  const Response* const response = forces_.empty() ? nullptr : &responseNear(spin.speed.high);
  from_ = motion;
  for (int round = 0; round < kMaxRounds; ++round) {
    StepStatus status = StepStatus::kOk;
    for (std::size_t node = 0; status == StepStatus::kOk && node < kNodes; ++node) {
      status = goTo(node, spin_->course(), offset, motion);
      spin_->take(node, motion);
    }
    bool agreed = true;
    if (status == StepStatus::kOk && response != nullptr) {
      status = findForces(*response, round, agreed);
    }
    for (std::size_t node = 0; node < kNodes; ++node) {
      spin_->add(node, torqueAt(node, offset));
    }
    if (status == StepStatus::kOk && !spin_->mend()) {
      status = StepStatus::kNotFinite;
    }
    if (status != StepStatus::kOk) {
      return status;
    }
    if (agreed && spin_->agrees()) {
      motion.work.add(whole_.work(spin_->course(), offset, from_.state, motion.state));
      motion.work.add(spin_->finish(spin));
      return StepStatus::kOk;
    }
    setSpeeds();
  }
  return StepStatus::kNotConverged;
}

}  // namespace whirl_twin
