// The earlier name of InputError, for packages of others: until release 0.4.
#pragma once

#include "messages/input_error.h"

namespace whirl_twin {

using Refusal [[deprecated("use InputError")]] = InputError;

}  // namespace whirl_twin
