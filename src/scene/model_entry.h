// Stands in models/ now; here for the plugins that were written when it stood here.
#pragma once

#include "models/model_entry.h"  // IWYU pragma: export
