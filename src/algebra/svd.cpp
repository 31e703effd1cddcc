#include "algebra/svd.h"

WHIRL_TWIN_SVD()
