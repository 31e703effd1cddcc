// The models against the lecture notes' reference numbers on the causes of whirl: a free spin,
// fluid friction, hysteresis, gyroscopic tilt.
#include <Eigen/Core>
#include <algorithm>
#include <complex>
#include <map>

#include "analysis/equilibria.h"
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

namespace {

/// X, Y, phi and their rates of the notes, in the frame rotating with the disc.
struct TurningState {
  std::vector<double> q, v;
};

TurningState turning(double x, double y, double phi, double x_rate, double y_rate, double rate) {
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  const double xi = x * c + y * s;
  const double eta = y * c - x * s;
  return {{xi, eta, phi},
          {x_rate * c + y_rate * s + rate * eta, y_rate * c - x_rate * s - rate * xi, rate}};
}

/// State `name` of the notes from that of the turning frame.
double standing(const std::string& name, const std::vector<double>& q,
                const std::vector<double>& v) {
  const double c = std::cos(q[2]);
  const double s = std::sin(q[2]);
  const double ahead = v[0] - v[2] * q[1];
  const double aside = v[1] + v[2] * q[0];
  const std::map<std::string, double> all{
      {"X", q[0] * c - q[1] * s},     {"Y", q[0] * s + q[1] * c},     {"phi", q[2]},
      {"X_d", ahead * c - aside * s}, {"Y_d", ahead * s + aside * c}, {"phi_d", v[2]}};
  return all.at(name);
}

TurningState given(const NoteCase& c, const std::string& prefix) {
  const auto value = [&](const char* name) { return c.at(prefix + name); };
  return turning(value("X"), value("Y"), value("phi"), value("X_d"), value("Y_d"), value("phi_d"));
}

}  // namespace

std::vector<double> freeRotorAnswers(const NoteCase& c) {
  const double m = c.at("m"), k = c.at("k"), damping = c.at("c"), e = c.at("e");
  const double torque = c.at("Tq");
  RunningSystem::Setup setup;
  setup.model = "free_rotor";
  setup.parameters = {{"mass", m},
                      {"stiffness", k},
                      {"damping", damping},
                      {"eccentricity", e},
                      {"polar_inertia", c.at("J")},
                      {"torque", torque}};
  const ModelInfo& model = *findModel("free_rotor");
  const auto rotor = model.setUp(completed(model, setup.parameters), {}, 0.0).dynamics;
  if (c.startsWith("traj.")) {
    const TurningState start = given(c, "ic_");
    setup.q = start.q;
    setup.v = start.v;
    RunningSystem system(setup, "gauss_legendre_6", 1000000);
    system.run(std::lround(c.time * 1000.0));
    return {standing(c.state, {system.q(0), system.q(1), system.q(2)},
                     {system.v(0), system.v(1), system.v(2)})};
  }
  if (c.startsWith("acc.") && c.id.substr(c.id.rfind('.') + 1) == "phi") {
    const TurningState at = given(c, "at_");
    return {rotor->acceleration(vector(at.q), vector(at.v), {})[2]};
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
    const char root = c.id[12];
    const bool captured = lacking(critical) > 0.0;
    const double w = root == '1' && captured ? zeroBetween(0.1 * critical, critical, lacking)
                     : root == '2'           ? zeroBetween(critical, beyond, lacking)
                                             : zeroBetween(beyond, 1e4 * critical, lacking);
    // The same as a steady motion of the whole, with its verdict.
    const auto steady = operatingPoint(*rotor, vector({0.0, 0.0, 0.0}), vector({0.0, 0.0, w}), 0.0);
    return root == '2' || !steady ? std::vector<double>{w} : std::vector<double>{w, steady->v[2]};
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
