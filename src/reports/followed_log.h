// A log of measurements, followed: what a follower has learned of the machine from it, and, sample
// by sample, the motion of its twin.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "estimation/follow_settings.h"
#include "messages/follow_state.h"
#include "reports/measured_file.h"
#include "reports/output.h"
#include "reports/sample_writer.h"
#include "twin/twin.h"

namespace whirl_twin {

/// An unbalance beside the scene's own.
struct FoundUnbalance {
  std::string station;
  double amount = 0.0;     ///< [kg m]
  double angle = 0.0;      ///< [rad], of the shaft's angle 0
  double deviation = 0.0;  ///< [kg m], of either component
  double factor = 1.0;     ///< of it: over that of white residuals
};

struct EstimatorSystem {
  std::string name;
  bool found = false;          ///< its motion was found
  state::FollowState last;     ///< the last one published
  std::vector<double> factor;  ///< of each parameter's deviation: over that of white residuals
  std::vector<double> start;   ///< of its parameters, in the scene
  std::vector<double> rms;     ///< of each channel: of the residuals [its unit]; NaN: none
  std::vector<bool> is_input;  ///< of each channel: it shows what acts
  std::vector<FoundUnbalance> unbalances;
  std::uint64_t windows = 0;     ///< of residuals that were tested
  std::uint64_t mismatched = 0;  ///< of them: too large, too small, or not white
  // The first drift of a parameter that was detected; "": none.
  std::string drift_parameter;
  double drift_from = kNaN;
  double drift_to = kNaN;
  double drift_since = kNaN;     ///< [s]
  double drift_reported = kNaN;  ///< [s]
};

struct FollowedLog {
  std::string scene, log;
  double duration = 0.0;  ///< [s]
  MeasuredFile file;
  std::int64_t restarts = 0;
  std::vector<EstimatorSystem> systems;
};

/// Follows the measurements of a recording. writer
/// may be null; it is given a sample every so many steps, and what was measured, and is not
/// finished. Throws as readMeasurements().
FollowedLog followLog(const Twin& twin, const FollowSettings& settings, const Recording& recording,
                      SampleWriter* writer, std::int64_t every,
                      const std::function<void(std::uint64_t, std::uint64_t)>& advanced);

std::string text(const FollowedLog& run);
Json json(const FollowedLog& run);

}  // namespace whirl_twin
