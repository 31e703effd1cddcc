// What `twin response` and `twin orbit` show of one rotor: its unbalance response, or receptances
// and mobilities from a harmonic force that does not turn with the shaft.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/critical_speeds.h"
#include "analysis/frequency_response.h"
#include "analysis/synchronous_response.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"

namespace whirl_twin {

struct ResponseReport {
  const RotorSystem* system = nullptr;
  std::vector<std::size_t> stations;  ///< which are shown
  std::vector<SynchronousResponse> sweep;
  std::vector<CriticalSpeed> peaks;  ///< at the published station, within the range
};

/// Throws InputError for an unknown station and for a rotor without anything that turns.
ResponseReport responseReport(const RotorSystem& system, const SpeedRange& range,
                              const std::optional<std::string>& station);

Json json(const ResponseReport& report);
std::string text(const ResponseReport& report, const ShownUnits& units = {});
/// Every speed of the sweep, at each station; peaks.
CsvTables tables(const ResponseReport& report);
/// Bode plot, amplitude and phase lag over speed, and polar plot below.
Figure figure(const ResponseReport& report, const ShownUnits& units = {});

struct OrbitReport {
  const RotorSystem* system = nullptr;
  SynchronousResponse response;
};

OrbitReport orbitReport(const RotorSystem& system, double speed);

Json json(const OrbitReport& report);
std::string text(const OrbitReport& report, const ShownUnits& units = {});
CsvTables tables(const OrbitReport& report);
Figure figure(const OrbitReport& report, const ShownUnits& units = {});

struct ForcedRequest {
  std::string force;               ///< the station that it acts at
  std::string along = "x";         ///< or y
  std::vector<std::string> at;     ///< stations that respond; none: the one of the force
  std::optional<double> speed;     ///< [rad/s]; none: the drive's highest
  std::optional<double> from, to;  ///< [rad/s]; none: from 0 to a little beyond the sixth mode
  int points = 200;
};

struct ForcedReport {
  const RotorSystem* system = nullptr;
  ForcedRequest request;
  double speed = 0.0;                 ///< [rad/s]
  std::vector<std::size_t> stations;  ///< that respond, places among RotorSystem's
  std::vector<ForcedResponse> sweep;
  bool grows = false;  ///< a mode is unstable at this speed: the response is never reached
};

/// Of the full-order model, also where the simulation uses a reduced one. Throws InputError for
/// stations that are not there, and numbers out of range.
ForcedReport forcedReport(const RotorSystem& system, const ForcedRequest& request);

Json json(const ForcedReport& report);
std::string text(const ForcedReport& report, const ShownUnits& units = {});
/// Every frequency at each station.
CsvTables tables(const ForcedReport& report);
/// Receptance, mobility and phase along the force.
Figure figure(const ForcedReport& report, const ShownUnits& units = {});

}  // namespace whirl_twin
