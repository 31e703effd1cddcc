#include "integration/erased_step.h"

#include "integration/erased_system.h"

namespace whirl_twin {

EvaluationPoint<double> momentOf(const Drive& drive, bool angle, double time,
                                 double offset) noexcept {
  const ShaftMotion shaft = angle ? drive.at(offset) : drive.withoutAngle(offset);
  return {time + offset, shaft.angle, shaft.speed, shaft.acceleration};
}

WHIRL_TWIN_CALLED_STEPS(, 1)
WHIRL_TWIN_CALLED_STEPS(, 2)
WHIRL_TWIN_CALLED_STEPS(, 3)
WHIRL_TWIN_CALLED_STEPS(, 4)
WHIRL_TWIN_CALLED_STEPS(, 5)

WHIRL_TWIN_CALLED_SYSTEM(, 1)
WHIRL_TWIN_CALLED_SYSTEM(, 2)
WHIRL_TWIN_CALLED_SYSTEM(, 3)
WHIRL_TWIN_CALLED_SYSTEM(, 4)
WHIRL_TWIN_CALLED_SYSTEM(, 5)

}  // namespace whirl_twin
