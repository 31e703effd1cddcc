// The double pendulum, and the spinning pendulum beyond its bifurcation.
#include <fmt/format.h>

#include "equations.h"
#include "peers.h"
#include "reference.h"
#include "scene.h"
#include "twin_contender.h"
#ifdef WHIRL_TWIN_PEER_MUJOCO
#include "mujoco_peer.h"
#endif

namespace whirl_twin::comparison {

ComparedScene doublePendulumScene() {
  constexpr double kUpper = 0.2;
  constexpr double kLower = 0.3;
  ComparedScene scene;
  scene.name = "Double pendulum";
  scene.description = "unit masses and lengths, released at (0.2, 0.3) rad";
  scene.output = {0.24, 420, 2};
  scene.positions = {0, 1};
  Problem<DoublePendulumEquations> problem{{}, {kUpper, kLower, 0.0, 0.0}, scene.output, 1.0};
  scene.reference = fineReference(problem, 120);
  problem.amplitude = amplitude(scene.reference, scene.output, scene.positions);
  addTwin(fmt::format("gravity: {}\n"
                      "systems:\n"
                      "  pendulum:\n"
                      "    model: double_pendulum\n"
                      "    parameters: {{mass1: 1.0, mass2: 1.0, length1: 1.0, length2: 1.0}}\n"
                      "    initial: {{theta1: {}, theta2: {}}}\n",
                      DoublePendulumEquations::kGravity, kUpper, kLower),
          scene.output, scene.contenders);
  addPeers(problem, scene.contenders);
#ifdef WHIRL_TWIN_PEER_MUJOCO
  addMujoco(kUpper, kLower, scene.output, scene.contenders);
#endif
  return scene;
}

ComparedScene spinningPendulumScene() {
  constexpr double kStart = 0.2;
  ComparedScene scene;
  scene.name = "Spinning pendulum";
  scene.description = "at 1.5 times the speed of its bifurcation, from 0.2 rad, undamped";
  scene.output = {0.24, 420, 1};
  scene.positions = {0};
  Problem<SpinningPendulumEquations> problem{{}, {kStart, 0.0}, scene.output, 1.0};
  scene.reference = fineReference(problem, 120);
  problem.amplitude = amplitude(scene.reference, scene.output, scene.positions);
  addTwin(
      fmt::format("gravity: {}\n"
                  "drives: {{shaft: {{speed: {}}}}}\n"
                  "systems:\n"
                  "  pendulum:\n"
                  "    model: spinning_pendulum\n"
                  "    drive: shaft\n"
                  "    parameters: {{mass: 1.0, length: 1.0}}\n"
                  "    initial: {{theta: {}}}\n",
                  SpinningPendulumEquations::kGravity, SpinningPendulumEquations::kSpeed, kStart),
      scene.output, scene.contenders);
  addPeers(problem, scene.contenders);
  return scene;
}

}  // namespace whirl_twin::comparison
