// The measurements, as Markdown and as JSON.
#pragma once

#include <ostream>
#include <vector>

#include "peers.h"
#include "work_precision.h"

namespace whirl_twin::comparison {

struct MeasuredScene {
  ComparedScene scene;
  std::vector<Curve> curves;  ///< of its contenders
};

/// Environment of the measurement.
struct Circumstances {
  Peers peers;
  Effort effort;
  double load_before = 0.0;  ///< runnable processes, mean over a minute
  double load_after = 0.0;
};

void writeMarkdown(std::ostream& out, const std::vector<MeasuredScene>& scenes,
                   const Circumstances& circumstances);
void writeJson(std::ostream& out, const std::vector<MeasuredScene>& scenes,
               const Circumstances& circumstances);

}  // namespace whirl_twin::comparison
