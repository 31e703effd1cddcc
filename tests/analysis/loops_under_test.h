// Loops shared by the tests of sampled loops.
#pragma once

#include <Eigen/Core>
#include <random>

#include "acrobot.h"
#include "analysis/sampled_loop.h"

namespace whirl_twin {

/// u = -(kp y + kd (y_k - y_(k-1)) / period).
inline DiscreteStateSpace sampledPd(double kp, double kd, double period) {
  DiscreteStateSpace law{Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Ones(1, 1),
                         Eigen::MatrixXd::Constant(1, 1, kd / period),
                         Eigen::MatrixXd::Constant(1, 1, -kp - kd / period)};
  return law;
}

/// A mass with negative bearing stiffness, x'' = x + u, with x measured.
inline LoopPlant unstableMass() {
  LoopPlant plant{Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 1),
                  Eigen::MatrixXd::Zero(1, 2)};
  plant.a << 0, 1, 1, 0;
  plant.b << 0, 1;
  plant.c << 1, 0;
  return plant;
}

/// Levitated by u = -(kp x + kd x'), `late` samples late.
inline LoopController levitation(double kp, double kd, double period, double late) {
  LoopController controller;
  controller.name = "levitation";
  controller.rate = 1.0 / period;
  controller.delay = late * period;
  controller.law = sampledPd(kp, kd, period);
  controller.measures = {0};
  controller.acts_on = {0};
  return controller;
}

/// u = -gain x for a plant with all states measured.
inline LoopController stateFeedback(const Eigen::MatrixXd& gain, double rate, double delay) {
  LoopController controller;
  controller.name = "state_feedback";
  controller.rate = rate;
  controller.delay = delay;
  controller.law = {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, gain.cols()),
                    Eigen::MatrixXd(gain.rows(), 0), -gain};
  for (Eigen::Index i = 0; i < gain.cols(); ++i) {
    controller.measures.push_back(i);
  }
  for (Eigen::Index i = 0; i < gain.rows(); ++i) {
    controller.acts_on.push_back(i);
  }
  return controller;
}

inline LoopPlant seenAcrobot() {
  const Acrobot acrobot = uprightAcrobot();
  return {acrobot.a, acrobot.b, Eigen::MatrixXd::Identity(4, 4)};
}

/// A plant of up to three states under one or two controllers of commensurate rates, with delays of
/// any size up to two samples and poles of sensors and actuators; about half of them are stable.
struct RandomLoop {
  LoopPlant plant;
  std::vector<LoopController> controllers;
};

inline RandomLoop randomLoop(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto matrix = [&](Eigen::Index rows, Eigen::Index columns, double size) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return size * normal(random); })
        .eval();
  };
  const Eigen::Index n = 1 + static_cast<Eigen::Index>(random() % 3);
  RandomLoop loop;
  loop.plant = {matrix(n, n, 1.0), matrix(n, 2, 1.0), matrix(2, n, 1.0)};
  loop.plant.a.diagonal().array() -= 1.5 * uniform(random);
  constexpr double kRates[] = {10.0, 20.0, 30.0, 70.0 / 3.0, 5.0};
  const std::size_t count = 1 + random() % 2;
  for (std::size_t i = 0; i < count; ++i) {
    LoopController controller;
    controller.name = "c" + std::to_string(i);
    controller.rate = kRates[random() % 5];
    const double period = 1.0 / controller.rate;
    const int kind = static_cast<int>(random() % 3);
    controller.delay = kind == 0 ? 0.0 : kind == 1 ? period : 2.0 * uniform(random) * period;
    const Eigen::Index states = static_cast<Eigen::Index>(random() % 2);
    controller.law = {matrix(states, states, 0.5), matrix(states, 1, 1.0), matrix(1, states, 1.0),
                      matrix(1, 1, 1.0)};
    controller.measures = {static_cast<Eigen::Index>(random() % 2)};
    controller.acts_on = {static_cast<Eigen::Index>(random() % 2)};
    controller.sensor_bandwidth = random() % 4 == 0 ? 5.0 * uniform(random) : 0.0;
    controller.sensor_delay = random() % 4 == 0 ? uniform(random) * period : 0.0;
    controller.actuator_bandwidth = random() % 4 == 0 ? 5.0 * uniform(random) : 0.0;
    loop.controllers.push_back(controller);
  }
  return loop;
}

}  // namespace whirl_twin
