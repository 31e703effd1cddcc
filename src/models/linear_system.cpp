// A linear system that a scene gives by its matrices and forces, or by assumed modes of them.

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "algebra/dense.h"
#include "analysis/natural_modes.h"
#include "integration/linear_methods.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "models/linear_rotor_setup.h"
#include "models/model_info.h"
#include "models/models.h"
#include "models/settings.h"

namespace whirl_twin {

namespace {

// The matrices that a scene gives for a linear system, checked: what is not as it must be is a
// SetupError that names the matrix and the entry.

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kSymmetric =
    1.0e-12;  // [-], of the largest entry: rounding of who made the matrix
/// [-], of a mass scaled to unit diagonal: below it rounding decides what the accelerations are.
constexpr double kNoMass = 1.0e-13;

/// A matrix of the scene as its symmetric (sign 1) or skew part (sign -1), zero if not given;
/// throws if there is more to it than that part.
MatrixXd matrixOf(const Settings& settings, const std::string& name, Index n, double sign) {
  const auto given = settings.matrices.find(name);
  if (given == settings.matrices.end()) {
    return MatrixXd::Zero(n, n);
  }
  const MatrixXd& a = given->second;
  if (a.rows() != n || a.cols() != n) {
    throw SetupError(
        name, fmt::format("must be {} x {} like mass, found {} x {}", n, n, a.rows(), a.cols()));
  }
  Index i = 0;
  Index j = 0;
  const double error = (a - sign * a.transpose()).cwiseAbs().maxCoeff(&j, &i);
  if (error > kSymmetric * a.cwiseAbs().maxCoeff()) {
    const std::string entry = fmt::format("[{}][{}] = {}", i, j, a(i, j));
    throw SetupError(
        name,
        sign > 0.0
            ? fmt::format("must be symmetric, found {} and [{}][{}] = {}", entry, j, i, a(j, i))
        : i == j ? fmt::format("must be skew-symmetric, with a zero diagonal, found {}", entry)
                 : fmt::format("must be skew-symmetric, [{}][{}] = -[{}][{}], found {} and "
                               "[{}][{}] = {}",
                               i, j, j, i, entry, j, i, a(j, i)));
  }
  return 0.5 * (a + sign * a.transpose());
}

/// The motion of least mass beside what its coordinates have, and that share [-].
struct LeastMass {
  double share;
  Eigen::VectorXd motion;
};

LeastMass leastMass(const MatrixXd& mass) {
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const SymmetricModes<double> solver =
      symmetricModes(scale.asDiagonal() * mass * scale.asDiagonal());
  return {solver.values[0], scale.cwiseProduct(solver.vectors.col(0))};
}

/// A symmetric or skew-symmetric n x n matrix, without the rounding that its maker may have left
/// (1e-12 of its largest entry); zero if the scene does not give it. Throw SetupError.
MatrixXd symmetricMatrix(const Settings& settings, const std::string& name, Index n) {
  return matrixOf(settings, name, n, 1.0);
}

MatrixXd skewMatrix(const Settings& settings, const std::string& name, Index n) {
  return matrixOf(settings, name, n, -1.0);
}

/// Is a symmetric mass matrix positive definite, by more than rounding?
bool hasMassInEveryMotion(const MatrixXd& mass) {
  return mass.diagonal().minCoeff() > 0.0 && leastMass(mass).share > kNoMass;
}

/// Throws SetupError unless a symmetric mass matrix [kg] is positive definite; the names are those
/// of its coordinates.
void requirePositiveDefinite(const MatrixXd& mass, const std::vector<std::string>& names) {
  const std::string expected =
      "must be positive definite: a coordinate or combination without mass has no independent "
      "motion; "
      "found ";
  Index i = 0;
  if (const double least = mass.diagonal().minCoeff(&i); !(least > 0.0)) {
    throw SetupError("mass", fmt::format("{}[{}][{}] = {} kg", expected, i, i, least));
  }
  const LeastMass found = leastMass(mass);
  if (found.share > kNoMass) {
    return;
  }
  std::vector<std::string> moving;
  const double largest = found.motion.cwiseAbs().maxCoeff();
  for (i = 0; i < mass.rows(); ++i) {
    if (std::abs(found.motion[i]) > 0.1 * largest) {
      moving.push_back(names[static_cast<std::size_t>(i)]);
    }
  }
  throw SetupError(
      "mass", fmt::format("{}{} mass for a combination of {}", expected,
                          found.share < -kNoMass ? "negative" : "no", fmt::join(moving, ", ")));
}

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<std::string> numbered(Index count) {
  std::vector<std::string> names;
  for (Index i = 1; i <= count; ++i) {
    names.push_back(fmt::format("q{}", i));
  }
  return names;
}

/// The names of n coordinates: the scene's, or q1 ... qn.
std::vector<std::string> coordinateNames(const Settings& settings, Index n) {
  const auto given = settings.names.find("names");
  if (given == settings.names.end()) {
    return numbered(n);
  }
  const std::vector<std::string>& names = given->second;
  if (static_cast<Index>(names.size()) != n) {
    throw SetupError("names", fmt::format("must be one name per coordinate, {} in total, found {}",
                                          n, names.size()));
  }
  std::set<std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string key = fmt::format("names[{}]", i);
    if (!isLegalName(names[i])) {
      throw SetupError(
          key, fmt::format("must have at most {} letters, digits and _, a letter first, found {}",
                           kMaxNameLength, inQuotes(names[i])));
    }
    // A coordinate x also takes x_rate, the name of its rate.
    if (!taken.insert(names[i]).second || !taken.insert(names[i] + "_rate").second) {
      throw SetupError(
          key,
          fmt::format("must differ from the names of other coordinates and their rates, found '{}'",
                      names[i]));
    }
  }
  return names;
}

std::vector<HarmonicForce> forcesOf(const Settings& settings,
                                    const std::vector<std::string>& names) {
  std::vector<HarmonicForce> forces;
  const auto table = settings.tables.find("force");
  if (table == settings.tables.end()) {
    return forces;
  }
  for (std::size_t row = 0; row < table->second.size(); ++row) {
    const TableRow& values = table->second[row];
    const std::string& name = values.words.at("coordinate");
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end()) {
      const std::string near = nearestName(name, names);
      throw SetupError(
          fmt::format("force[{}].coordinate", row),
          fmt::format("must be a coordinate of the system, found {}{}", inQuotes(name),
                      near.empty() ? fmt::format("; there are: {}", fmt::join(names, ", "))
                                   : fmt::format("; did you mean '{}'?", near)));
    }
    HarmonicForce force;
    force.amplitude = Eigen::VectorXd::Zero(static_cast<Index>(names.size()));
    force.amplitude[place - names.begin()] = values.numbers.at("amplitude");
    force.frequency = values.numbers.at("frequency");
    force.phase = values.numbers.at("phase");
    forces.push_back(force);
  }
  return forces;
}

