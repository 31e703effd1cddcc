#include "analysis/sampled_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/loop_instants.h"
#include "integration/matrix_exponential.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

// What a loop does when nothing moves: its equations at rest, exact whatever the rates are.

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kCancelledAtRest = 1e-13;  // of the terms whose sum is nothing but rounding

/// Rows and columns times powers of two: the largest of each is near 1.
MatrixXd equilibrated(MatrixXd m) {
  constexpr int kRounds = 8;
  const auto toOne = [](auto line) {
    const double largest = line.cwiseAbs().maxCoeff();
    if (largest > 0.0) {
      line *= powerOfTwo(1.0 / largest);
    }
  };
  for (int round = 0; round < kRounds; ++round) {
    for (Index i = 0; i < m.rows(); ++i) {
      toOne(m.row(i));
      toOne(m.col(i));
    }
  }
  return m;
}

/// In how many directions plant and laws rest wherever they are left, to 1e-13 of the terms that
/// cancel there (a magnet that takes away just the stiffness that its bias gives). Rest does not
/// depend on rates, delays and poles of sensors and actuators.
int standingDirections(const LoopPlant& plant, const std::vector<LoopController>& controllers) {
  const Index n = plant.a.rows();
  Index size = n;
  for (const LoopController& controller : controllers) {
    size += controller.law.states() + static_cast<Index>(controller.acts_on.size());
  }
  MatrixXd rest = MatrixXd::Zero(size, size);
  rest.topLeftCorner(n, n) = plant.a;
  Index next = n;
  for (const LoopController& controller : controllers) {
    const DiscreteStateSpace& law = controller.law;
    const Index states = law.states();
    const Index outputs = static_cast<Index>(controller.acts_on.size());
    MatrixXd c(static_cast<Index>(controller.measures.size()), n);
    for (Index i = 0; i < c.rows(); ++i) {
      c.row(i) = plant.c.row(controller.measures[static_cast<std::size_t>(i)]);
    }
    rest.block(next, 0, states, n) = law.b * c;
    rest.block(next, next, states, states) = law.a - MatrixXd::Identity(states, states);
    rest.block(next + states, 0, outputs, n) = law.d * c;
    rest.block(next + states, next, outputs, states) = law.c;
    rest.block(next + states, next + states, outputs, outputs).diagonal().setConstant(-1.0);
    for (Index i = 0; i < outputs; ++i) {
      rest.col(next + states + i).head(n) +=
          plant.b.col(controller.acts_on[static_cast<std::size_t>(i)]);
    }
    next += states + outputs;
  }
  if (size == 0) {
    return 0;
  }
  return static_cast<int>((singularValues(equilibrated(rest)).array() <= kCancelledAtRest).count());
}

using Eigen::Index;
using Eigen::MatrixXd;

Index sizeOf(const std::vector<Index>& indices) {
  return static_cast<Index>(indices.size());
}

void checkNumbers(const LoopController& c) {
  const auto refuse = [&](const char* what, double found) {
    throw InputError(fmt::format("controller {}: expected {}, found {}", c.name, what, found));
  };
  if (!(c.rate > 0.0) || !std::isfinite(c.rate)) {
    refuse("a rate [Hz] > 0", c.rate);
  }
  for (const double delay : {c.delay, c.sensor_delay}) {
    if (!(delay >= 0.0) || !std::isfinite(delay)) {
      refuse("a delay [s] >= 0", delay);
    }
  }
  for (const double bandwidth : {c.sensor_bandwidth, c.actuator_bandwidth}) {
    if (!(bandwidth >= 0.0) || !std::isfinite(bandwidth)) {
      refuse("a bandwidth [Hz] >= 0", bandwidth);
    }
  }
}

void checkShapes(const LoopPlant& plant, const LoopController& c) {
  const auto within = [](const std::vector<Index>& indices, Index size) {
    return std::all_of(indices.begin(), indices.end(),
                       [size](Index i) { return i >= 0 && i < size; });
  };
  const DiscreteStateSpace& law = c.law;
  const Index states = law.a.rows();
  const Index measured = sizeOf(c.measures);
  const Index outputs = sizeOf(c.acts_on);
  if (law.a.cols() != states || law.b.rows() != states || law.b.cols() != measured ||
      law.c.rows() != outputs || law.c.cols() != states || law.d.rows() != outputs ||
      law.d.cols() != measured || !within(c.measures, plant.c.rows()) ||
      !within(c.acts_on, plant.b.cols())) {
    throw std::logic_error("sampled loop: the size of a control law does not match its signals");
  }
}

