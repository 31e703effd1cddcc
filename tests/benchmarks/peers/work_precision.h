// Work-precision comparison: the minimum CPU time with which a solver meets an error.
//
// A level counts as met by a setting only if every finer tested setting meets it too: an error that
// is small by coincidence does not count. Times are medians over rounds in which all participants
// run one after the other, each round with a different first one; so other load of the machine
// affects all alike.
#pragma once

#include <array>
#include <vector>

#include "scene.h"

namespace whirl_twin::comparison {

/// Largest error over the horizon, relative to the largest position.
constexpr std::array<double, 3> kLevels{1.0e-3, 1.0e-6, 1.0e-9};

struct Point {
  double setting = 0.0;
  double error = 0.0;       ///< [-]
  double first_ms = 0.0;    ///< [ms], CPU time when the error was found
  double cpu_ms = 0.0;      ///< [ms], median; 0: not timed, no candidate for the minimum
  double prepare_ms = 0.0;  ///< [ms], median, of the computations before any run
};

/// The points of a contender, from coarse to fine.
using Curve = std::vector<Point>;

struct Effort {
  int rounds = 5;
  double budget_ms = 300.0;  ///< [ms], a ladder ends when three runs in a row take longer
  double least_ms = 5.0;     ///< [ms], shorter runs are repeated for that long
  std::size_t stride = 1;    ///< every so many settings of a ladder
};

/// A curve for each contender of the scene.
std::vector<Curve> measure(const ComparedScene& scene, const Effort& effort);

/// The fastest timed point that meets the level, or nullptr; optionally including preparation.
const Point* cheapest(const Curve& curve, double level, bool with_preparation = false);

}  // namespace whirl_twin::comparison
