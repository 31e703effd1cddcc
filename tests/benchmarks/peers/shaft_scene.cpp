// A shaft on two damped bearings with two discs: ten nodes of four coordinates, and natural
// frequencies from 83 to 115 620 rad/s.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/LU>
#include <complex>
#include <unsupported/Eigen/MatrixFunctions>

#include "peers.h"
#include "reference.h"
#include "scene.h"
#include "scene/scene_reader.h"
#include "shaft_equations.h"
#include "twin/twin.h"
#include "twin_contender.h"

namespace whirl_twin::comparison {
namespace {

constexpr double kSpeed = 100.0;  // [rad/s]

std::string shaftText() {
  return fmt::format(
      "drives: {{shaft: {{speed: {}}}}}\n"
      "systems:\n"
      "  rotor:\n"
      "    model: flexible_rotor\n"
      "    drive: shaft\n"
      "    parameters:\n"
      "      youngs_modulus: 211.0e+9\n"
      "      density: 7810.0\n"
      "      elements: [{{length: 0.1666666, outer_diameter: 0.05, count: 9}}]\n"
      "      discs:\n"
      "        - {{node: 3, mass: 32.59, polar_inertia: 0.3296, transverse_inertia: 0.1781}}\n"
      "        - {{node: 6, mass: 51.53, polar_inertia: 0.8051, transverse_inertia: 0.4236}}\n"
      "      bearings:\n"
      "        - {{node: 0, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 100.0, cyy: 100.0}}\n"
      "        - {{node: 9, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 100.0, cyy: 100.0}}\n"
      "      unbalances: [{{node: 3, magnitude: 0.001}}]\n"
      "      highest_speed: 300.0\n"
      "      modes: 0\n",
      kSpeed);
}

/// From rest: the forced whirl, and the free motion that cancels it at the start, propagated by
/// e^(A t) from sample to sample. Repeated with e^(A t / 2)^2; the difference is the error bound.
Reference closedForm(const ShaftMatrices& matrices, const Output& output) {
  using Complex = std::complex<long double>;
  using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Eigen::Index n = matrices.by_q.rows();
  const long double w = kSpeed;
  const long double rate = 1.0e5L;  // scale of the fastest rates: keeps the exponential exact
  const Complex i(0.0L, 1.0L);

  const ComplexMatrix dynamic_stiffness = -matrices.by_q.cast<Complex>() -
                                          i * w * matrices.by_v.cast<Complex>() -
                                          w * w * ComplexMatrix::Identity(n, n);
  const LongComplexVector whirl = dynamic_stiffness.partialPivLu().solve(matrices.forced);
  LongMatrix a = LongMatrix::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).diagonal().setConstant(rate);
  a.bottomLeftCorner(n, n) = matrices.by_q / rate;
  a.bottomRightCorner(n, n) = matrices.by_v;

  const auto motion = [&](int parts) {
    const LongMatrix part =
        (a * (static_cast<long double>(output.interval) / static_cast<long double>(parts))).exp();
    LongVector x(2 * n);
    x << -whirl.real(), -(i * w * whirl).real() / rate;
    std::vector<double> all;
    for (std::size_t sample = 0; sample < output.samples; ++sample) {
      for (int k = 0; k < parts; ++k) {
        x = (part * x).eval();
      }
      const Complex turned = std::exp(i * w * static_cast<long double>(output.time(sample)));
      const LongVector q = x.head(n) + (turned * whirl).real();
      for (Eigen::Index k = 0; k < n; ++k) {
        all.push_back(static_cast<double>(q[k]));
      }
    }
    return all;
  };
  Reference reference{"closed form", motion(1), 0.0};
  const std::vector<double> again = motion(2);
  double largest = 0.0;
  for (std::size_t k = 0; k < again.size(); ++k) {
    reference.error = std::max(reference.error, std::abs(again[k] - reference.coordinates[k]));
    largest = std::max(largest, std::abs(again[k]));
  }
  reference.error /= largest;
  return reference;
}

}  // namespace

ComparedScene shaftScene() {
  ComparedScene scene;
  scene.name = "Shaft of 40 coordinates";
  scene.description = "two discs, damped bearings, at constant speed, from rest";
  scene.output = {0.006, 84, ShaftEquations::kCoordinates};

  YAML::Node tree = YAML::Load(shaftText());
  tree["step"] = 0.001;
  const Twin twin(readScene(tree, "benchmark"));
  const Dynamics& dynamics = *twin.systems()[0]->dynamics;
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!coordinates[i].isAngle()) {
      scene.positions.push_back(i);
    }
  }
  const LinearRotor rotor = dynamics.linearRotor();
  scene.reference = closedForm(shaftMatrices(rotor, kSpeed), scene.output);
  Problem<ShaftEquations> problem{ShaftEquations(rotor, kSpeed), {}, scene.output, 1.0};
  problem.amplitude = amplitude(scene.reference, scene.output, scene.positions);
  addTwin(shaftText(), scene.output, scene.contenders);
  addPeers(problem, scene.contenders);
  return scene;
}

}  // namespace whirl_twin::comparison
