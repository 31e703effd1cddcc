// What `twin report` writes: all that is told of a rotor on paper, on one page.
#pragma once

#include <string>

#include "reports/level_one_report.h"
#include "reports/rotor_systems.h"
#include "scene/built_scene.h"

namespace whirl_twin {

struct RotorReportRequest {
  std::optional<double> speed;  ///< [rad/s], of modes and stability; none: the drive's highest
  std::vector<Stage> stages;
};

/// The page (HTML). A part that a rotor does not have is told of at its end, with the reason.
std::string rotorReportPage(const BuiltScene& scene, const RotorSystem& system,
                            const RotorReportRequest& request);

}  // namespace whirl_twin
