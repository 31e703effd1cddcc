// A scene of the comparison: the same motion for all participants, and its reference.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "contender.h"

namespace whirl_twin::comparison {

/// The reference motion, with its accuracy.
struct Reference {
  std::string origin;               ///< "closed form", ...
  std::vector<double> coordinates;  ///< of each sample, one after the other
  double error = 0.0;               ///< [-], its error bound, relative to the largest position
};

struct ComparedScene {
  std::string name;
  std::string description;
  Output output;
  /// The coordinates that are compared: those of one unit.
  std::vector<std::size_t> positions;
  Reference reference;
  std::vector<Contender> contenders;
};

/// The equations that a peer integrates: see equations.h.
template <class Equations>
struct Problem {
  Equations equations;
  std::array<double, Equations::kStates> start{};
  Output output;
  double amplitude = 1.0;  ///< largest coordinate, which absolute tolerances refer to
};

/// Largest distance of the compared positions from the reference's over all samples, relative to
/// the largest reference; infinity if not finite.
double relativeError(const ComparedScene& scene, const std::vector<double>& coordinates);

ComparedScene jeffcottScene();
ComparedScene runUpScene();
ComparedScene doublePendulumScene();
ComparedScene spinningPendulumScene();
ComparedScene shaftScene();

}  // namespace whirl_twin::comparison
