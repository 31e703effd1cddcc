// What the pendulum models answer to the lecture notes' reference numbers.
#include "note_system.h"

namespace whirl_twin {

namespace {

using Vector = Eigen::VectorXd;

/// Tensions of both rods, by Newton's law on each bob at the model's accelerations.
Eigen::Vector2d rodTensions(const Dynamics& pendulum, const NoteCase& c) {
  const double theta[2] = {c.at("theta1"), c.at("theta2")};
  const double rate[2] = {c.at("theta1_d"), c.at("theta2_d")};
  const Vector a =
      pendulum.acceleration(vector({theta[0], theta[1]}), vector({rate[0], rate[1]}), {});
  Eigen::Vector2d bob_acceleration = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_pivot[2];
  Eigen::Vector2d needed[2];  // force on each bob besides its weight
  for (int i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i + 1);
    const Eigen::Vector2d along(std::cos(theta[i]), std::sin(theta[i]));
    to_pivot[i] = Eigen::Vector2d(-std::sin(theta[i]), std::cos(theta[i]));
    bob_acceleration += c.at("l" + number) * (a[i] * along + rate[i] * rate[i] * to_pivot[i]);
    needed[i] = c.at("m" + number) * (bob_acceleration + Eigen::Vector2d(0.0, c.at("g")));
  }
  const double lower = needed[1].dot(to_pivot[1]);
  const double upper = (needed[0] + lower * to_pivot[1]).dot(to_pivot[0]);
  return {upper, lower};
}

/// The notes' matrices, mode ratios and characteristic polynomial: equal masses and lengths of 1.
std::vector<double> equalPendulumAnswers(const NoteCase& c, const Linearization& l) {
  const Eigen::MatrixXd stiffness = l.stiffness + l.circulatory;
  for (const char kind : {'M', 'K'}) {
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        if (c.id == "double_pendulum.f1." + std::string(1, kind) + std::to_string(i + 1) +
                        std::to_string(j + 1)) {
          return {kind == 'M' ? l.mass(i, j) : stiffness(i, j)};
        }
      }
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(l.stiffness, l.mass);
  const auto ratio = [&](int mode) {
    return modes.eigenvectors()(1, mode) / modes.eigenvectors()(0, mode);
  };
  const Eigen::Matrix2d dynamic = l.mass.inverse() * stiffness;
  // The notes' Newton form is the Lagrange form less its second row in the first.
  Eigen::Matrix2d rows;
  rows << 1.0, -1.0, 0.0, 1.0;
  const Eigen::Matrix2d newton = (rows * l.mass).inverse() * (rows * stiffness);
  const std::map<std::string, double> answers{
      {"lam1", modes.eigenvalues()[0]},
      {"lam2", modes.eigenvalues()[1]},
      {"ratio1", ratio(0)},
      {"ratio2", ratio(1)},
      {"rel.ratio1", ratio(0) - 1.0},  // theta3 = theta2 - theta1
      {"rel.ratio2", ratio(1) - 1.0},
      {"char1", -dynamic.trace()},
      {"char0", dynamic.determinant()},
      {"newton.lam1", Eigen::EigenSolver<Eigen::Matrix2d>(newton).eigenvalues().real().minCoeff()},
  };
  const auto found = answers.find(c.id.substr(std::string("double_pendulum.").size()));
  return found == answers.end() ? std::vector<double>{} : std::vector<double>{found->second};
}

}  // namespace

std::vector<double> spinningPendulumAnswers(const NoteCase& c) {
  RunningSystem::Setup setup;
  setup.model = "spinning_pendulum";
  setup.parameters = {{"mass", c.at("m", 1.0)}, {"length", c.at("l")}, {"damping", c.at("c", 0.0)}};
  setup.gravity = c.at("g");
  setup.speed = c.at("w");
  setup.q = {c.at("ic_theta", 0.0)};
  setup.v = {c.at("ic_theta_d", 0.0)};
  const ModelInfo& model = *findModel(setup.model);
  const auto pendulum = model.dynamics(completed(model, setup.parameters), setup.gravity);
  const Moment<double> at{0.0, 0.0, setup.speed, 0.0};
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
      (pendulum->holdingForce(vector({middle}), at)[0] > 0.0 ? low : high) = middle;
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

std::vector<double> doublePendulumAnswers(const NoteCase& c) {
  RunningSystem::Setup setup;
  setup.model = "double_pendulum";
  setup.parameters = {{"mass1", c.at("m1", 1.0)},
                      {"mass2", c.at("m2", 1.0)},
                      {"length1", c.at("l1", 1.0)},
                      {"length2", c.at("l2", 1.0)}};
  setup.gravity = c.at("g");
  setup.q = {c.at("ic_theta1", 0.0), c.at("ic_theta2", 0.0)};
  setup.v = {c.at("ic_theta1_d", 0.0), c.at("ic_theta2_d", 0.0)};
  const ModelInfo& model = *findModel(setup.model);
  const auto pendulum = model.dynamics(completed(model, setup.parameters), setup.gravity);
  const auto linearAt = [&](double theta1, double theta2) {
    return pendulum->linearization(vector({theta1, theta2}), vector({0.0, 0.0}), vector({0.0, 0.0}),
                                   {});
  };
  if (c.startsWith("traj.")) {
    return {endOfMotion(setup, c, {"theta1", "theta2", "theta1_d", "theta2_d"})};
  }
  if (c.startsWith("acc.")) {
    const Vector a = pendulum->acceleration(vector({c.at("at_theta1"), c.at("at_theta2")}),
                                            vector({c.at("at_theta1_d"), c.at("at_theta2_d")}), {});
    return {a[c.contains(".theta1") ? 0 : 1]};
  }
  if (c.startsWith("inv.h0.")) {
    return {
        pendulum->energies(vector({setup.q[0], setup.q[1]}), vector({setup.v[0], setup.v[1]}), {})
            .jacobi};
  }
  if (c.startsWith("reaction.dp.")) {
    return {rodTensions(*pendulum, c)[c.contains(".T1.") ? 0 : 1]};
  }
  if (c.startsWith("double_pendulum.eq")) {
    const double theta1 = c.contains(".eqpi") ? M_PI : 0.0;
    const double theta2 = c.contains(".eq0pi.") || c.contains(".eqpipi.") ? M_PI : 0.0;
    return {squaredFrequencies(linearAt(theta1, theta2))[c.contains(".p2_1") ? 0 : 1]};
  }
  if (c.startsWith("double_pendulum.p2_")) {
    return {squaredFrequencies(linearAt(0.0, 0.0))[c.contains(".p2_1.") ? 0 : 1]};
  }
  return equalPendulumAnswers(c, linearAt(0.0, 0.0));
}

}  // namespace whirl_twin