void checkLoop(const LoopPlant& plant, const std::vector<LoopController>& controllers) {
  if (plant.a.cols() != plant.a.rows() || plant.b.rows() != plant.a.rows() ||
      plant.c.cols() != plant.a.rows()) {
    throw std::logic_error("sampled loop: the sizes of the plant's matrices do not match");
  }
  if (controllers.empty()) {
    throw InputError("sampled loop: expected at least one controller, found none");
  }
  for (const LoopController& c : controllers) {
    checkNumbers(c);
    checkShapes(plant, c);
    if ((c.delay + c.sensor_delay) * c.rate > kMaxLoopStates) {
      throw RunFailure(fmt::format(
          "controller {}: the delay must be at most {} samples for an analysis, found {:g}", c.name,
          kMaxLoopStates, (c.delay + c.sensor_delay) * c.rate));
    }
  }
}

/// The plant with the poles of sensors and actuators: x' = a x + b u of all held outputs u, each
/// controller's in turn, which reads c x.
struct Continuous {
  MatrixXd a, b;
  std::vector<MatrixXd> c;
};

Continuous continuousPart(const LoopPlant& plant, const std::vector<LoopController>& controllers) {
  Index states = plant.a.rows();
  Index outputs = 0;
  for (const LoopController& controller : controllers) {
    states += controller.sensor_bandwidth > 0.0 ? sizeOf(controller.measures) : 0;
    states += controller.actuator_bandwidth > 0.0 ? sizeOf(controller.acts_on) : 0;
    outputs += sizeOf(controller.acts_on);
  }
  const Index n = plant.a.rows();
  Continuous part{MatrixXd::Zero(states, states), MatrixXd::Zero(states, outputs), {}};
  part.a.topLeftCorner(n, n) = plant.a;
  Index next = n;
  Index output = 0;
  for (const LoopController& controller : controllers) {
    const Index measured = sizeOf(controller.measures);
    MatrixXd c = MatrixXd::Zero(measured, states);
    for (Index i = 0; i < measured; ++i) {
      c.row(i).head(n) = plant.c.row(controller.measures[static_cast<std::size_t>(i)]);
    }
    if (controller.sensor_bandwidth > 0.0) {
      const double pole = kTwoPi * controller.sensor_bandwidth;
      part.a.middleRows(next, measured) = pole * c;
      part.a.block(next, next, measured, measured).diagonal().setConstant(-pole);
      c.setZero();
      c.middleCols(next, measured).setIdentity();
      next += measured;
    }
    part.c.push_back(c);
    const double pole = kTwoPi * controller.actuator_bandwidth;
    for (const Index input : controller.acts_on) {
      if (pole > 0.0) {
        part.a.col(next).head(n) += plant.b.col(input);
        part.a(next, next) = -pole;
        part.b(next++, output++) = pole;
      } else {
        part.b.col(output++).head(n) += plant.b.col(input);
      }
    }
  }
  return part;
}

/// Takes the loop through a period. Every quantity is rows of a linear map of the states at the
/// beginning and of what is added at the tap, sample by sample.
class LoopWalk {
 public:
  LoopWalk(const Continuous& part, const std::vector<LoopController>& controllers,
           LoopInstants instants, const std::vector<LoopPlace>& places)
      : part_(part), controllers_(controllers), instants_(std::move(instants)), places_(places) {
    begin();
    std::int64_t now = 0;
    for (const LoopEvent& event : instants_.events) {
      pass(event.tick - now);
      now = event.tick;
      event.acts ? act(event.controller) : read(event.controller);
    }
    pass(instants_.period - now);
  }

  Index states() const { return states_; }

  /// Rows of all states at the end.
  MatrixXd end() const {
    MatrixXd rows(states_, columns_);
    Index next = 0;
    const auto add = [&](const MatrixXd& m) {
      rows.middleRows(next, m.rows()) = m;
      next += m.rows();
    };
    add(x_);
    for (std::size_t i = 0; i < controllers_.size(); ++i) {
      add(law_[i]);
      std::for_each(on_the_way_[i].begin(), on_the_way_[i].end(), add);
      if (instants_.held[i]) {
        add(held_.middleRows(first_output_[i], sizeOf(controllers_[i].acts_on)));
      }
    }
    return rows;
  }

  /// Rows of what was found at the places.
  const MatrixXd& shown() const { return shown_; }