/// The model in the amplitudes of the scene's shapes.
LinearModel inAssumedModes(const LinearModel& full, const MatrixXd& shapes) {
  const Index n = full.mass.rows();
  if (shapes.rows() != n || shapes.cols() > n) {
    throw SetupError("assumed_modes", fmt::format("must have {} rows, one per coordinate, and at "
                                                  "most {} columns, one per shape, found {} x {}",
                                                  n, n, shapes.rows(), shapes.cols()));
  }
  const SetupError dependent("assumed_modes",
                             fmt::format("must be linearly independent shapes, found {} of which "
                                         "one is zero or a combination of the others",
                                         shapes.cols()));
  LinearModel model;
  try {
    const Linearization r = reduced(
        {full.mass, full.damping, full.gyroscopic, full.stiffness, full.circulatory}, shapes);
    const auto part = [](const MatrixXd& a, double sign) {
      return MatrixXd(0.5 * (a + sign * a.transpose()));
    };
    model.mass = part(r.mass, 1.0);
    model.damping = part(r.damping, 1.0);
    model.gyroscopic = part(r.gyroscopic, -1.0);
    model.stiffness = part(r.stiffness, 1.0);
    model.circulatory = part(r.circulatory, -1.0);
  } catch (const InputError&) {
    throw SetupError(dependent);
  }
  if (!hasMassInEveryMotion(model.mass)) {
    throw SetupError(dependent);
  }
  for (HarmonicForce force : full.forces) {
    force.amplitude = (shapes.transpose() * force.amplitude).eval();
    model.forces.push_back(force);
  }
  for (InputInfo input : full.inputs) {
    input.direction = (shapes.transpose() * input.direction).eval();
    model.inputs.push_back(input);
  }
  return model;
}

