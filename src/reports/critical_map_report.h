// What `twin map` shows of one rotor: its undamped critical speeds over the stiffness of its
// bearings, and where on that map its own bearings are.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "analysis/undamped_critical_speeds.h"
#include "reports/csv_table.h"
#include "reports/figure.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"

namespace whirl_twin {

/// A bearing of the rotor as it is, over the speeds of the map.
struct BearingOnMap {
  int node = 0;
  std::vector<double> kxx, kyy;  ///< [N/m], of all that holds the node, at each speed

  bool rigid() const { return std::isinf(kxx.back()); }
};

struct CriticalMapReport {
  const RotorSystem* system = nullptr;
  CriticalSpeedMap map;
  std::vector<double> speeds;          ///< [rad/s]
  std::vector<BearingOnMap> bearings;  ///< those that are varied
  std::vector<int> left_out;           ///< nodes of bearings that are not: seals, magnets
  bool pedestals = false;              ///< it has some, which the map does not
};

/// Options of `twin map`.
inline constexpr double kMaxMapStiffness = 1.0e18;  ///< [N/m]

struct CriticalMapRequest {
  std::optional<double> from, to;  ///< [N/m]; none: two decades beyond the bearings' own
  int points = 61;
  int modes = 4;
  std::vector<int> nodes;  ///< of the bearings to vary; none: all but the soft ones
};

/// A node is left out by itself whose direct stiffness at the drive's highest speed is below a
/// tenth of the stiffest: a seal, which does not carry the rotor. Throws InputError for what is no
/// flexible_rotor, and for a node without a bearing.
CriticalMapReport criticalMapReport(const RotorSystem& system, const CriticalMapRequest& request);

Json json(const CriticalMapReport& report);
std::string text(const CriticalMapReport& report, const ShownUnits& units = {});
/// Critical speeds over the stiffness; the bearings over the speed.
CsvTables tables(const CriticalMapReport& report);
Figure figure(const CriticalMapReport& report, const ShownUnits& units = {});

}  // namespace whirl_twin
