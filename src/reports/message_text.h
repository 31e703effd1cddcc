// What a message says, field by field, for people and for programs, whatever its kind.
#pragma once

#include <string>

#include "messages/message.h"
#include "reports/output.h"

namespace whirl_twin {

/// "speed 104.72 rad/s, x 1.2e-05 m, ...", in the order of the .msg file, without its time and whom
/// it is about.
std::string messageText(const Message& message);

/// By name, with step, time [s], stamp [ns] and whom it is about.
Json messageJson(const Message& message);

}  // namespace whirl_twin
