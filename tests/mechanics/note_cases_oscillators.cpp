// The two-bar linkage and the rolling disc against the lecture notes' reference numbers.
#include "note_system.h"

namespace whirl_twin {

std::vector<double> twoBarAnswers(const NoteCase& c) {
  const NoteSystem system(c, "two_bar_linkage",
                          {{"bar_mass", c.at("m")},
                           {"bar_length", c.at("l")},
                           {"force", c.at("P")},
                           {"damping", c.at("c", 0.0)}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const double rest =
      zeroBetween(-0.5, 1.6, [&](double theta) { return system.holdingForce({theta})[0]; });
  if (c.startsWith("two_bar.theta0.")) {
    return {rest};
  }
  if (c.startsWith("two_bar.p2.")) {
    return {squaredFrequencies(system.linearAt({rest}))[0]};
  }
  if (c.id == "two_bar.tan_ratio") {
    return {std::tan(rest) / (c.at("P") / (c.at("m") * c.at("g")))};
  }
  return {};
}

std::vector<double> rollingDiscAnswers(const NoteCase& c) {
  const NoteSystem system(c, "rolling_disc",
                          {{"disc_mass", c.at("m")},
                           {"disc_inertia", c.at("J")},
                           {"radius", c.at("r")},
                           {"stiffness", c.at("k")},
                           {"damping", c.at("c")}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const Linearization l = system.linearAt({0.0});
  if (c.startsWith("rolling_disc.p.")) {
    return {std::sqrt(l.stiffness(0, 0) / l.mass(0, 0))};
  }
  if (c.startsWith("rolling_disc.zeta.")) {
    return {l.damping(0, 0) / (2.0 * std::sqrt(l.stiffness(0, 0) * l.mass(0, 0)))};
  }
  return {};
}

std::vector<double> eccentricDiscAnswers(const NoteCase& c) {
  const double r = c.at("r", 1.0);
  const double disc = c.at("M", 1.0);
  const NoteSystem system(c, "rolling_disc",
                          {{"disc_mass", disc},
                           {"disc_inertia", 0.5 * disc * r * r},
                           {"radius", r},
                           {"stiffness", c.at("k", 0.0)},
                           {"damping", c.at("c", 0.0)},
                           {"offset_mass", c.at("m", 1.0)},
                           {"offset", c.at("l", 1.0)}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const auto force = [&](double x) { return system.holdingForce({x})[0]; };
  const auto stiffness = [&](double x) { return system.linearAt({x}).stiffness(0, 0); };
  const auto squaredFrequencyAt = [&](double x) {
    return squaredFrequencies(system.linearAt({x}))[0];
  };
  // After half a turn, the weight pulls away from the middle. The largest spring stiffness for
  // which it can still balance the spring is where the spring's line is tangent to the weight's
  // force: there the net force f changes with x as f / x does.
  const double stiffest =
      zeroBetween(r * M_PI, r * 1.5 * M_PI, [&](double x) { return stiffness(x) * x + force(x); });
  const auto equilibrium = [&](bool stable) {
    return stable ? zeroBetween(stiffest, 2.0 * M_PI * r, force)
                  : zeroBetween(M_PI * r, stiffest, force);
  };
  if (c.startsWith("eccentric_disc.p.")) {
    return {std::sqrt(squaredFrequencyAt(0.0))};
  }
  if (c.id == "eccentric_disc.kappa1") {  // of unit mass, offset, radius and gravity
    return {force(stiffest) / stiffest};
  }
  if (c.startsWith("eccentric_disc.eq")) {
    return {equilibrium(c.contains(".eq2"))};
  }
  if (c.startsWith("eccentric_disc.p2.eq")) {
    return {squaredFrequencyAt(equilibrium(c.contains(".eq2")))};
  }
  const auto contactForce = [&](const std::string& name) {
    return system.reaction(name, {c.at("x", 0.0)}, {c.at("x_d", 0.0)});
  };
  if (c.startsWith("eccentric_disc.Nmin.") || c.startsWith("reaction.disc.N")) {
    return {contactForce("normal_force")};
  }
  if (c.startsWith("reaction.disc.F")) {
    return {contactForce("friction_force")};
  }
  return {};
}

}  // namespace whirl_twin
