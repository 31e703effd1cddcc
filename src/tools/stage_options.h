// --stage and --axial-stage: the stages of a compressor, for the stability level I of API 617.
#pragma once

#include <vector>

#include "analysis/cross_coupling_margin.h"
#include "tools/command.h"

namespace whirl_twin {

struct StageOptions {
  std::vector<std::vector<double>> centrifugal, axial;  ///< values of each, in SI units

  std::vector<Stage> all() const;
};

/// `options` outlives the command line.
void addStageOptions(const ProgramCommand& command, StageOptions& options);

/// Of a shaft that turns.
inline constexpr OptionQuantity kRunningSpeed{"a shaft speed", "rad/s", 0.0, kMaxOptionSpeed, true};

}  // namespace whirl_twin
