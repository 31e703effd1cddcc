// The earlier name of EvaluationPoint, for models in packages of others: until release 0.4.
#pragma once

#include "mechanics/evaluation_point.h"

namespace whirl_twin {

template <class S>
using Moment [[deprecated("use EvaluationPoint")]] = EvaluationPoint<S>;

}  // namespace whirl_twin
