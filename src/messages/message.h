// All kinds of messages that leave or enter a twin, one row each.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "messages/alert.h"
#include "messages/commands.h"
#include "messages/controller_state.h"
#include "messages/fields.h"
#include "messages/follow_state.h"
#include "messages/loop_statistics.h"
#include "messages/measurement.h"
#include "messages/monitor_status.h"
#include "messages/order_state.h"
#include "messages/scene_text.h"
#include "messages/stability_margin.h"
#include "messages/states.h"

namespace whirl_twin::state {

// Samples sent to a controller in another process, and its answers.

struct ControllerMeasurement {
  static constexpr MessageKind kKind{"sample", "ControllerMeasurement", "controllers/*/measurement",
                                     MessageKind::kSeries};

  Instant at;  ///< step: the index of the sample
  std::string controller;
  std::vector<double> values;  ///< of its measured quantities
  std::int64_t run = 0;        ///< number of the run of simulated time: changes at each reset

  template <class Visit>
  static void fields(Visit& visit) {
    visit.sampled(TWIN_FIELD(controller));
    visit.array(TWIN_FIELD(count), TWIN_FIELD(values), "");
    visit(TWIN_FIELD(run), "", between(0, std::numeric_limits<std::int64_t>::max()));
  }
};

struct ControllerCommand {
  static constexpr MessageKind kKind{"command", "ControllerCommand", "controllers/*/command",
                                     MessageKind::kCommand};

  Instant at;  ///< of the sample that it answers
  std::string controller;
  std::vector<double> values;  ///< of its outputs
  std::int64_t run = 0;        ///< of the sample; 0: unknown

  template <class Visit>
  static void fields(Visit& visit) {
    visit.sampled(TWIN_FIELD(controller));
    visit.array(TWIN_FIELD(count), TWIN_FIELD(values), "");
    visit(TWIN_FIELD(run), "", between(0, std::numeric_limits<std::int64_t>::max()));
  }
};

}  // namespace whirl_twin::state

namespace whirl_twin {

/// Any message that the twin publishes or receives.
using Message =
    std::variant<state::WhirlState, state::PendulumState, state::DriveState, state::MotorState,
                 state::EnsembleState, state::StabilityMargin, state::ParameterChange,
                 state::LoopStatistics, state::Measurement, state::InputCommand, state::Alert,
                 state::MonitorStatus, state::OrderState, state::AlarmCommand, state::FollowState,
                 state::ControllerState, state::ControllerMargins, state::ControllerMeasurement,
                 state::ControllerCommand, state::SceneText>;

/// A kind as a value: typename decltype(kind)::State.
template <class T>
struct KindOf {
  using State = T;
};

namespace detail {
template <class Visit, class... States>
void eachKindOf(const std::variant<States...>*, Visit& visit) {
  (visit(KindOf<States>{}), ...);
}
}  // namespace detail

/// visit(KindOf<State>) for every kind.
template <class Visit>
void eachKind(Visit&& visit) {
  detail::eachKindOf(static_cast<const Message*>(nullptr), visit);
}

/// [s], simulated.
template <class State>
double timeOf(const State& state) {
  return state.at.time;
}
inline double timeOf(const state::Alert& alert) {
  return alert.time;
}

}  // namespace whirl_twin
