// The double pendulum against the lecture notes' reference numbers, in absolute and in relative
// angles.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "algebra/dense.h"
#include "note_system.h"

namespace whirl_twin {

namespace {

NoteSystem doublePendulum(const NoteCase& c, const std::string& coordinates) {
  return {c,
          "double_pendulum",
          {{"mass1", c.at("m1", 1.0)},
           {"mass2", c.at("m2", 1.0)},
           {"length1", c.at("l1", 1.0)},
           {"length2", c.at("l2", 1.0)}},
          choice("coordinates", coordinates)};
}

/// An entry of M or K, selected by "M12" at the end of the case's name.
std::vector<double> entry(const NoteCase& c, const Linearization& l) {
  const std::string asked = c.id.substr(c.id.size() - 3);
  const Eigen::MatrixXd matrix = asked[0] == 'M' ? l.mass : l.stiffness + l.circulatory;
  return {matrix(asked[1] - '1', asked[2] - '1')};
}

/// Second coordinate over the first in a mode of small motion.
double modeRatio(const Linearization& l, int mode) {
  const SymmetricModes<double> modes = generalizedModes(l.stiffness, l.mass);
  return modes.vectors(1, mode) / modes.vectors(0, mode);
}

/// The notes' mode ratios and characteristic polynomial: equal masses and lengths of 1.
std::vector<double> equalPendulumAnswers(const NoteCase& c, const Linearization& l) {
  const Linearization relative = doublePendulum(c, "relative").linearAt({0.0, 0.0});
  const Eigen::Matrix2d dynamic = l.mass.inverse() * l.stiffness;
  // The notes' Newton form is the Lagrange form less its second row in the first.
  Eigen::Matrix2d rows;
  rows << 1.0, -1.0, 0.0, 1.0;
  const Eigen::Matrix2d newton = (rows * l.mass).inverse() * (rows * l.stiffness);
  const Eigen::VectorXd squared = squaredFrequencies(l);
  const std::map<std::string, std::vector<double>> answers{
      {"lam1", {squared[0], squaredFrequencies(relative)[0]}},
      {"lam2", {squared[1], squaredFrequencies(relative)[1]}},
      {"ratio1", {modeRatio(l, 0)}},
      {"ratio2", {modeRatio(l, 1)}},
      {"rel.ratio1", {modeRatio(relative, 0), modeRatio(l, 0) - 1.0}},  // theta3 = theta2 - theta1
      {"rel.ratio2", {modeRatio(relative, 1), modeRatio(l, 1) - 1.0}},
      {"char1", {-dynamic.trace()}},
      {"char0", {dynamic.determinant()}},
      {"newton.lam1",
       {Eigen::EigenSolver<Eigen::Matrix2d>(newton).eigenvalues().real().minCoeff()}},
  };
  const auto found = answers.find(c.id.substr(std::string("double_pendulum.").size()));
  return found == answers.end() ? std::vector<double>{} : found->second;
}

}  // namespace

std::vector<double> doublePendulumAnswers(const NoteCase& c) {
  const NoteSystem system = doublePendulum(c, "absolute");
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  if (c.startsWith("reaction.dp.")) {
    const std::string rod = c.contains(".T1.") ? "rod_tension_1" : "rod_tension_2";
    const double theta3 = c.at("theta2") - c.at("theta1");
    const double theta3_rate = c.at("theta2_d") - c.at("theta1_d");
    return {system.reaction(rod, {c.at("theta1"), c.at("theta2")},
                            {c.at("theta1_d"), c.at("theta2_d")}),
            doublePendulum(c, "relative")
                .reaction(rod, {c.at("theta1"), theta3}, {c.at("theta1_d"), theta3_rate})};
  }
  if (c.startsWith("double_pendulum.f1.")) {
    return entry(c, system.linearAt({0.0, 0.0}));
  }
  if (c.startsWith("double_pendulum.eq")) {
    const double theta1 = c.contains(".eqpi") ? M_PI : 0.0;
    const double theta2 = c.contains(".eq0pi.") || c.contains(".eqpipi.") ? M_PI : 0.0;
    return {squaredFrequencies(system.linearAt({theta1, theta2}))[c.contains(".p2_1") ? 0 : 1]};
  }
  if (c.startsWith("double_pendulum.p2_")) {
    return {squaredFrequencies(system.linearAt({0.0, 0.0}))[c.contains(".p2_1.") ? 0 : 1]};
  }
  return equalPendulumAnswers(c, system.linearAt({0.0, 0.0}));
}

std::vector<double> relativeDoublePendulumAnswers(const NoteCase& c) {
  const NoteSystem system = doublePendulum(c, "relative");
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  if (c.startsWith("double_pendulum.f2.")) {
    return entry(c, system.linearAt({0.0, 0.0}));
  }
  return {};
}

}  // namespace whirl_twin
