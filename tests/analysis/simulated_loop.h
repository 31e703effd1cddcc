// Simulation of a closed loop: from instant to instant by matrix exponentials in extended
// precision, independent of the transition matrices.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "analysis/sampled_loop.h"

namespace whirl_twin {

/// Of controllers without poles and delays of sensors.
class SimulatedLoop {
 public:
  using Number = long double;
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

  SimulatedLoop(const LoopPlant& plant, std::vector<LoopController> controllers, Matrix start)
      : plant_(plant), controllers_(std::move(controllers)), x_(std::move(start)) {
    for (const LoopController& c : controllers_) {
      law_.push_back(Matrix::Zero(c.law.states(), 1));
      held_.push_back(Matrix::Zero(c.law.c.rows(), 1));
      samples_.push_back(0);
      late_.emplace_back();
    }
  }

  const Matrix& plantState() const { return x_; }

  /// To just before this nanosecond.
  void runTo(std::int64_t end) {
    while (true) {
      std::int64_t next = end;
      for (std::size_t i = 0; i < controllers_.size(); ++i) {
        next = std::min(next, sampleTime(i));
        if (!late_[i].empty()) {
          next = std::min(next, late_[i].front().time);
        }
      }
      pass(next - now_);
      now_ = next;
      if (next == end) {
        return;
      }
      for (std::size_t i = 0; i < controllers_.size(); ++i) {
        if (sampleTime(i) == now_) {
          sample(i);
        }
      }
      for (std::size_t i = 0; i < controllers_.size(); ++i) {
        if (!late_[i].empty() && late_[i].front().time == now_) {
          held_[i] = late_[i].front().output;
          late_[i].pop_front();
        }
      }
    }
  }

 private:
  struct Late {
    std::int64_t time;
    Matrix output;
  };

  std::int64_t sampleTime(std::size_t i) const {
    return std::llround(static_cast<long double>(samples_[i]) * 1e9L / controllers_[i].rate);
  }

  void sample(std::size_t i) {
    const LoopController& c = controllers_[i];
    Matrix y(c.law.b.cols(), 1);
    for (std::size_t k = 0; k < c.measures.size(); ++k) {
      y.row(static_cast<Eigen::Index>(k)) = plant_.c.row(c.measures[k]).cast<Number>() * x_;
    }
    late_[i].push_back({now_ + std::llround(1e9 * c.delay),
                        c.law.c.cast<Number>() * law_[i] + c.law.d.cast<Number>() * y});
    law_[i] = (c.law.a.cast<Number>() * law_[i] + c.law.b.cast<Number>() * y).eval();
    ++samples_[i];
  }

  void pass(std::int64_t nanoseconds) {
    const Eigen::Index n = x_.rows();
    const Eigen::Index inputs = plant_.b.cols();
    Matrix& step = steps_[nanoseconds];
    if (step.size() == 0) {
      Matrix all = Matrix::Zero(n + inputs, n + inputs);
      all.topRows(n) << plant_.a.cast<Number>(), plant_.b.cast<Number>();
      all *= static_cast<Number>(nanoseconds) * 1e-9L / 1024.0L;
      step = Matrix::Identity(n + inputs, n + inputs);
      for (int k = 25; k > 0; --k) {
        step = (Matrix::Identity(n + inputs, n + inputs) + all * step / k).eval();
      }
      for (int k = 0; k < 10; ++k) {
        step = (step * step).eval();
      }
    }
    Matrix u = Matrix::Zero(inputs, 1);
    for (std::size_t i = 0; i < controllers_.size(); ++i) {
      for (std::size_t k = 0; k < controllers_[i].acts_on.size(); ++k) {
        u.row(controllers_[i].acts_on[k]) += held_[i].row(static_cast<Eigen::Index>(k));
      }
    }
    x_ = (step.topLeftCorner(n, n) * x_ + step.topRightCorner(n, inputs) * u).eval();
  }

  LoopPlant plant_;
  std::vector<LoopController> controllers_;
  Matrix x_;
  std::int64_t now_ = 0;
  std::vector<Matrix> law_, held_;
  std::vector<std::int64_t> samples_;
  std::vector<std::deque<Late>> late_;
  std::map<std::int64_t, Matrix> steps_;
};

}  // namespace whirl_twin
