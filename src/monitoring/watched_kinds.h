// Which kinds of messages the monitor listens to, and as what.
#pragma once

#include <type_traits>
#include <utility>

#include "monitoring/twin_monitor.h"

namespace whirl_twin {

/// Whether the monitor takes messages of a kind as states, with the time they arrived at.
template <class State, class = void>
struct IsWatchedState : std::false_type {};
template <class State>
struct IsWatchedState<State, std::void_t<decltype(std::declval<TwinMonitor&>().take(
                                 std::declval<const State&>(), double{}))>>
    : std::bool_constant<!std::is_same_v<State, state::LoopStatistics>> {};

/// What the monitor listens to; the rest is of no concern to it.
template <class State>
constexpr bool isWatched() {
  return IsWatchedState<State>::value || std::is_same_v<State, state::ParameterChange> ||
         std::is_same_v<State, state::LoopStatistics>;
}

}  // namespace whirl_twin
