// What a model says of itself: its coordinates and parameters, with units and ranges. Scene files
// are checked against it and `twin models` prints it.
#pragma once

#include <limits>

namespace whirl_twin {

/// A generalized coordinate.
struct Coordinate {
  const char* name;  ///< as in scene files; its rate is NAME_rate
  const char* unit;  ///< "rad" or "m"
};

enum class Range { kPositive, kNotNegative, kAny };

/// A parameter of a model, bound to the member it fills.
template <class Model>
struct Parameter {
  const char* name;
  const char* unit;  ///< "-" without
  Range range;
  double Model::*member;
  const char* meaning;
  double fallback = std::numeric_limits<double>::quiet_NaN();  ///< default; NaN: must be given
  const char* fallback_parameter = nullptr;  ///< default: the value of this parameter
};

}  // namespace whirl_twin
