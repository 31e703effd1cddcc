// Text of the reason why a system stopped.
#pragma once

#include <cstdint>
#include <string>

#include "integration/motion_state.h"
#include "scene/built_system.h"
#include "twin/record.h"

namespace whirl_twin {

/// "state not finite", "implicit step did not converge" or that it was not prepared for the speed;
/// "" while running.
const char* describe(StepStatus status);
/// "controller pd has not answered for 0.5 s of wall time (on_timeout: stop)", if this controller
/// stops the system when it is lost; else "".
std::string describeLost(const ControllerSpec& controller, std::size_t system);

/// "rotor: stopped in step 41 (t = 0.041 s), state not finite; last good state: x = ..., ..."
std::string stopText(const BuiltSystem& system, const SystemView& view, const std::string& why,
                     std::int64_t step, double time);

}  // namespace whirl_twin
