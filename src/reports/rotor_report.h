// The page of `twin report`: all analyses of a rotor, for print.
#pragma once

#include <optional>
#include <vector>

#include "reports/level_one_report.h"
#include "reports/report_page.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"
#include "scene/built_scene.h"

namespace whirl_twin {

struct RotorReportRequest {
  std::optional<double> speed;  ///< [rad/s], of modes and stability; none: the drive's highest
  std::vector<Stage> stages;
  ShownUnits units{};
};

/// The page. Its end lists the parts that are left out for the rotor, with the reason.
ReportPage rotorReportPage(const BuiltScene& scene, const RotorSystem& system,
                           const RotorReportRequest& request);

}  // namespace whirl_twin
