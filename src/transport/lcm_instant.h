// The instant every LCM type of a state carries: utime [us] and time [s] of the simulation, its
// step, and the stamp [ns] of the ROS header.
#pragma once

#include <fmt/format.h>

#include "scene/states.h"
#include "transport/message_check.h"

namespace whirl_twin {

template <class Message>
void putInstant(const state::Instant& at, Message& message) {
  message.utime = utimeOf(at.time);
  message.stamp = at.stamp;
  message.step = at.step;
  message.time = at.time;
}

template <class Message>
void requireUtime(const Message& message) {
  if (message.utime != utimeOf(message.time)) {
    throw RejectedMessage(fmt::format("utime: expected {} us, the time of {} s, found {}",
                                      utimeOf(message.time), message.time, message.utime));
  }
}

template <class Message>
state::Instant takeInstant(const Message& message) {
  requireInstant(message.step, message.time, message.stamp);
  requireUtime(message);
  return {message.step, message.time, message.stamp};
}

}  // namespace whirl_twin
