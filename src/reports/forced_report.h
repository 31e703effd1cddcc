// What `twin response --force` shows of one rotor: receptances and mobilities from a harmonic force
// that does not turn with the shaft.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/frequency_response.h"
#include "plots/chart.h"
#include "reports/csv_table.h"
#include "reports/rotor_systems.h"

namespace whirl_twin {

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
  bool grows = false;  ///< a mode does, at this speed: the response is not one that is reached
};

/// Of the whole rotor, however few coordinates it is stepped with. Throws Refusal for stations that
/// are not there, and numbers out of range.
ForcedReport forcedReport(const RotorSystem& system, const ForcedRequest& request);

Json json(const ForcedReport& report);
std::string text(const ForcedReport& report);
/// Every frequency at each station.
CsvTables tables(const ForcedReport& report);
/// Receptance, mobility and phase along the force.
Figure figure(const ForcedReport& report);

}  // namespace whirl_twin
