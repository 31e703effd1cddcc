#include "integration/called_system.h"

namespace whirl_twin {

WHIRL_TWIN_CALLED_SYSTEM(, 1)
WHIRL_TWIN_CALLED_SYSTEM(, 2)
WHIRL_TWIN_CALLED_SYSTEM(, 3)
WHIRL_TWIN_CALLED_SYSTEM(, 4)
WHIRL_TWIN_CALLED_SYSTEM(, 5)

}  // namespace whirl_twin
