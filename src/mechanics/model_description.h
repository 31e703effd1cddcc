// Description of a model: its coordinates, inputs and parameters, with units and ranges. Scene
// files are checked against it and `twin models` prints it.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace whirl_twin {

/// A generalized coordinate.
struct Coordinate {
  const char* name;          ///< as in scene files; its rate is NAME_rate
  const char* unit;          ///< "rad" or "m"
  const char* meaning = "";  ///< of what, from where, and which way is positive
};

/// What may act on a model of n coordinates from outside, along a direction that does not change:
/// the generalized force of a value u is u times `direction`.
template <std::size_t n>
struct Input {
  const char* name;  ///< as in scene files
  const char* unit;  ///< of u: "N", "N m", "m" of a support behind a spring
  std::array<double, n> direction;
  const char* meaning;
};

enum class Range { kPositive, kNotNegative, kCount, kAny };  // kCount: 1, 2, 3 ...

/// A parameter of a model, bound to the data member that it sets.
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

/// The parameters of a model, as those of another form that inherits them.
template <class Form, class Model, std::size_t count>
constexpr std::array<Parameter<Form>, count> inherited(
    const std::array<Parameter<Model>, count>& parameters) {
  std::array<Parameter<Form>, count> same{};
  for (std::size_t i = 0; i < count; ++i) {
    const Parameter<Model>& p = parameters[i];
    same[i] = {p.name, p.unit, p.range, p.member, p.meaning, p.fallback, p.fallback_parameter};
  }
  return same;
}

}  // namespace whirl_twin
