#include "integration/forced_step.h"

namespace whirl_twin {

WHIRL_TWIN_FORCED_STEPS(, 1)
WHIRL_TWIN_FORCED_STEPS(, 2)
WHIRL_TWIN_FORCED_STEPS(, 3)
WHIRL_TWIN_FORCED_STEPS(, 4)

}  // namespace whirl_twin
