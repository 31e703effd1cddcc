// What `twin stability` shows of one rotor: stability level I of API 617, the logarithmic decrement
// of the slowest decaying forward whirl over a cross-coupled stiffness at mid-span, and what its
// stages are taken to have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/cross_coupling_margin.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"

namespace whirl_twin {

struct LevelOneRequest {
  std::optional<double> speed;    ///< [rad/s]; none: the drive's highest
  std::optional<std::string> at;  ///< station; none: the one nearest to mid-span
  std::vector<Stage> stages;
};

struct LevelOneReport {
  const RotorSystem* system = nullptr;
  LevelOneRequest request;
  double speed = 0.0;                  ///< [rad/s]
  std::string station;                 ///< that the cross-coupling acts at
  std::vector<double> expected;        ///< [N/m], of each stage
  std::optional<double> applied;       ///< Q_A [N/m], of all stages
  std::optional<double> margin;        ///< Q_0 [N/m]; none found, no cross-coupling makes it grow
  std::vector<CrossCouplingRow> rows;  ///< from 0 to beyond Q_0 or Q_A, where one whirls forward
  std::optional<CrossCouplingRow> at_applied;  ///< the mode at Q_A
  /// Of its speed to the first critical speed on rigid bearings [-].
  std::optional<double> critical_speed_ratio;

  /// Something whirls forward without cross-coupling; else all that does is damped too much.
  bool whirlsUncoupled() const;
  /// Why a level II analysis is required; empty: none of the criteria evaluated here requires it.
  std::vector<std::string> reasons() const;
};

/// Of the full-order model, also where the simulation uses a reduced one. Throws InputError for a
/// station that is not there, numbers out of range, and a rotor without a forward mode.
LevelOneReport levelOneReport(const RotorSystem& system, const LevelOneRequest& request);

Json json(const LevelOneReport& report);
std::string text(const LevelOneReport& report, const ShownUnits& units = {});
/// The decrement over the cross-coupling; the stages.
CsvTables tables(const LevelOneReport& report);
Figure figure(const LevelOneReport& report, const ShownUnits& units = {});

}  // namespace whirl_twin
