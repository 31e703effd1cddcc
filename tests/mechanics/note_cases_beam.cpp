// The hinged beam against the lecture notes' reference numbers: small angles as printed, and the
// finite rotation.
#include "note_system.h"

namespace whirl_twin {

std::vector<double> rigidBeamAnswers(const NoteCase& given) {
  NoteCase c = given;
  if (c.id == "rigid_beam.step.t1") {  // a motion from rest under the load at its full height
    c.id = "traj." + c.id;
    c.state = "theta";
    c.time = 1.0;
  }
  const NoteSystem system(c, "hinged_beam",
                          {{"mass", c.at("M")},
                           {"length", c.at("l")},
                           {"stiffness", c.at("k")},
                           {"damping", c.at("c")},
                           {"load_amplitude", c.at("f0")},
                           {"load_frequency", c.at("Om", 0.0)}},
                          choice("geometry", c.system == "rigid_beam" ? "small" : "finite"));
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const Linearization l = system.linearAt({0.0});
  const double zeta = l.damping(0, 0) / (2.0 * std::sqrt(l.stiffness(0, 0) * l.mass(0, 0)));
  if (c.startsWith("rigid_beam.p.")) {
    return {std::sqrt(squaredFrequencies(l)[0])};
  }
  if (c.startsWith("rigid_beam.zeta.")) {
    return {zeta};
  }
  if (c.startsWith("rigid_beam.ccrit.")) {  // zeta is proportional to c
    return {c.at("c") / zeta};
  }
  if (c.startsWith("rigid_beam.static.")) {
    return {zeroBetween(-1.0, 1.0, [&](double theta) {
      return system.dynamics().residualForce(vector({theta}), vector({0.0}), {})[0];
    })};
  }
  return {};
}

}  // namespace whirl_twin
