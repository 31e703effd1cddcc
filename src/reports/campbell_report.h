// What `twin campbell` shows of one rotor.
#pragma once

#include <functional>
#include <vector>

#include "analysis/campbell.h"
#include "analysis/critical_speeds.h"
#include "analysis/undamped_critical_speeds.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"

namespace whirl_twin {

struct CampbellReport {
  const RotorSystem* system = nullptr;
  SpeedRange range;
  CampbellDiagram diagram;
  std::vector<UndampedCriticalSpeed> undamped;  ///< within the range
  std::vector<CriticalSpeed> peaks;             ///< of the unbalance response, within the range
  /// Crossings and undamped critical speeds in the range that a reduced rotor's equations have
  /// above the speed up to which it is valid: left out.
  std::size_t beyond = 0;
};

/// `progress` gets the number of speeds that are done.
CampbellReport campbellReport(const RotorSystem& system, const SpeedRange& range,
                              const std::vector<double>& harmonics, std::size_t branches,
                              const std::function<void(std::size_t)>& progress = {});

Json json(const CampbellReport& report);
std::string text(const CampbellReport& report, const ShownUnits& units = {});
/// Branches, crossings, peaks.
CsvTables tables(const CampbellReport& report);
Figure figure(const CampbellReport& report, const ShownUnits& units = {});

}  // namespace whirl_twin
