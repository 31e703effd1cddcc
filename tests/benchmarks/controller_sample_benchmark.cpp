// Cost of a controller sample: a step of a linear system with one sample of a controller, compared
// with the same step with a constant force. And a loop of 20 kHz around a shaft on magnetic
// bearings with eight modes: its real-time factor on one core.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <chrono>
#include <string>

#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "twin/stop_text.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

void steps(benchmark::State& state, const std::string& text) {
  const DenormalsToZero denormals_to_zero;
  Twin twin(readScene(YAML::Load(text), "benchmark"));
  const auto begun = std::chrono::steady_clock::now();
  for (auto _ : state) {
    twin.step();
  }
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  state.counters["real_time_factor"] =
      static_cast<double>(state.iterations()) * twin.scene().stepSeconds() / wall;
  if (twin.status(0) != StepStatus::kOk) {
    state.SkipWithError(describe(twin.status(0)));
  }
}

/// One mass on a spring, or four in a chain: eight states.
std::string plant(bool chain, const std::string& more) {
  const std::string parameters =
      chain
          ? "names: [a, b, c, d], mass: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "
            "damping: [[0.2, -0.1, 0, 0], [-0.1, 0.2, -0.1, 0], [0, -0.1, 0.2, -0.1], [0, 0, "
            "-0.1, 0.2]], stiffness: [[20, -10, 0, 0], [-10, 20, -10, 0], [0, -10, 20, -10], [0, "
            "0, -10, 20]]"
          : "names: [a], mass: [[1]], damping: [[0.1]], stiffness: [[10]]";
  return "{step: 0.001, systems: {s: {model: linear_system, parameters: {" + parameters +
         "}, initial: {a: 0.1}" + more + "}}";
}

std::string heldForce(bool chain) {
  return plant(chain, ", inputs: {force_a: 0.1}") + "}";
}

std::string controlled(bool chain, const std::string& law) {
  return plant(chain, "") +
         ", controllers: {law: {rate: 1000.0, measures: [s.a], acts_on: [s.force_a], delay: 0.001, "
         "sensor: {noise: 1.0e-4, resolution: 1.0e-5, range: 1.0, bandwidth: 400.0}, actuator: "
         "{limit: 5.0, slew: 1.0e3, resolution: 1.0e-3}, " +
         law + "}}}";
}

constexpr const char* kPid =
    "type: pid, parameters: {kp: 3.0, ki: 1.0, kd: 0.2, derivative_time: 0.005}";
constexpr const char* kLqg =
    "type: lqg, parameters: {q: [1, 1, 1, 1, 1, 1, 1, 1], r: [1], process_noise: [1, 1, 1, 1, 1, "
    "1, "
    "1, 1], sensor_noise: [1.0e-4]}";

std::string levitation() {
  return "{step: 0.001, drives: {shaft: {speed: 600.0}}, systems: {rotor: {model: flexible_rotor, "
         "drive: shaft, parameters: {youngs_modulus: 2.1e11, density: 7800.0, internal_damping: "
         "1.0e-5, elements: [{length: 0.1, outer_diameter: 0.025, count: 8}], discs: [{node: 4, "
         "mass: 4.0, polar_inertia: 0.02, transverse_inertia: 0.011}], magnets: [{node: 1, ki: "
         "100.0, ks: 2.0e5}, {node: 7, ki: 100.0, ks: 2.0e5}], unbalances: [{node: 4, magnitude: "
         "2.0e-5}], modes: 8, stations: [{node: 1}, {node: 7}]}}}, controllers: {magnets: {type: "
         "pid, rate: 20000.0, measures: [rotor.node_1.x, rotor.node_1.y, rotor.node_7.x, "
         "rotor.node_7.y], acts_on: [rotor.current_x_1, rotor.current_y_1, rotor.current_x_7, "
         "rotor.current_y_7], delay: 5.0e-5, sensor: {resolution: 1.0e-7, noise: 2.0e-7, range: "
         "4.0e-4}, actuator: {limit: 4.0}, parameters: {kp: 6.0e3, ki: 2.0e4, kd: 6.0, "
         "derivative_time: 1.0e-4}}}}";
}

void addAll() {
  const auto add = [](const char* name, const std::string& text) {
    benchmark::RegisterBenchmark(name, [text](benchmark::State& state) { steps(state, text); });
  };
  add("one_mass/held_force", heldForce(false));
  add("one_mass/pid", controlled(false, kPid));
  add("four_masses/held_force", heldForce(true));
  add("four_masses/lqg_of_8_states", controlled(true, kLqg));
  add("levitation_20_kHz", levitation());
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  whirl_twin::addAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