void requireFiniteAccelerations(const LinearModel& model) {
  const Cholesky mass(model.mass);
  bool finite = mass.solve(model.stiffness + model.circulatory).allFinite() &&
                mass.solve(model.damping + model.gyroscopic).allFinite();
  for (const HarmonicForce& force : model.forces) {
    finite = finite && mass.solve(force.amplitude).allFinite();
  }
  if (!finite) {
    throw SetupError("mass",
                     "must give accelerations within the range of doubles; those of this "
                     "stiffness, damping or force exceed it");
  }
}

ModelSetup setUpLinearSystem(const Settings& settings) {
  const auto mass = settings.matrices.find("mass");
  if (mass == settings.matrices.end()) {
    throw SetupError("mass", "missing");
  }
  const Index n = mass->second.rows();
  if (mass->second.cols() != n) {
    throw SetupError("mass", fmt::format("must be square, found {} x {}", n, mass->second.cols()));
  }
  LinearModel model;
  std::vector<std::string> names = coordinateNames(settings, n);
  model.mass = symmetricMatrix(settings, "mass", n);
  requirePositiveDefinite(model.mass, names);
  model.stiffness = symmetricMatrix(settings, "stiffness", n);
  model.damping = symmetricMatrix(settings, "damping", n);
  model.gyroscopic = skewMatrix(settings, "gyroscopic", n);
  model.circulatory = skewMatrix(settings, "circulatory", n);
  model.forces = forcesOf(settings, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    model.inputs.push_back({"force_" + names[i], "N",
                            Eigen::VectorXd::Unit(n, static_cast<Index>(i)), "along " + names[i]});
  }
  const auto shapes = settings.matrices.find("assumed_modes");
  if (shapes != settings.matrices.end()) {
    model = inAssumedModes(model, shapes->second);
    names = numbered(model.mass.rows());
  }
  model.model = "linear_system";
  for (const std::string& name : names) {
    model.coordinates.push_back({name, "m"});
  }
  requireFiniteAccelerations(model);
  return linearSetup(std::move(model));
}

}  // namespace

ModelInfo linearSystemInfo() {
  const auto matrix = [](const char* name, const char* unit, const char* meaning) {
    return SettingInfo{name, SettingKind::kMatrix, unit, meaning};
  };
  ModelInfo info;
  info.name = "linear_system";
  info.summary = "any linear system, by its matrices";
  info.coordinates_meaning = "q1, q2 ... or the names given, in the units of the matrices";
  info.settings = {
      matrix("mass", "kg", "symmetric, positive definite; a row per coordinate"),
      matrix("stiffness", "N/m", "symmetric; rigid-body modes are allowed"),
      matrix("damping", "N s/m", "symmetric; default none"),
      matrix("gyroscopic", "N s/m", "skew-symmetric; default none"),
      matrix("circulatory", "N/m", "skew-symmetric; default none"),
      {"names", SettingKind::kNames, "", "of the coordinates; default q1, q2 ..."},
      {"force", SettingKind::kTable, "", "amplitude cos(frequency t + phase) on a coordinate"},
      matrix("assumed_modes", "of a shape",
             "a column per shape: the system is reduced to their amplitudes q1, q2 ..."),
  };
  info.settings[0].required = true;
  info.settings[1].required = true;
  info.settings[6].word_columns = {"coordinate"};
  info.settings[6].columns = {{"amplitude", "N", Range::kAny, kRequired},
                              {"frequency", "rad/s", Range::kNotNegative, 0.0},
                              {"phase", "rad", Range::kAny, 0.0}};
  info.variants = {{"", {}, true, false, linearMethodNames()}};
  info.variants[0].inputs = {{"force_COORDINATE", "N", {}, "along a coordinate of the matrices"}};
  info.setUp = [](const ParameterValues&, const Settings& settings, const ModelContext&) {
    return setUpLinearSystem(settings);
  };
  return info;
}

}  // namespace whirl_twin
