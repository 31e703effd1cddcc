// Cost of a step of every system of every shipped scene, with the implicit and the explicit method
// that suit all of them, and with the choice of `auto`.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "accuracy/step_choice.h"
#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "twin/stop_text.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

void steps(benchmark::State& state, Scene scene, const std::string& integrator) {
  scene.systems.front().integrator = integrator;
  const DenormalsToZero denormals_to_zero;
  Twin twin(withStepsChosen(scene));
  for (auto _ : state) {
    twin.step();
    // Restarts before a motion has decayed or rotated too far.
    if (twin.stepCount() == 20000) {
      twin.reset();
    }
  }
  if (twin.status(0) != StepStatus::kOk) {
    state.SkipWithError(describe(twin.status(0)));
  }
}

void addScenes() {
  for (const auto& file : std::filesystem::directory_iterator(WHIRL_TWIN_SCENES)) {
    const Scene scene = readSceneFile(file.path());
    if (!scene.controllers.empty()) {
      continue;  // systems coupled to others; see controller_sample_benchmark
    }
    for (const SystemSpec& system : scene.systems) {
      Scene one = scene;
      one.systems = {system};
      for (const char* integrator : {"gauss_legendre_6", "runge_kutta_4", "auto"}) {
        benchmark::RegisterBenchmark(
            (scene.name + "/" + system.name + "/" + integrator).c_str(),
            [one, integrator](benchmark::State& state) { steps(state, one, integrator); });
      }
    }
  }
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  whirl_twin::addScenes();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