 private:
  void begin() {
    const auto count = static_cast<Index>(controllers_.size());
    states_ = part_.a.rows();
    for (std::size_t i = 0; i < controllers_.size(); ++i) {
      const Index pending = instants_.on_the_way[i] + (instants_.held[i] ? 1 : 0);
      states_ += controllers_[i].law.states() + pending * sizeOf(controllers_[i].acts_on);
    }
    if (states_ > kMaxLoopStates) {
      throw RunFailure(
          fmt::format("sampled loop: must have at most {2} states for an analysis, found {1} of "
                      "{0} controllers, their delays and plants",
                      count, states_, kMaxLoopStates));
    }
    columns_ = states_;
    for (const LoopPlace& place : places_) {
      tapped_.push_back(columns_ - states_);
      columns_ += instants_.samples[place.controller];
    }
    Index next = 0;
    const auto take = [&](Index rows) {
      MatrixXd m = MatrixXd::Zero(rows, columns_);
      m.middleCols(next, rows).setIdentity();
      next += rows;
      return m;
    };
    x_ = take(part_.a.rows());
    held_ = MatrixXd::Zero(part_.b.cols(), columns_);
    Index output = 0;
    for (std::size_t i = 0; i < controllers_.size(); ++i) {
      const Index outputs = sizeOf(controllers_[i].acts_on);
      law_.push_back(take(controllers_[i].law.states()));
      on_the_way_.emplace_back();
      for (int k = 0; k < instants_.on_the_way[i]; ++k) {
        on_the_way_.back().push_back(take(outputs));
      }
      first_output_.push_back(output);
      if (instants_.held[i]) {
        held_.middleRows(output, outputs) = take(outputs);
      }
      output += outputs;
    }
    shown_.resize(columns_ - states_, columns_);
  }

  void pass(std::int64_t ticks) {
    if (ticks == 0 || part_.a.size() == 0) {
      return;
    }
    MatrixXd& increment = increments_[ticks];
    const Index n = part_.a.rows();
    if (increment.size() == 0) {
      MatrixXd all = MatrixXd::Zero(n + part_.b.cols(), n + part_.b.cols());
      all.topRows(n) << part_.a, part_.b;
      all *= static_cast<double>(ticks) * instants_.tick;
      increment = exponentialLessIdentity<Eigen::Dynamic>(all).topRows(n);
    }
    x_ += (increment.leftCols(n) * x_ + increment.rightCols(part_.b.cols()) * held_).eval();
  }

  void read(std::size_t i) {
    MatrixXd measured = part_.c[i] * x_;
    tap(i, false, measured);
    const DiscreteStateSpace& law = controllers_[i].law;
    MatrixXd output = law.c * law_[i] + law.d * measured;
    tap(i, true, output);
    on_the_way_[i].push_back(std::move(output));
    law_[i] = (law.a * law_[i] + law.b * measured).eval();
  }

  void tap(std::size_t i, bool at_output, MatrixXd& signals) {
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (places_[k].controller == i && places_[k].at_output == at_output) {
        signals(places_[k].channel, states_ + tapped_[k]) += 1.0;
        shown_.row(tapped_[k]++) = signals.row(places_[k].channel);
      }
    }
  }

  void act(std::size_t i) {
    held_.middleRows(first_output_[i], sizeOf(controllers_[i].acts_on)) = on_the_way_[i].front();
    on_the_way_[i].pop_front();
  }

  const Continuous& part_;
  const std::vector<LoopController>& controllers_;
  LoopInstants instants_;
  const std::vector<LoopPlace>& places_;
  std::vector<Index> tapped_;  // of each place: the sample that comes next
  Index states_ = 0, columns_ = 0;
  MatrixXd x_, held_, shown_;
  std::vector<MatrixXd> law_;
  std::vector<std::deque<MatrixXd>> on_the_way_;
  std::vector<Index> first_output_;
  std::map<std::int64_t, MatrixXd> increments_;  // e^(A t) - I beside its integral times B
};

}  // namespace

SampledLoop sampledLoop(const LoopPlant& plant, const std::vector<LoopController>& controllers) {
  checkLoop(plant, controllers);
  const Continuous part = continuousPart(plant, controllers);
  const LoopInstants instants = loopInstants(controllers);
  const std::vector<LoopPlace> nowhere;
  const LoopWalk walk(part, controllers, instants, nowhere);
  SampledLoop loop;
  loop.transition = walk.end();
  loop.period = static_cast<double>(instants.period) * instants.tick;
  loop.samples = instants.samples;
  loop.whole_nanoseconds = instants.whole_nanoseconds;
  loop.standing = standingDirections(plant, controllers);
  return loop;
}

LoopTap loopTap(const LoopPlant& plant, const std::vector<LoopController>& controllers,
                const std::vector<LoopPlace>& places) {
  checkLoop(plant, controllers);
  for (const LoopPlace& place : places) {
    const bool found =
        place.controller < controllers.size() && place.channel >= 0 &&
        place.channel < sizeOf(place.at_output ? controllers[place.controller].acts_on
                                               : controllers[place.controller].measures);
    if (!found) {
      throw std::logic_error("sampled loop: there is no such measure or output");
    }
  }
  const Continuous part = continuousPart(plant, controllers);
  const LoopWalk walk(part, controllers, loopInstants(controllers), places);
  const Index n = walk.states();
  const MatrixXd end = walk.end();
  return {end.rightCols(end.cols() - n), walk.shown().leftCols(n),
          walk.shown().rightCols(end.cols() - n)};
}

}  // namespace whirl_twin
