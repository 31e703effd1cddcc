// The methods of the lecture notes on one system: influence coefficients, rigid-body modes, bounds
// of the lowest natural frequency with their direction, matrix iteration, Routh's conditions,
// steady response to its loads, reactions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/quadratic_form.h"
#include "analysis/routh.h"
#include "reports/output.h"
#include "reports/system_analysis.h"

namespace whirl_twin {

/// Of M q'' + K q = 0 at rest in the operating point.
struct FrequencyBounds {
  Eigen::VectorXd exact;            ///< [rad/s], ascending
  Eigen::MatrixXd shapes;           ///< mode shapes, largest entry 1, columns [n x n]
  std::optional<double> dunkerley;  ///< [rad/s], not above the lowest
  std::string refusal;              ///< why there is no lower bound
  std::optional<double> rayleigh;   ///< [rad/s], of a static deflection: not below the lowest
  std::optional<double> ritz;       ///< [rad/s], of that and its own deflection as assumed modes
  std::size_t iterations = 0;       ///< matrix iteration from the static deflection
  double iterated = 0.0;            ///< [rad/s], what it came to
};

struct SteadyResponse {
  double frequency = 0.0;     ///< [rad/s], of the load
  Eigen::VectorXd amplitude;  ///< of the small motion about the operating point
  Eigen::VectorXd lag;        ///< [rad], behind cos(frequency t)
  std::string refusal;        ///< why there is none
};

struct MethodAnalysis {
  bool conservative_form = false;    ///< no damping, gyroscopic or circulatory terms matter below
  std::string stiffness_form;        ///< "positive definite", ...
  Eigen::MatrixXd rigid_body_modes;  ///< columns
  std::optional<Eigen::MatrixXd> flexibility;  ///< influence coefficients
  std::optional<FrequencyBounds> bounds;
  std::vector<RouthCondition> routh_conditions;
  std::vector<SteadyResponse> responses;
  Eigen::VectorXd virtual_work;       ///< [J], at rest in the initial place, of unit displacements
  std::vector<Reaction> reactions;    ///< at the initial state
  std::vector<Condition> conditions;  ///< there
};

/// `analysis` as made by analyze().
MethodAnalysis analyzeMethods(const BuiltSystem& system, const SystemAnalysis& analysis);

Json json(const MethodAnalysis& methods, const SystemAnalysis& analysis);
std::string text(const MethodAnalysis& methods, const SystemAnalysis& analysis);

}  // namespace whirl_twin
