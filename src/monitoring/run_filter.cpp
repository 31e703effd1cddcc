#include "monitoring/run_filter.h"

#include <type_traits>
#include <variant>

namespace whirl_twin {
namespace {

template <class State>
constexpr bool kHasOwnClock =
    State::kKind.has(MessageKind::kCommand) || std::is_same_v<State, state::Measurement> ||
    std::is_same_v<State, state::FollowState> || std::is_same_v<State, state::SceneText> ||
    std::is_same_v<State, state::ControllerMeasurement> ||
    std::is_same_v<State, state::ControllerCommand>;

}  // namespace

bool RunFilter::take(const Message& message, double wall_time) {
  return std::visit(
      [&](const auto& state) {
        using State = std::decay_t<decltype(state)>;
        if constexpr (std::is_same_v<State, state::LoopStatistics>) {
          return takeLoop(state, wall_time);
        } else if constexpr (kHasOwnClock<State>) {
          return true;
        } else if constexpr (std::is_same_v<State, state::Alert>) {
          return take(std::nullopt, state.time, wall_time);  // sent again without a stamp
        } else {
          return take(state.at.stamp, state.at.time, wall_time);
        }
      },
      message);
}

bool RunFilter::takeLoop(const state::LoopStatistics& loop, double wall_time) {
  if (resets_.take(loop, wall_time)) {
    resets_.begin();
  }
  const bool own = resets_.isOfPresent(loop);
  of_others_ += own ? 0 : 1;
  return own;
}

bool RunFilter::take(std::optional<std::int64_t> stamp, double time, double wall_time) {
  if (resets_.confirmedBy(time, wall_time)) {
    resets_.begin();
  }
  const bool of_other = (stamp && resets_.takeStamp(*stamp, wall_time)) ||
                        resets_.isAmbiguous(wall_time) || resets_.isOfRival(time, wall_time);
  of_others_ += of_other ? 1 : 0;
  return !of_other;
}

}  // namespace whirl_twin
