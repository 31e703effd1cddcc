// The methods of src/analysis against the lecture notes' reference numbers: the lever with three
// masses, the beam without supports ("submarine"), the cantilever in assumed modes.
#include <Eigen/LU>

#include "algebra/dense.h"
#include "analysis/approximate_frequencies.h"
#include "analysis/cantilever_modes.h"
#include "analysis/frequency_response.h"
#include "analysis/natural_modes.h"
#include "note_system.h"

namespace whirl_twin {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// "m12" is row 1, column 2.
double entry(const MatrixXd& matrix, const std::string& name) {
  return matrix(name.at(1) - '1', name.at(2) - '1');
}

/// The number at the end of an id: "iter3.rq2".
int lastDigit(const NoteCase& c) {
  return c.id.back() - '0';
}

/// det([k] - p^2 [m]) = 0 of two assumed modes: fourth p^4 - second p^2 + constant = 0.
struct Quadratic {
  double fourth, second, constant;
  explicit Quadratic(const RitzModes& ritz)
      : fourth(ritz.mass.determinant()),
        second(ritz.mass(0, 0) * ritz.stiffness(1, 1) + ritz.mass(1, 1) * ritz.stiffness(0, 0) -
               2.0 * ritz.mass(0, 1) * ritz.stiffness(0, 1)),
        constant(ritz.stiffness.determinant()) {}
};

std::vector<double> assumedModesOfTheLever(const NoteCase& c, const MatrixXd& mass,
                                           const MatrixXd& stiffness) {
  const std::string asked = c.id.substr(c.id.rfind('.') + 1);
  if (c.startsWith("amm3.static.")) {
    const VectorXd deflection =
        staticDeflection(stiffness, weight(mass, VectorXd::Ones(3), 1.0));  // in m g / k
    const RitzModes ritz = ritzModes(mass, stiffness, deflection);
    if (asked == "F") {
      return {c.at("k") * deflection[1] / 3.0};  // of the spring to the ground
    }
    if (asked.front() == 'd') {
      return {deflection[lastDigit(c) - 1]};
    }
    if (asked == "p1") {
      return {ritz.assumed.frequencies[0], rayleighFrequency(mass, stiffness, deflection)};
    }
    return {entry(asked.front() == 'm' ? ritz.mass : ritz.stiffness, asked)};
  }
  MatrixXd shapes(3, 2);
  shapes << 1.0, 1.0, -1.0, -2.0, -1.5, -3.0;
  if (c.id == "amm3.one_mode.p1") {
    return {ritzModes(mass, stiffness, shapes.leftCols(1)).assumed.frequencies[0],
            rayleighFrequency(mass, stiffness, shapes.col(0))};
  }
  const RitzModes ritz = ritzModes(mass, stiffness, shapes);
  const VectorXd& p = ritz.assumed.frequencies;
  const Quadratic q(ritz);
  const std::map<std::string, double> answers{
      {"coef4", q.fourth},
      {"coef2", q.second},
      {"4ac", 4.0 * q.fourth * q.constant},
      {"sqrt", std::sqrt(q.second * q.second - 4.0 * q.fourth * q.constant)},
      {"p1sq", p[0] * p[0]},
      {"p1", p[0]},
      {"p2", p[1]}};
  if (answers.count(asked) != 0) {
    return {answers.at(asked)};
  }
  return {entry(asked.front() == 'm' ? ritz.mass : ritz.stiffness, asked)};
}

/// Masses bent by V = kb / 2 sum of (y_(i-1) - 2 y_i + y_(i+1))^2.
NaturalModes submarineModes(const VectorXd& masses, double bending) {
  const Eigen::Index n = masses.size();
  MatrixXd bend = MatrixXd::Zero(n - 2, n);
  for (Eigen::Index i = 0; i < n - 2; ++i) {
    bend.block(i, i, 1, 3) << 1.0, -2.0, 1.0;
  }
  return naturalModes(masses.asDiagonal(), bending * bend.transpose() * bend);
}

/// (beta L) of the first elastic mode of a uniform free beam, by Legendre polynomials on [-1, 1]
/// as assumed modes, the first two of which are its rigid-body modes.
double freeBeamRoot() {
  const int count = 24;
  MatrixXd mass = MatrixXd::Zero(count, count);
  MatrixXd derivative = MatrixXd::Zero(count, count);  // P_n' = sum of (2 k + 1) P_k
  for (int n = 0; n < count; ++n) {
    mass(n, n) = 2.0 / (2 * n + 1);
    for (int k = n - 1; k >= 0; k -= 2) {
      derivative(k, n) = 2 * k + 1;
    }
  }
  const MatrixXd curvature = derivative * derivative;
  const NaturalModes modes = naturalModes(mass, curvature.transpose() * mass * curvature);
  return 2.0 * std::sqrt(modes.frequencies[2]);
}

/// The matrices of the notes' shapes x^2, x^3, ...
struct NoteShapes {
  MatrixXd mass, stiffness;
  explicit NoteShapes(const CantileverModes& beam) {
    const int n = beam.count();
    MatrixXd to_notes(n, n);
    for (int i = 0; i < n; ++i) {
      to_notes.col(i) = beam.monomials(VectorXd::Unit(n, i));
    }
    for (int j = 0; j < n; ++j) {
      to_notes.row(j) /= std::pow(beam.length, j + 2);
    }
    const MatrixXd from_notes = to_notes.inverse();
    mass = from_notes.transpose() * beam.mass * from_notes;
    stiffness = from_notes.transpose() * beam.stiffness * from_notes;
  }
};

/// Position of the node of mode 2.
double nodeOfSecondMode(const CantileverModes& beam) {
  const VectorXd q = naturalModes(beam.mass, beam.stiffness).shapes.col(1);
  return zeroBetween(0.5, 0.99, [&](double x) { return q.dot(beam.shapes(x)); });
}

/// Tip deflection under the generalized forces of one frequency, without damping.
double tipResponse(const CantileverModes& beam, const VectorXd& force, double frequency) {
  const MatrixXd zero = MatrixXd::Zero(beam.count(), beam.count());
  const Linearization system{beam.mass, zero, zero, beam.stiffness, zero};
  return beam.tip.dot(steadyResponse(system, force, frequency).real());
}

}  // namespace

