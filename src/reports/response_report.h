// What `twin response` and `twin orbit` show of one rotor.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/critical_speeds.h"
#include "analysis/synchronous_response.h"
#include "plots/chart.h"
#include "reports/csv_table.h"
#include "reports/rotor_systems.h"

namespace whirl_twin {

struct ResponseReport {
  const RotorSystem* system = nullptr;
  std::vector<std::size_t> stations;  ///< which are shown
  std::vector<SynchronousResponse> sweep;
  std::vector<CriticalSpeed> peaks;  ///< at the published station, within the range
};

/// Throws Refusal for an unknown station and for a rotor without anything that turns.
ResponseReport responseReport(const RotorSystem& system, const SpeedRange& range,
                              const std::optional<std::string>& station);

Json json(const ResponseReport& report);
std::string text(const ResponseReport& report);
/// Every speed that was looked at, at each station; peaks.
CsvTables tables(const ResponseReport& report);
/// Bode plot, amplitude and phase lag over speed, and polar plot below.
Figure figure(const ResponseReport& report);

struct OrbitReport {
  const RotorSystem* system = nullptr;
  SynchronousResponse response;
};

OrbitReport orbitReport(const RotorSystem& system, double speed);

Json json(const OrbitReport& report);
std::string text(const OrbitReport& report);
CsvTables tables(const OrbitReport& report);
Figure figure(const OrbitReport& report);

}  // namespace whirl_twin
