// The plank on two rollers against the lecture notes' reference numbers: exact sliding, and the
// regularized friction where a case gives its width.
#include "note_system.h"

namespace whirl_twin {

namespace {

NoteSystem plank(const NoteCase& c, double mu, double width) {
  return {c,
          "friction_oscillator",
          {{"mass", c.at("m", 1.0)},
           {"friction_coefficient", mu},
           {"half_spacing", c.at("a")},
           {"height", c.at("h")},
           {"roller_speed", c.at("vs", 1.0)},
           {"regularization", width}},
          choice("friction", "sliding")};
}

/// Coefficient of x' where the friction coefficient is mu at the rollers' speed of 1 m/s and rises
/// by mu' per m/s of slip. The regularised law mu0 tanh(v / width) passes through any such point.
double slopeDamping(const NoteCase& c) {
  const double mu = c.at("mu");
  const auto slope = [&](double width) {  // of the law that is mu at 1 m/s
    const double t = std::tanh(1.0 / width);
    return mu / t * (1.0 - t * t) / width;
  };
  const double width =
      zeroBetween(0.1, 100.0, [&](double w) { return slope(w) - c.at("mu_prime"); });
  const Linearization l = plank(c, mu / std::tanh(1.0 / width), width).linearAt({0.0});
  return l.damping(0, 0) / l.mass(0, 0);
}

}  // namespace

std::vector<double> frictionAnswers(const NoteCase& given) {
  NoteCase c = given;
  if (c.startsWith("friction.shm.")) {  // a motion from rest at x0
    c.time = c.contains(".t10") ? 10.0 : 1.0;
    c.id = "traj." + c.id;
    c.state = "x";
    c.given["ic_x"] = c.at("x0");
  }
  if (c.startsWith("friction.damp.")) {
    return {slopeDamping(c)};
  }
  const NoteSystem system = plank(c, c.at("mu"), c.at("eps", 0.0));
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  const double p = std::sqrt(squaredFrequencies(system.linearAt({0.0}))[0]);
  if (c.startsWith("friction.f.")) {
    return {p / (2.0 * M_PI)};
  }
  if (c.startsWith("friction.p.")) {
    return {p};
  }
  if (c.id == "friction.xmax") {
    return {zeroBetween(0.0, c.at("a"),
                        [&](double x) { return system.margin("contact", {x}, {0.0}); })};
  }
  if (c.id == "friction.limit_amp") {  // the plank is fastest as it passes the middle
    return {zeroBetween(0.0, 10.0, [&](double v) { return system.margin("sliding", {0.0}, {v}); }) /
            p};
  }
  if (c.id == "friction.R1" || c.id == "friction.R2") {
    return {system.reaction(c.id == "friction.R1" ? "normal_force_left" : "normal_force_right",
                            {c.at("x")}, {0.0})};
  }
  return {};
}

}  // namespace whirl_twin
