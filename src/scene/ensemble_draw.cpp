#include "scene/ensemble_draw.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "algebra/dense.h"
#include "messages/names.h"
#include "scene/node_reader.h"
#include "scene/parameter_paths.h"

namespace whirl_twin {

namespace {

constexpr double kCorrelationRounding = 1.0e-6;  // for a matrix written with some ten digits

/// Index of a number among the spreads.
std::optional<Eigen::Index> placeOf(const YAML::Node& path, const std::string& key,
                                    const EnsembleSpec& ensemble, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const Spread& spread : ensemble.spread) {
    known.push_back(spread.path);
  }
  const std::string name = path.IsScalar() ? path.Scalar() : "";
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    const std::string near = nearestName(name, known);
    diagnostics.add(key,
                    fmt::format("must be parameters with a spread, found {}{}", shown(path),
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }
  if (!ensemble.spread[static_cast<std::size_t>(found - known.begin())].normal) {
    diagnostics.add(
        key,
        fmt::format("correlations need normal distributions (standard_deviation); {} is uniform",
                    whirl_twin::inQuotes(name)));
    return std::nullopt;
  }
  return found - known.begin();
}

void readPair(const YAML::Node& entry, const std::string& key, const EnsembleSpec& ensemble,
              Eigen::MatrixXd& matrix, Diagnostics& diagnostics) {
  constexpr double kNone = 2.0;
  const double value = entry.IsSequence() && entry.size() == 3 && entry[2].IsScalar()
                           ? parseNumber(entry[2].Scalar()).value_or(kNone)
                           : kNone;
  if (std::fabs(value) > 1.0) {
    diagnostics.add(key, "must be [parameter, other parameter, correlation from -1 to 1]");
    return;
  }
  const auto a = placeOf(entry[0], key, ensemble, diagnostics);
  const auto b = placeOf(entry[1], key, ensemble, diagnostics);
  if (!a || !b) {
    return;
  }
  if (*a == *b || !std::isnan(matrix(*a, *b))) {
    diagnostics.add(
        key,
        fmt::format("the correlation of {} and {} {}", whirl_twin::inQuotes(entry[0].Scalar()),
                    whirl_twin::inQuotes(entry[1].Scalar()), *a == *b ? "is 1" : "is given twice"));
    return;
  }
  matrix(*a, *b) = matrix(*b, *a) = value;
}

/// Cholesky factor of a matrix that may be singular.
Eigen::MatrixXd factorOf(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double left = matrix(j, j) - factor.row(j).head(j).squaredNorm();
    factor(j, j) = std::sqrt(std::fmax(left, 0.0));
    for (Eigen::Index i = j + 1; i < n && factor(j, j) > 0.0; ++i) {
      factor(i, j) =
          (matrix(i, j) - factor.row(i).head(j).dot(factor.row(j).head(j))) / factor(j, j);
    }
  }
  return factor;
}

}  // namespace

void readCorrelations(const YAML::Node& node, const std::string& key, EnsembleSpec& ensemble,
                      Diagnostics& diagnostics) {
  if (!node.IsSequence()) {
    diagnostics.add(
        key, fmt::format("must be a list of [parameter, other parameter, correlation], found {}",
                         shown(node)));
    return;
  }
  const auto n = static_cast<Eigen::Index>(ensemble.spread.size());
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  const std::size_t before = diagnostics.all().size();
  for (std::size_t i = 0; i < node.size(); ++i) {
    readPair(node[i], fmt::format("{}[{}]", key, i), ensemble, matrix, diagnostics);
  }
  if (diagnostics.all().size() > before) {
    return;
  }
  matrix = matrix.array().isNaN().select(Eigen::MatrixXd::Identity(n, n), matrix);
  const double lowest = symmetricEigenvalues(matrix).minCoeff();
  if (lowest < -kCorrelationRounding) {
    diagnostics.add(
        key,
        fmt::format(
            "the correlation matrix must be positive semidefinite, found an eigenvalue of {:.3g}",
            lowest));
    return;
  }
  ensemble.factor = factorOf(matrix);
}

std::vector<double> correlated(const EnsembleSpec& ensemble,
                               const std::vector<double>& independent) {
  if (ensemble.factor.size() == 0) {
    return independent;
  }
  Eigen::VectorXd parts(ensemble.factor.rows());
  for (Eigen::Index i = 0; i < parts.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    parts[i] = independent[place] / ensemble.spread[place].width;
  }
  parts = ensemble.factor.triangularView<Eigen::Lower>() * parts;
  std::vector<double> deviations;
  for (const Spread& spread : ensemble.spread) {
    deviations.push_back(parts[static_cast<Eigen::Index>(deviations.size())] * spread.width);
  }
  return deviations;
}

