#include "algebra/eigenvalues.h"

WHIRL_TWIN_EIGENVALUES()
