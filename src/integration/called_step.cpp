#include "integration/called_step.h"

namespace whirl_twin {

WHIRL_TWIN_CALLED_STEPS(, 1)
WHIRL_TWIN_CALLED_STEPS(, 2)
WHIRL_TWIN_CALLED_STEPS(, 3)
WHIRL_TWIN_CALLED_STEPS(, 4)

}  // namespace whirl_twin
