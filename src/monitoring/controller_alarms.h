// All alarms on one controller, of the controller by its name:
//
//   CONTROLLER_LOST       it runs in another process and has not answered for its timeout; a danger
//   LOOP_SENSITIVITY      the sensitivity of its loop peaks above `sensitivity_warning`, by default
//                         where zone C of ISO 14839-3:2006 begins, or is unbounded; a warning. Of a
//                         loop that is unstable, or cannot be evaluated, others alarm: it holds.
//   ACTUATOR_SATURATED    more than half of its outputs were beyond the limit or the slew of an
//                         actuator, second after second, for longer than `saturation_time`: margins
//                         are those of a law whose outputs are applied. A warning.
//   RESONANCE_NOT_PASSED  a resonance keeps a shaft from the speed that the controller has to bring
//                         it to: refused beforehand (a warning); captured and on its way back,
//                         trying again, aborted (a danger, once it was captured). Clears when the
//                         shaft has passed.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "messages/controller_state.h"
#include "monitoring/condition_alarm.h"
#include "scene/controller_spec.h"

namespace whirl_twin {

class ControllerAlarms {
 public:
  ControllerAlarms(const ControllerSpec& controller, const SharedSettings& settings);

  void update(const state::ControllerState& controller, AlertList& alerts);
  void update(const state::ControllerMargins& margins, AlertList& alerts);

  // Parts of the last whole second [-]; NaN before there was one.
  double saturated() const { return saturated_; }  ///< of its outputs
  double missed() const { return missed_; }        ///< of its samples

 private:
  /// What had been counted where a second began.
  struct Mark {
    double time = 0.0;  ///< [s], simulated
    std::int64_t samples = 0, saturated = 0, missed = 0;
  };

  void updateSaturation(const state::ControllerState& controller, AlertList& alerts);
  void updatePassage(const state::ControllerState& controller, AlertList& alerts);

  std::string refusal_;  ///< of a passage, known beforehand; "" without
  SharedSettings settings_;
  Alarm lost_, loop_, saturation_, passage_;
  std::optional<Mark> mark_;
  double saturated_ = std::numeric_limits<double>::quiet_NaN();
  double missed_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace whirl_twin