std::vector<double> leverAnswers(const NoteCase& c) {
  const double k = c.at("k");
  MatrixXd stiffness(3, 3);
  stiffness << 1.0, 1.0 / 3.0, 0.0, 1.0 / 3.0, 11.0 / 9.0, -1.0, 0.0, -1.0, 1.0;
  stiffness *= k;
  const double m = c.at("m", 1.0);
  const MatrixXd mass = Eigen::Vector3d(c.at("m1", m), c.at("m2", m), c.at("m3", m)).asDiagonal();
  if (c.startsWith("amm3.")) {
    return assumedModesOfTheLever(c, mass, stiffness);
  }
  if (c.startsWith("lever3.a")) {
    return {entry(influenceCoefficients(stiffness), c.id.substr(c.id.find('.') + 1))};
  }
  if (c.id == "lever3.detK") {
    return {stiffness.determinant()};
  }
  if (c.id == "flex.V") {
    const Eigen::Vector3d force(c.at("F1"), c.at("F2"), c.at("F3"));
    const VectorXd deflection = staticDeflection(stiffness, force);
    return {0.5 * force.dot(influenceCoefficients(stiffness) * force),
            0.5 * deflection.dot(stiffness * deflection)};
  }
  if (c.startsWith("dunkerley3.")) {
    const DunkerleyBound bound = dunkerleyBound(mass, stiffness);
    return {c.id == "dunkerley3.tr" ? bound.terms.sum() : bound.frequency};
  }
  if (c.startsWith("iter3.rq")) {
    const auto modes = matrixIteration(mass, stiffness, 1, Eigen::Vector3d(1.0, -1.0, -1.0));
    return {modes.front().history.at(static_cast<std::size_t>(lastDigit(c) - 1))};
  }
  const NaturalModes modes = naturalModes(mass, stiffness);
  if (c.startsWith("lever3.mode1.")) {
    return {modes.shapes(lastDigit(c) - 1, 0) / modes.shapes(0, 0)};
  }
  if (c.startsWith("lever3.p")) {
    const int mode = c.id.at(8) - '1';
    const auto iterated = matrixIteration(mass, stiffness, 3, VectorXd::Ones(3));
    return {modes.frequencies[mode], iterated.at(static_cast<std::size_t>(mode)).frequency};
  }
  return {};
}

