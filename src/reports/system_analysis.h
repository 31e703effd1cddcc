// What `twin analyze` shows of a system at its start.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/cross_coupling_margin.h"
#include "analysis/equilibria.h"
#include "analysis/quadratic_form.h"
#include "analysis/routh.h"
#include "analysis/sommerfeld_speeds.h"
#include "analysis/stability.h"
#include "analysis/validity.h"
#include "mechanics/dynamics.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "messages/stability_margin.h"
#include "monitoring/parameter_margins.h"
#include "reports/csv_table.h"
#include "reports/output.h"
#include "reports/rotor_sheet.h"
#include "reports/shown_units.h"
#include "scene/built_scene.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct SystemAnalysis {
  std::string name;
  const ModelInfo* model = nullptr;
  const Dynamics* dynamics = nullptr;  ///< the scene's
  std::vector<CoordinateInfo> coordinates;
  EvaluationPoint<double> moment;       ///< the scene's start
  std::optional<double> speed;          ///< [rad/s], of the shaft at the start
  Eigen::VectorXd q, v;                 ///< the scene's initial state
  Eigen::VectorXd acceleration;         ///< [rad/s^2] or [m/s^2], there, with what the inputs do
  Energies energies;                    ///< there
  std::vector<DryHold> dry_friction;    ///< there, with what the inputs do
  std::vector<Equilibrium> equilibria;  ///< at the initial shaft speed

  bool at_equilibrium = false;     ///< linearized about an equilibrium, not the initial state
  Eigen::VectorXd about, about_v;  ///< the state linearized about
  std::optional<LargestSag> sag;   ///< there, of a rotor
  Linearization linearization;
  Stability stability;  ///< of all coordinates

  /// The motion whose stability is evaluated where loads or coefficients alternate with a period.
  std::optional<PeriodicMotion> periodic;
  /// They alternate, and the verdict is that of the motion under their mean only.
  bool of_mean_loads = false;

  CyclicCoordinates cyclic;
  Eigen::VectorXd momenta;                  ///< generalized, of the initial state
  Stability reduced_stability;              ///< of the shape with its momenta as they are
  std::optional<RotorSheet> sheet;          ///< of a flexible rotor
  std::string uncertain_because;            ///< the verdict on that; "": it is certain
  std::optional<double> instability_speed;  ///< [rad/s]
  std::vector<state::CriticalSpeedMargin> critical_speeds;  ///< with margins at the initial speed
  double critical_speeds_to = 0.0;         ///< [rad/s], searched up to; infinity: all
  std::size_t critical_speeds_beyond = 0;  ///< that its equations have, where they do not hold
  double highest_speed = 0.0;              ///< [rad/s], up to which a reduced rotor is valid
  DataSpeeds tables = {};                  ///< of its bearings and pedestals
  std::optional<CrossCouplingMargin> cross_coupling;  ///< at the initial speed
  std::vector<SteadySpeed> steady_speeds;             ///< on its motor
  /// Of a stable motion, the nearest first; nothing where it was not searched.
  std::optional<std::vector<ParameterMargin>> parameter_margins;
  std::optional<LinearDampingLimit> decrement_amplitude;  ///< likewise; nothing: none vibrates
  std::optional<RobustStabilityMargin>
      spread_margin;  ///< of a steady motion, where its numbers are spread
};

/// Of which systems the instability points of the parameters are searched (isQuickToSearch).
enum class ParameterSearch { kWhereQuick, kOfAll };

/// `modes`: how many are computed of more than kMaxCompleteCoordinates. Throws RunFailure where
/// the numbers of the scene are too large to be analysed.
SystemAnalysis analyze(const BuiltScene& scene, std::size_t system,
                       ParameterSearch search = ParameterSearch::kWhereQuick,
                       std::size_t modes = kLowestModes);

Json json(const SystemAnalysis& analysis);
std::string text(const SystemAnalysis& analysis, const ShownUnits& units = {});
/// Modes, eigenvalues, critical speeds, and the numbers that stability is lost by.
CsvTables tables(const SystemAnalysis& analysis);

/// Of M q'' + K q = 0 at rest in the operating point.
struct FrequencyBounds {
  Eigen::VectorXd exact;            ///< [rad/s], ascending
  Eigen::MatrixXd shapes;           ///< mode shapes, largest entry 1, columns [n x n]
  std::optional<double> dunkerley;  ///< [rad/s], not above the lowest
  std::string inputError;           ///< why there is no lower bound
  std::optional<double> rayleigh;   ///< [rad/s], of a static deflection: not below the lowest
  std::optional<double> ritz;       ///< [rad/s], of that and its own deflection as assumed modes
  std::size_t iterations = 0;       ///< matrix iteration from the static deflection
  double iterated = 0.0;            ///< [rad/s], what it came to
};

struct SteadyResponse {
  double frequency = 0.0;     ///< [rad/s], of the load
  Eigen::VectorXd amplitude;  ///< of the small motion about the operating point
  Eigen::VectorXd lag;        ///< [rad], behind cos(frequency t)
  std::string inputError;     ///< why there is none
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