std::vector<double> independent(const EnsembleSpec& ensemble,
                                const std::vector<double>& correlated) {
  if (ensemble.factor.size() == 0) {
    return correlated;
  }
  const Eigen::MatrixXd& factor = ensemble.factor;
  Eigen::VectorXd parts = Eigen::VectorXd::Zero(factor.rows());
  std::vector<double> deviations;
  for (Eigen::Index i = 0; i < parts.size(); ++i) {
    const Spread& spread = ensemble.spread[static_cast<std::size_t>(i)];
    const double left = correlated[static_cast<std::size_t>(i)] / spread.width -
                        factor.row(i).head(i).dot(parts.head(i));
    parts[i] = factor(i, i) > kCorrelationRounding ? left / factor(i, i) : 0.0;
    deviations.push_back(parts[i] * spread.width);
  }
  return deviations;
}

namespace {

constexpr int kMaxDraws = 1000;

// std::mt19937_64 is specified by the standard, its distributions are not: Boost's are used.
double deviation(const Spread& spread, std::mt19937_64& random) {
  if (spread.normal) {
    return boost::random::normal_distribution<double>(0.0, spread.width)(random);
  }
  return boost::random::uniform_real_distribution<double>(-spread.width, spread.width)(random);
}

/// Sets one number of a sample; false if it is out of range.
bool put(const Spread& spread, double value, const ModelInfo& model, SystemSpec& member) {
  if (spread.kind != Spread::Kind::kParameter) {
    (spread.kind == Spread::Kind::kRate ? member.v : member.q)[spread.coordinate] = value;
    return std::isfinite(value);
  }
  Diagnostics diagnostics("");
  return setParameter(spread.path, value, model, member, diagnostics);
}

[[noreturn]] void refuseDraws(const std::string& what) {
  throw InputError(
      fmt::format("{}: none of {} random draws is within the parameter's range", what, kMaxDraws));
}

/// Draws the numbers independently, each until it is in its range.
void drawApart(const SystemSpec& spec, const ModelInfo& model, std::mt19937_64& random,
               DrawnMember& member) {
  for (const Spread& spread : spec.ensemble.spread) {
    const double about = centreOf(spread, spec, model);
    double value = about + deviation(spread, random);
    int draws = 1;
    while (!put(spread, value, model, member.spec)) {
      if (++draws > kMaxDraws) {
        refuseDraws(spread.path);
      }
      value = about + deviation(spread, random);
    }
    member.values.push_back(value);
  }
}

/// Draws all numbers jointly until each is in its range.
void drawTogether(const SystemSpec& spec, const ModelInfo& model, std::mt19937_64& random,
                  DrawnMember& member) {
  const std::vector<Spread>& spreads = spec.ensemble.spread;
  std::size_t outside = 0;
  for (int draws = 0; draws < kMaxDraws; ++draws) {
    std::vector<double> independent;
    for (const Spread& spread : spreads) {
      independent.push_back(deviation(spread, random));
    }
    member.values = correlated(spec.ensemble, independent);
    std::size_t i = 0;
    for (; i < spreads.size(); ++i) {
      member.values[i] += centreOf(spreads[i], spec, model);
      if (!put(spreads[i], member.values[i], model, member.spec)) {
        outside = i;
        break;
      }
    }
    if (i == spreads.size()) {
      return;
    }
  }
  refuseDraws(spreads[outside].path);
}

}  // namespace

double centreOf(const Spread& spread, const SystemSpec& spec, const ModelInfo& model) {
  switch (spread.kind) {
    case Spread::Kind::kCoordinate:
      return spec.q[spread.coordinate];
    case Spread::Kind::kRate:
      return spec.v[spread.coordinate];
    default:
      return parameterAt(spread.path, model, spec).value();
  }
}

DrawnMember drawnMember(const SystemSpec& spec, const ModelInfo& model, std::size_t index) {
  DrawnMember member{spec, {}};
  member.spec.ensemble = {};
  std::seed_seq seed{spec.ensemble.seed, static_cast<std::uint32_t>(index)};
  std::mt19937_64 random(seed);
  if (spec.ensemble.factor.size() == 0) {
    drawApart(spec, model, random, member);
  } else {
    drawTogether(spec, model, random, member);
  }
  return member;
}

std::optional<SystemSpec> memberAt(const SystemSpec& spec, const ModelInfo& model,
                                   const std::vector<double>& values) {
  SystemSpec member = spec;
  member.ensemble = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!put(spec.ensemble.spread[i], values[i], model, member)) {
      return std::nullopt;
    }
  }
  return member;
}

std::string toleranceDiagnostic(const SystemSpec& spec, const ModelInfo& model) {
  try {
    static_cast<void>(drawnMember(spec, model, 0));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace whirl_twin
