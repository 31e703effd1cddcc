#include "scene/parameter_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>

#include "analysis/natural_modes.h"
#include "messages/names.h"
#include "models/model_info.h"

namespace whirl_twin {

namespace {

struct Elsewhere {
  const char* theirs;
  const char* ours;
};

/// Names in other programs and books.
constexpr std::array<Elsewhere, 27> kElsewhere = {{{"E", "youngs_modulus"},
                                                   {"elastic_modulus", "youngs_modulus"},
                                                   {"G", "shear_modulus"},
                                                   {"G_s", "shear_modulus"},
                                                   {"nu", "poissons_ratio"},
                                                   {"rho", "density"},
                                                   {"L", "length"},
                                                   {"l", "length"},
                                                   {"od", "outer_diameter"},
                                                   {"odl", "outer_diameter"},
                                                   {"odr", "outer_diameter_end"},
                                                   {"id", "inner_diameter"},
                                                   {"idl", "inner_diameter"},
                                                   {"idr", "inner_diameter_end"},
                                                   {"n", "node"},
                                                   {"m", "mass"},
                                                   {"Ip", "polar_inertia"},
                                                   {"Jp", "polar_inertia"},
                                                   {"Id", "transverse_inertia"},
                                                   {"It", "transverse_inertia"},
                                                   {"alpha", "mass_damping"},
                                                   {"beta", "stiffness_damping"},
                                                   {"rpm", "speed"},
                                                   {"material", "materials"},
                                                   {"n_link", "pedestals"},
                                                   {"supports", "pedestals"},
                                                   {"foundation", "pedestals"}}};

/// The name here of a parameter of other programs; "" if unknown, or not among `known`.
std::string nameHere(const std::string& name, const std::vector<std::string>& known) {
  const auto* const found =
      std::find_if(kElsewhere.begin(), kElsewhere.end(),
                   [&](const Elsewhere& word) { return name == word.theirs; });
  if (found == kElsewhere.end()) {
    return "";
  }
  const std::string ours = found->ours;
  // Pedestals have a separate table, so they are not among the known columns.
  const bool has =
      ours == "pedestals" || std::find(known.begin(), known.end(), ours) != known.end();
  return has ? ours : "";
}

}  // namespace

std::string expected(Range range, const std::string& unit) {
  if (range == Range::kAny) {
    return fmt::format("a finite number{}", unit == "-" ? "" : " in " + unit);
  }
  return describe(range) + (unit == "-" ? "" : " " + unit);
}

bool inRange(Range range, double value) {
  switch (range) {
    case Range::kPositive:
      return std::isfinite(value) && value > 0.0;
    case Range::kNotNegative:
      return std::isfinite(value) && value >= 0.0;
    case Range::kCount:
      return value >= 1.0 && value <= 1.0e6 && value == std::floor(value);
    case Range::kAny:
      break;
  }
  return std::isfinite(value);
}

std::string objection(Range range, const std::string& unit, double value) {
  return inRange(range, value)
             ? ""
             : fmt::format(std::isfinite(value) ? "must be {}, found {}" : "must be {}, found '{}'",
                           expected(range, unit), value);
}

std::string nameDiagnostic(const std::string& name, const std::vector<std::string>& known,
                           const std::string& kind) {
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    return "";
  }
  if (const std::string here = nameHere(name, known); !here.empty()) {
    return fmt::format("unknown {}; write '{}'", kind, here);
  }
  const std::string near = nearestName(name, known);
  return fmt::format("unknown {}{}", kind,
                     near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

namespace {

/// Systems with more coordinates are not checked: their matrices would take most of the reading
/// time.
constexpr int kMaxCoordinates = 400;

double largestOf(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) {
    return 0.0;
  }
  return matrix.allFinite() ? matrix.cwiseAbs().maxCoeff()
                            : std::numeric_limits<double>::infinity();
}

/// [1/s]; 0 if it is not known.
double largestRate(const Dynamics& dynamics, const SystemSpec& spec, double speed) {
  const auto n = static_cast<Eigen::Index>(spec.q.size());
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(spec.q.data(), n);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  const EvaluationPoint<double> at{0.0, 0.0, speed, 0.0};
  if (massIsSingular(dynamics, q, zero, at)) {  // by its parameters, or at these coordinates
    return dynamics.singularMass().empty() ? std::numeric_limits<double>::infinity() : 0.0;
  }
  const Linearization matrices = dynamics.linearization(q, zero, zero, at);
  if (!matrices.mass.allFinite()) {
    return std::numeric_limits<double>::infinity();
  }
  const double mass = matrices.mass.diagonal().cwiseAbs().minCoeff();
  const double damping = std::max(largestOf(matrices.damping), largestOf(matrices.gyroscopic));
  const double stiffness = std::max(largestOf(matrices.stiffness), largestOf(matrices.circulatory));
  return std::max(damping / mass, std::sqrt(stiffness / mass));
}

}  // namespace

std::string ratesDiagnostic(const Dynamics& dynamics, const SystemSpec& spec, double speed) {
  if (dynamics.dof() > kMaxCoordinates) {
    return "";
  }
  double rate = 0.0;
  try {
    rate = largestRate(dynamics, spec, speed);
  } catch (const std::exception&) {  // it cannot be linearized there
  }
  return rate <= kMaxRate ? ""
                          : fmt::format(
                                "together give a fastest rate of {:.2g} 1/s: above {:.0e} 1/s "
                                "the equations overflow",
                                rate, kMaxRate);
}

}  // namespace whirl_twin
