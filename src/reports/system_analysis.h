// What linear theory says of one system of a scene: equilibria, modes, stability and its margins,
// critical speeds. Everything `twin analyze` shows.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/cross_coupling_margin.h"
#include "analysis/equilibria.h"
#include "analysis/stability.h"
#include "analysis/validity.h"
#include "mechanics/dynamics.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "messages/stability_margin.h"
#include "monitoring/parameter_margins.h"
#include "monitoring/spread_margin.h"
#include "reports/csv_table.h"
#include "reports/largest_sag.h"
#include "reports/rotor_sheet.h"
#include "reports/steady_speeds.h"
#include "scene/built_scene.h"

namespace whirl_twin {

struct SystemAnalysis {
  std::string name;
  const ModelInfo* model = nullptr;
  const Dynamics* dynamics = nullptr;  ///< the scene's
  std::vector<CoordinateInfo> coordinates;
  Moment<double> moment;                ///< the scene's start
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

  /// The motion that is judged where loads or coefficients alternate with a period.
  std::optional<PeriodicMotion> periodic;
  /// They alternate, and the verdict is that of the motion under their mean only.
  bool of_mean_loads = false;

  CyclicCoordinates cyclic;
  Eigen::VectorXd momenta;                  ///< generalized, of the initial state
  Stability reduced_stability;              ///< of the shape with its momenta as they are
  std::optional<RotorSheet> sheet;          ///< of a flexible rotor
  std::string uncertain_because;            ///< the verdict on that; "": it is certain
  std::optional<double> instability_speed;  ///< [rad/s]
  std::vector<state::CriticalSpeedMargin> critical_speeds;  ///< seen from the initial speed
  double critical_speeds_to = 0.0;                          ///< [rad/s], looked for; infinity: all
  std::size_t critical_speeds_beyond = 0;  ///< that its equations have, where they do not hold
  double highest_speed = 0.0;              ///< [rad/s], that a reduced rotor holds to
  DataSpeeds tables = {};                  ///< of its bearings and pedestals
  std::optional<CrossCouplingMargin> cross_coupling;  ///< at the initial speed
  std::vector<SteadySpeed> steady_speeds;             ///< on its motor
  /// Of a stable motion, the nearest first; nothing where it was not looked for.
  std::optional<std::vector<ParameterMargin>> parameter_margins;
  std::optional<DecrementAmplitude> decrement_amplitude;  ///< likewise; nothing: none vibrates
  std::optional<SpreadMargin> spread_margin;  ///< of a steady motion, where its numbers are spread
};

/// Which systems have the margins of their numbers looked for (isQuickToSearch).
enum class ParameterSearch { kWhereQuick, kOfAll };

/// `modes`: how many are looked at of more than kMostCompleteCoordinates. Throws RunFailure where
/// the numbers of the scene are too large to be analysed.
SystemAnalysis analyze(const BuiltScene& scene, std::size_t system,
                       ParameterSearch search = ParameterSearch::kWhereQuick,
                       std::size_t modes = kLowestModes);

Json json(const SystemAnalysis& analysis);
std::string text(const SystemAnalysis& analysis);
/// Modes, eigenvalues, critical speeds, and the numbers that stability is lost by.
CsvTables tables(const SystemAnalysis& analysis);

}  // namespace whirl_twin
