// Moved to models/; kept for plugins that include it here.
#pragma once

#include "models/model_entry.h"  // IWYU pragma: export
