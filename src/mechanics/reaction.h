// Constraint forces of a system, and the conditions under which its equations are valid. Not
// evaluated in the real-time path.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

/// A force or moment that a constraint carries.
struct Reaction {
  std::string name;  ///< "rod_tension_1"
  std::string unit;  ///< "N" or "N m"
  double value = 0.0;
};

/// A condition under which a model's equations describe the machine. It holds while margin > 0.
struct Condition {
  std::string name;     ///< "contact", "rod_end", "sliding", "no_tipping"
  std::string unit;     ///< of the margin
  double margin = 0.0;  ///< remaining margin: [N] of normal force, [m] to the rod's end, ...
  std::string broken;   ///< what it means that it does not hold: "the disc lifts off its plane"
};

/// A contact whose dry friction can hold (dry_friction.h).
struct DryHold {
  std::string place;     ///< "at the pivot"
  std::string unit;      ///< of the level: "N m", "N"; "-" for a coefficient
  double level = 0.0;    ///< of the friction
  double sliding = 0.0;  ///< [rad/s] or [m/s]
  bool held = false;
  double share = 0.0;  ///< of the friction that acts, against sliding; 1 or -1 where it slides
};

}  // namespace whirl_twin
