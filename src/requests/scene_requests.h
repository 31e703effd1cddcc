// What is requested of all systems of a scene: their analysis, and the stability of its control
// loops.
#pragma once

#include <optional>
#include <string>

#include "analysis/stability.h"
#include "reports/shown_units.h"
#include "requests/document.h"
#include "requests/work_progress.h"
#include "scene/scene.h"

namespace whirl_twin {

struct AnalyzeRequest {
  std::optional<std::string> system;
  std::optional<double> speed;    ///< [rad/s], of all shafts
  std::optional<std::string> at;  ///< [s], as typed: the motion after that time is analysed
  bool all_parameters = false;    ///< instability points also where their search takes minutes
  std::string modes = std::to_string(kLowestModes);  ///< as typed: a number or "all"
  bool insist = false;
  ShownUnits units = {};  ///< of the text
};
/// Throws InputError, and RunFailure for a system that stops before the time `at`.
Document analyzeDocument(Scene scene, const AnalyzeRequest& request, WorkProgress& progress);

/// `speed` [rad/s], of all shafts; none: that at the start. Throws InputError for a scene without
/// controllers.
Document loopDocument(const Scene& scene, std::optional<double> speed);

}  // namespace whirl_twin
