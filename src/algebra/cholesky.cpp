#include "algebra/cholesky.h"

WHIRL_TWIN_CHOLESKY()