std::vector<double> submarineAnswers(const NoteCase& c) {
  if (c.id == "freefree.betaL1") {
    return {freeBeamRoot()};
  }
  const int n = static_cast<int>(c.at("n", 3.0));
  VectorXd masses = VectorXd::Constant(n, c.at("m", 1.0));
  if (n == 3) {
    masses = Eigen::Vector3d(c.at("m1"), c.at("m2"), c.at("m3"));
  }
  const NaturalModes modes = submarineModes(masses, c.at("kb"));
  if (c.contains(".nzero.")) {
    return {static_cast<double>(modes.rigid_body_modes)};
  }
  return {modes.frequencies[2]};
}

std::vector<double> cantileverAnswers(const NoteCase& c) {
  // The exact beam is the limit of many shapes.
  const int count = c.contains(".exact") ? 20 : static_cast<int>(c.at("N", 2.0));
  const CantileverModes beam =
      cantileverModes(c.at("m", 1.0), c.at("L", 1.0), c.at("EI", 1.0), count);
  const NaturalModes modes = naturalModes(beam.mass, beam.stiffness);
  const std::string asked = c.id.substr(c.id.find('.') + 1);
  if (c.contains(".node2")) {
    return {nodeOfSecondMode(beam)};
  }
  if (asked.size() == 3 && (asked.front() == 'm' || asked.front() == 'k')) {
    const NoteShapes notes(beam);
    return {entry(asked.front() == 'm' ? notes.mass : notes.stiffness, asked)};
  }
  if (asked == "tip_static") {
    return {beam.tip.dot(staticDeflection(beam.stiffness, c.at("F") * beam.tip))};
  }
  if (asked == "tip_frf") {
    return {tipResponse(beam, c.at("F") * beam.tip, c.at("Om"))};
  }
  if (asked == "base.tip") {
    const double acceleration = -c.at("Om") * c.at("Om") * c.at("Y");
    return {tipResponse(beam, -c.at("m") * acceleration * beam.integral, c.at("Om"))};
  }
  if (c.contains(".ratio")) {
    const VectorXd shape = beam.monomials(modes.shapes.col(lastDigit(c) - 1));
    return {shape[1] / shape[0]};
  }
  if (c.contains(".lam")) {
    return {std::pow(modes.frequencies[lastDigit(c) - 1], 2)};
  }
  if (asked.front() == 'p' || c.contains(".exact.p") || c.contains(".ritz")) {
    return {modes.frequencies[lastDigit(c) - 1]};
  }
  // lambda^2 - B lambda + C = 0 for two modes; their mass matrix is diagonal.
  const VectorXd per_mass = beam.mass.diagonal().cwiseInverse();
  const MatrixXd system = per_mass.asDiagonal() * beam.stiffness;
  const double sum = system.trace();
  const double product = system.determinant();
  const double discriminant = 0.25 * sum * sum - product;
  const std::map<std::string, double> answers{{"charB", sum},
                                              {"charC", product},
                                              {"disc", discriminant},
                                              {"sqrt", std::sqrt(discriminant)}};
  return answers.count(asked) != 0 ? std::vector<double>{answers.at(asked)} : std::vector<double>{};
}

}  // namespace whirl_twin
