// Cost of a rotor step: a shaft of 40 coordinates at constant speed and in a run-up, full-order and
// with eight modes; for comparison the Jeffcott rotor with more and more effects.
#include <benchmark/benchmark.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "twin/stop_text.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr const char* kConstant = "speed: 100.0";
constexpr const char* kRunUp =
    "speed: 0.0, profile: [{speed: 300.0, max_acceleration: 20.0, dwell: 0.0}]";

/// Steps a twin, and starts it again before the run-up ends.
void steps(benchmark::State& state, const std::string& text) {
  const DenormalsToZero denormals_to_zero;
  Twin twin(readScene(YAML::Load(text), "benchmark"));
  for (auto _ : state) {
    twin.step();
    if (twin.stepCount() == 14000) {
      twin.reset();
    }
  }
  if (twin.status(0) != StepStatus::kOk) {
    state.SkipWithError(describe(twin.status(0)));
  }
}

std::string scene(const std::string& drive, const std::string& model,
                  const std::string& parameters) {
  return "step: 0.001\ndrives: {shaft: {" + drive + "}}\nsystems:\n  rotor: {model: " + model +
         ", drive: shaft, parameters: {" + parameters + "}}\n";
}

/// Ten nodes of four coordinates: two discs, damped bearings.
std::string shaft(const std::string& modes) {
  return "youngs_modulus: 211.0e+9, density: 7810.0, "
         "elements: [{length: 0.1666666, outer_diameter: 0.05, count: 9}], "
         "discs: [{node: 3, mass: 32.59, polar_inertia: 0.3296, transverse_inertia: 0.1781}, "
         "{node: 6, mass: 51.53, polar_inertia: 0.8051, transverse_inertia: 0.4236}], "
         "bearings: [{node: 0, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 100.0, cyy: 100.0}, "
         "{node: 9, kxx: 1.0e+6, kyy: 0.8e+6, cxx: 100.0, cyy: 100.0}], "
         "unbalances: [{node: 3, magnitude: 0.001}], highest_speed: 300.0, modes: " +
         modes;
}

void add(const std::string& name, const std::string& text) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [text](benchmark::State& state) { steps(state, text); });
}

void addAll() {
  for (const auto& [drive_name, drive] :
       {std::pair{"constant_speed", kConstant}, std::pair{"run_up", kRunUp}}) {
    const std::string name = drive_name;
    add("shaft_40_coordinates/" + name, scene(drive, "flexible_rotor", shaft("0")));
    add("shaft_8_shapes/" + name, scene(drive, "flexible_rotor", shaft("8")));
    const std::string jeffcott =
        "mass: 2.0, stiffness: 18000.0, damping: 12.0, eccentricity: 1.0e-4";
    add("jeffcott/" + name, scene(drive, "jeffcott_rotor", jeffcott));
    add("jeffcott_internal_damping/" + name,
        scene(drive, "jeffcott_rotor", jeffcott + ", internal_damping: 2.0"));
    add("jeffcott_hysteresis/" + name,
        scene(drive, "jeffcott_rotor", jeffcott + ", loss_factor: 0.01"));
  }
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
