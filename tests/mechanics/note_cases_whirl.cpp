// What the models answer to the lecture notes' reference numbers on the causes of whirl: a free
// spin, fluid friction, hysteresis, gyroscopic tilt.
#include <Eigen/Dense>
#include <algorithm>
#include <complex>

#include "analysis/frequency_response.h"
#include "analysis/stability.h"
#include "note_system.h"

namespace whirl_twin {

namespace {

Eigen::MatrixXd skew(double x) {
  return (Eigen::Matrix2d() << 0.0, x, -x, 0.0).finished();
}

/// A `linear_system` of two coordinates with these matrices, about rest.
Linearization linearSystem(double mass, double damping, double gyroscopic, double stiffness,
                           double circulatory) {
  Settings settings;
  settings.matrices = {{"mass", mass * Eigen::Matrix2d::Identity()},
                       {"damping", damping * Eigen::Matrix2d::Identity()},
                       {"gyroscopic", skew(gyroscopic)},
                       {"stiffness", stiffness * Eigen::Matrix2d::Identity()},
                       {"circulatory", skew(circulatory)}};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2);
  return findModel("linear_system")
      ->setUp({}, settings, 0.0)
      .dynamics->linearization(zero, zero, zero, {});
}

bool unstable(const Linearization& l) {
  return stability(l).routh.verdict == Verdict::kUnstable;
}

/// Where a system turns unstable, or stable again, between two values of what `of` takes.
template <class Of>
double threshold(double low, double high, const Of& of) {
  return zeroBetween(low, high, [&](double x) { return unstable(of(x)) ? 1.0 : -1.0; });
}

}  // namespace

std::vector<double> freeRotorAnswers(const NoteCase& c) {
  const double m = c.at("m"), k = c.at("k"), damping = c.at("c"), e = c.at("e");
  const double torque = c.at("Tq");
  NoteCase renamed = c;  // the notes write X, Y, phi
  for (const auto& [from, to] :
       std::map<std::string, std::string>{{"X", "x"}, {"Y", "y"}, {"phi", "spin"}}) {
    for (const char* prefix : {"ic_", "at_"}) {
      for (const char* suffix : {"", "_d"}) {
        const auto found = c.given.find(prefix + from + suffix);
        if (found != c.given.end()) {
          renamed.given[prefix + to + suffix] = found->second;
        }
      }
    }
    for (const char* suffix : {"", "_d"}) {
      if (c.state == from + suffix) {
        renamed.state = to + suffix;
      }
    }
    if (c.startsWith("acc.") && c.id.substr(c.id.rfind('.') + 1) == from) {
      renamed.id = c.id.substr(0, c.id.rfind('.') + 1) + to;
    }
  }
  const NoteSystem system(renamed, "free_rotor",
                          {{"mass", m},
                           {"stiffness", k},
                           {"damping", damping},
                           {"eccentricity", e},
                           {"polar_inertia", c.at("J")},
                           {"torque", torque}});
  if (system.asksCommonQuestion()) {
    return {system.commonAnswer()};
  }
  if (c.startsWith("sommerfeld.w")) {
    // The whirl takes c w r^2 from the motor; r from the response of the lateral motion.
    const Linearization lateral = linearSystem(m, damping, 0.0, k, 0.0);
    const auto lacking = [&](double w) {
      const Eigen::Vector2cd force(m * e * w * w, std::complex<double>(0.0, -m * e * w * w));
      const double r = std::abs(steadyResponse(lateral, force, w)[0]);
      return damping * w * r * r - torque;
    };
    const double critical = std::sqrt(k / m);
    const double beyond = 1.5 * critical;  // the torque falls, then rises again
    switch (c.id[12]) {
      case '1':
        return {lacking(critical) > 0.0 ? zeroBetween(0.1 * critical, critical, lacking)
                                        : zeroBetween(beyond, 1e4 * critical, lacking)};
      case '2':
        return {zeroBetween(critical, beyond, lacking)};
      default:
        return {zeroBetween(beyond, 1e4 * critical, lacking)};
    }
  }
  return {};
}

std::vector<double> fluidWhirlAnswers(const NoteCase& c) {
  const double external = c.at("ce"), fluid = c.at("cf"), ratio = c.at("lam");
  const auto at = [&](double w) {
    return linearSystem(c.at("m"), external + fluid, 0.0, c.at("k"), ratio * fluid * w);
  };
  if (c.startsWith("whirl.fluid.wcrit.")) {
    return {threshold(1.0, 1000.0, at)};
  }
  const Stability s = stability(at(c.at("w")));
  const auto fastest =
      std::max_element(s.eigenvalues.begin(), s.eigenvalues.end(),
                       [](const auto& a, const auto& b) { return a.real() < b.real(); });
  if (c.startsWith("whirl.fluid.growth.")) {
    return {fastest->real(), -s.decay_rate};
  }
  if (c.startsWith("whirl.fluid.freq.")) {
    return {std::fabs(fastest->imag())};
  }
  return {};
}

// A loss factor eta acts above the critical speed as the circulatory stiffness eta k.
std::vector<double> hystereticWhirlAnswers(const NoteCase& c) {
  const double m = c.at("m"), k = c.at("k");
  const double enough = threshold(
      0.0, 100.0, [&](double ce) { return linearSystem(m, ce, 0.0, k, c.at("eta") * k); });
  return {(c.at("ce") - enough) * std::sqrt(k / m)};
}

std::vector<double> gyroscopicTiltAnswers(const NoteCase& c) {
  const auto at = [&](double w) {
    return linearSystem(c.at("Jd"), 0.0, c.at("Jp") * w, c.at("kt"), 0.0);
  };
  if (c.id == "whirl.gyro.top") {
    return {threshold(0.0, 1000.0, at)};
  }
  const std::vector<double> frequencies = stability(at(c.at("w"))).natural_frequencies;
  return {c.contains(".fw.") ? frequencies.back() : frequencies.front()};
}

}  // namespace whirl_twin
