// What is requested of the rotors of a scene, by the command line and by Python: Campbell diagram,
// unbalance response, orbits, modes, stability level I, critical speed map, balancing from a log.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/critical_map_report.h"
#include "reports/level_one_report.h"
#include "reports/response_report.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"
#include "reports/unbalance_report.h"
#include "requests/document.h"
#include "requests/work_progress.h"
#include "scene/scene.h"
#include "transport/channels.h"

namespace whirl_twin {

// `system`: the one rotor that is reported on; none: all of the scene. Every document has the
// scene's name and, by its name, each of them. Errors name the options of the commands. All throw
// InputError, for a scene without rotors too. `units` are those of the text.

struct CampbellReportRequest {
  std::optional<std::string> system;
  SpeedRangeOptions range;
  std::vector<double> harmonics{1.0};  ///< multiples of the speed
  int modes = 12;
  bool insist = false;
};
Document campbellDocument(const Scene& scene, const CampbellReportRequest& request,
                          WorkProgress& progress, const ShownUnits& units = {});

struct ResponseRequest {
  std::optional<std::string> system;
  std::optional<std::string> station;
  SpeedRangeOptions range;
  /// A harmonic force in place of the unbalance, over the same range.
  std::optional<ForcedRequest> force;
  bool insist = false;
};
Document responseDocument(const Scene& scene, const ResponseRequest& request,
                          const ShownUnits& units = {});

/// `speed` [rad/s], of the shaft.
Document orbitDocument(const Scene& scene, const std::optional<std::string>& system, double speed,
                       const ShownUnits& units = {});

struct ModesRequest {
  std::optional<std::string> system;
  std::optional<std::string> measured;  ///< path of a recording of the running machine
  std::optional<double> speed, limit;   ///< [rad/s]
  int modes = 6;                        ///< that are drawn
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<std::string> import = std::nullopt;  ///< settings of a table, as in Recording
};
Document modesDocument(const Scene& scene, const ModesRequest& request,
                       const ShownUnits& units = {});

Document stabilityDocument(const Scene& scene, const std::optional<std::string>& system,
                           const LevelOneRequest& request, const ShownUnits& units = {});

Document mapDocument(const Scene& scene, const std::optional<std::string>& system,
                     const CriticalMapRequest& request, const ShownUnits& units = {});

struct MeasuredBalanceRequest {
  std::optional<std::string> system;
  std::string measured;  ///< path of a recording of the running machine
  UnbalanceRequest unbalance;
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<std::string> import = std::nullopt;  ///< as in Recording
};
/// Of one rotor, and without the names of scene and system around its values.
Document balanceDocument(const Scene& scene, const MeasuredBalanceRequest& request);

}  // namespace whirl_twin
