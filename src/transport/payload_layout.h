// The layouts of the twin's LCM types, and a walk through a payload that proves it has one: every
// length within the payload, every string closed, nothing left over. The fields follow one another
// without padding, big-endian (LCM type specification, "Data encoding").
#pragma once

#include <cstddef>

#include "whirl_twin/alert_t.hpp"
#include "whirl_twin/drive_state_t.hpp"
#include "whirl_twin/ensemble_state_t.hpp"
#include "whirl_twin/motor_state_t.hpp"
#include "whirl_twin/parameter_change_t.hpp"
#include "whirl_twin/pendulum_state_t.hpp"
#include "whirl_twin/stability_margin_t.hpp"
#include "whirl_twin/whirl_state_t.hpp"

namespace whirl_twin {

/// One character a field, in the order of the .lcm file:
///   l int64, d double, i int32, b int8 or boolean, s string,
///   n int32 that is the length of the arrays that follow, S array of strings, D array of doubles.
template <class Message>
inline constexpr const char* kPayloadLayout = nullptr;
template <>
inline constexpr const char* kPayloadLayout<whirl_state_t> = "lllsdddbddddddddddbd";
template <>
inline constexpr const char* kPayloadLayout<pendulum_state_t> = "lllsdnSDDddd";
template <>
inline constexpr const char* kPayloadLayout<drive_state_t> = "lllsdddddldd";
template <>
inline constexpr const char* kPayloadLayout<motor_state_t> = "lllsdsddddddddd";
template <>
inline constexpr const char* kPayloadLayout<ensemble_state_t> = "lllsdllnSSDDDDDDDDDDDDDDD";
template <>
inline constexpr const char* kPayloadLayout<stability_margin_t> =
    "lllsdsbsnSDdnDnDiiiddddbnDSDDDDD";
template <>
inline constexpr const char* kPayloadLayout<parameter_change_t> = "lllsdnSDnSD";
template <>
inline constexpr const char* kPayloadLayout<alert_t> = "llissbbdddddddddds";

/// Throws RejectedMessage unless the fields of `layout` fill data[0..size) exactly, after the
/// fingerprint [8 bytes] it begins with.
void requireLayout(const char* layout, const void* data, std::size_t size);

}  // namespace whirl_twin
