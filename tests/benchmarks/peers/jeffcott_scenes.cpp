// The Jeffcott rotor at constant speed, and run up through its critical speed.
#include <fmt/format.h>

#include <complex>

#include "equations.h"
#include "peers.h"
#include "reference.h"
#include "scene.h"
#include "twin_contender.h"

namespace whirl_twin::comparison {
namespace {

using Rotor = JeffcottEquations;

/// Mass 1 kg.
std::string jeffcottText(const std::string& drive) {
  return fmt::format(
      "drives: {{shaft: {{{}}}}}\n"
      "systems:\n"
      "  rotor:\n"
      "    model: jeffcott_rotor\n"
      "    drive: shaft\n"
      "    parameters: {{mass: 1.0, stiffness: {}, damping: {}, eccentricity: {}}}\n",
      drive, Rotor::kRate * Rotor::kRate, Rotor::kDamping, Rotor::kEccentricity);
}

/// From rest: z = Z e^(i w t) + A1 e^(s1 t) + A2 e^(s2 t).
Reference closedForm(const Output& output) {
  using Complex = std::complex<long double>;
  const Complex i(0.0L, 1.0L);
  const long double p = Rotor::kRate;
  const long double half_damping = 0.5L * static_cast<long double>(Rotor::kDamping);
  const long double w = Rotor::kSpeed;
  const Complex forced = static_cast<long double>(Rotor::kEccentricity) * w * w /
                         (p * p - w * w + 2.0L * i * half_damping * w);
  const Complex s1 = -half_damping + i * std::sqrt(p * p - half_damping * half_damping);
  const Complex s2 = std::conj(s1);
  const Complex a2 = (i * w - s1) * forced / (s1 - s2);
  const Complex a1 = -forced - a2;
  Reference reference{"closed form", {}, 1.0e-16};
  for (std::size_t sample = 0; sample < output.samples; ++sample) {
    const auto t = static_cast<long double>(output.time(sample));
    const Complex z = forced * std::exp(i * w * t) + a1 * std::exp(s1 * t) + a2 * std::exp(s2 * t);
    reference.coordinates.push_back(static_cast<double>(z.real()));
    reference.coordinates.push_back(static_cast<double>(z.imag()));
  }
  return reference;
}

}  // namespace

ComparedScene jeffcottScene() {
  ComparedScene scene;
  scene.name = "Jeffcott rotor, constant speed";
  scene.description = "damping ratio 0.05, at 0.8 of the critical speed, from rest";
  scene.output = {0.024, 4200, 2};
  scene.positions = {0, 1};
  scene.reference = closedForm(scene.output);
  Problem<JeffcottEquations> problem{{}, {}, scene.output, 1.0};
  problem.amplitude = amplitude(scene.reference, scene.output, scene.positions);
  addTwin(jeffcottText(fmt::format("speed: {}", Rotor::kSpeed)), scene.output, scene.contenders);
  addPeers(problem, scene.contenders);
  return scene;
}

ComparedScene runUpScene() {
  ComparedScene scene;
  scene.name = "Jeffcott rotor, run-up";
  scene.description = "the same rotor from standstill to twice its critical speed in 20 s";
  scene.output = {0.024, 840, 2};
  scene.positions = {0, 1};
  Problem<RunUpEquations> problem{{}, {}, scene.output, 1.0};
  scene.reference = fineReference(problem, 120);
  problem.amplitude = amplitude(scene.reference, scene.output, scene.positions);
  // The ramp continues beyond the horizon: no breakpoint within it.
  addTwin(jeffcottText(fmt::format("speed: 0.0, profile: [{{speed: 300.0, max_acceleration: {}, "
                                   "dwell: 0.0}}]",
                                   RunUpEquations::kAcceleration)),
          scene.output, scene.contenders);
  addPeers(problem, scene.contenders);
  return scene;
}

}  // namespace whirl_twin::comparison
