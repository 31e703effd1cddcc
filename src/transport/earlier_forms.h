// Layouts of message kinds before fields were appended to them, so that logs of that time can be
// read. An event in an earlier form becomes a current one whose later fields are marked as not
// known.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "messages/message.h"

namespace whirl_twin {

struct EarlierForm {
  std::uint64_t fingerprint;  ///< of the LCM type at that time
  std::string_view later;     ///< fields appended since: the end of the layout (payload_layout.h)
};

/// [bytes] of the later fields with default values: a string takes its length and a zero, an array
/// its length.
constexpr std::size_t sizeUnset(std::string_view later) {
  std::size_t size = 0;
  for (const char field : later) {
    size += field == 'b'                                   ? 1
            : field == 'i' || field == 'n'                 ? 4
            : field == 's'                                 ? 5
            : field == 'S' || field == 'D' || field == 'B' ? 0
                                                           : 8;
  }
  return size;
}

/// The earlier forms of a kind, the earliest first; none by default.
template <class State>
inline constexpr std::array<EarlierForm, 0> kEarlierForms{};
template <>
inline constexpr std::array<EarlierForm, 5> kEarlierForms<state::StabilityMargin>{
    {{0x04269617e2cfdbe6, "dddsddsdddibiidbsdddb"},
     {0x6ff93c955afc2f62, "sddsdddibiidbsdddb"},
     {0x4058c40523023a98, "iidbsdddb"},
     {0x2dc55037686885d0, "sdddb"},
     {0x0517710961ef6cb2, "ddb"}}};
template <>
inline constexpr std::array<EarlierForm, 6> kEarlierForms<state::LoopStatistics>{
    {{0xe676f1d3c287e44f, "llllddlsnSDDDilddddddsnSDDD"},
     {0x9af8de11c53ac49c, "ddlsnSDDDilddddddsnSDDD"},
     {0x2a3f5309642532d1, "lsnSDDDilddddddsnSDDD"},
     {0x221db61304d694dd, "nSDDDilddddddsnSDDD"},
     {0x0116770a44453e47, "ilddddddsnSDDD"},
     {0xa07d41b077898d97, "snSDDD"}}};
template <>
inline constexpr std::array<EarlierForm, 1> kEarlierForms<state::Alert>{
    {{0x966688c34b63f52f, "bbbidd"}}};

}  // namespace whirl_twin
