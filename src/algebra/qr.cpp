#include "algebra/qr.h"

WHIRL_TWIN_QR()
