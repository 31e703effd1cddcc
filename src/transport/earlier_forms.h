// What kinds of messages were before fields were added at their end: logs of then still play. An
// event in an earlier form is one of today's whose later fields say that they are not known.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "messages/message.h"

namespace whirl_twin {

struct EarlierForm {
  std::uint64_t fingerprint;  ///< of the LCM type then
  std::string_view later;     ///< the fields since: the end of the layout (payload_layout.h)
};

/// Of a kind, the earliest first; none if nothing is said.
template <class State>
inline constexpr std::array<EarlierForm, 0> kEarlierForms{};
template <>
inline constexpr std::array<EarlierForm, 1> kEarlierForms<state::StabilityMargin>{
    {{0x04269617e2cfdbe6, "ddd"}}};
template <>
inline constexpr std::array<EarlierForm, 2> kEarlierForms<state::LoopStatistics>{
    {{0xe676f1d3c287e44f, "lllldd"}, {0x9af8de11c53ac49c, "dd"}}};
template <>
inline constexpr std::array<EarlierForm, 1> kEarlierForms<state::Alert>{
    {{0x966688c34b63f52f, "bbbidd"}}};

}  // namespace whirl_twin
