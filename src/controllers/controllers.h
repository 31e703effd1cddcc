// One function per controller, each in a separate translation unit.
#pragma once

#include "controllers/controller_info.h"

namespace whirl_twin {

ControllerInfo externalInfo();
ControllerInfo leadInfo();
ControllerInfo linearInfo();
ControllerInfo lqgInfo();
ControllerInfo lqrInfo();
ControllerInfo pidInfo();
ControllerInfo speedInfo();
ControllerInfo stateFeedbackInfo();
ControllerInfo swingUpInfo();

}  // namespace whirl_twin
