// The spinning pendulum against the lecture notes' reference numbers.
#include "note_system.h"

namespace whirl_twin {

std::vector<double> spinningPendulumAnswers(const NoteCase& c) {
  RunningSystem::Setup setup;
  setup.model = "spinning_pendulum";
  setup.parameters = {{"mass", c.at("m", 1.0)}, {"length", c.at("l")}, {"damping", c.at("c", 0.0)}};
  setup.gravity = c.at("g");
  setup.speed = c.at("w");
  setup.q = {c.at("ic_theta", 0.0)};
  setup.v = {c.at("ic_theta_d", 0.0)};
  const ModelInfo& model = *findModel(setup.model);
  const auto pendulum = model.setUp(completed(model, setup.parameters), {}, setup.gravity).dynamics;
  const EvaluationPoint<double> at{0.0, 0.0, setup.speed, 0.0};
  const auto squaredFrequencyAt = [&](double theta) {
    return squaredFrequencies(
        pendulum->linearization(vector({theta}), vector({0.0}), vector({0.0}), at))[0];
  };
  // The cone angle: where the force that holds the pendulum passes through zero.
  const auto coneAngle = [&] {
    double low = 0.05;
    double high = 3.0;
    while (0.5 * (low + high) > low && 0.5 * (low + high) < high) {
      const double middle = 0.5 * (low + high);
      const double force = pendulum->residualForce(vector({middle}), vector({0.0}), at)[0];
      (force > 0.0 ? low : high) = middle;
    }
    return low;
  };
  if (c.startsWith("traj.")) {
    return {endOfMotion(setup, c, {"theta", "theta_d"})};
  }
  if (c.startsWith("acc.")) {
    return {
        pendulum->acceleration(vector({c.at("at_theta")}), vector({c.at("at_theta_d")}), at)[0]};
  }
  if (c.startsWith("inv.h0.")) {
    return {pendulum->energies(vector({setup.q[0]}), vector({setup.v[0]}), at).jacobi};
  }
  if (c.startsWith("spinning.f.")) {
    return {std::sqrt(squaredFrequencyAt(0.0)) / (2.0 * M_PI)};
  }
  if (c.id == "spinning.rpm0") {
    return {std::sqrt(squaredFrequencyAt(0.0)) * 60.0 / (2.0 * M_PI)};
  }
  if (c.startsWith("spinning.theta0.")) {
    return {coneAngle()};
  }
  if (c.startsWith("spinning.p.")) {
    return {std::sqrt(squaredFrequencyAt(coneAngle()))};
  }
  if (c.startsWith("spinning.p2.")) {
    return {squaredFrequencyAt(c.contains(".top.") ? M_PI : 0.0)};
  }
  return {};
}

}  // namespace whirl_twin
