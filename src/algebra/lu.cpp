#include "algebra/lu.h"

WHIRL_TWIN_LU()
