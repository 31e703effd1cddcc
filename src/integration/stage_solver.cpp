#include "integration/stage_solver.h"

namespace whirl_twin {

WHIRL_TWIN_STAGE_SOLVERS(, 1)
WHIRL_TWIN_STAGE_SOLVERS(, 2)
WHIRL_TWIN_STAGE_SOLVERS(, 3)
WHIRL_TWIN_STAGE_SOLVERS(, 4)

}  // namespace whirl_twin
