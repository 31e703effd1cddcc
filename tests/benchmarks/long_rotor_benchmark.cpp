// What `twin analyze`, `twin campbell` and `twin response` make of a shaft of 18, 24, 48 and 96
// elements with all its coordinates, beside Eigen's dense solution (EigenSolver, values and
// vectors) of a full matrix of the shaft's state in the same run. CPU time of one thread.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <string>

#include "reports/campbell_report.h"
#include "reports/method_analysis.h"
#include "reports/response_report.h"
#include "reports/system_analysis.h"
#include "scene/scene_reader.h"

namespace whirl_twin {
namespace {

/// 1.5 m between two isotropic, damped bearings, with a disc at a third.
BuiltScene shaft(int elements) {
  const std::string text = fmt::format(
      R"(
step: 1.0e-3
drives: {{shaft: {{speed: 400.0}}}}
systems:
  rotor:
    model: flexible_rotor
    drive: shaft
    parameters:
      elements: [{{count: {0}, length: {1}, outer_diameter: 0.05}}]
      youngs_modulus: 2.11e11
      shear_modulus: 8.12e10
      density: 7810.0
      modes: 0
      discs: [{{node: {2}, mass: 32.0, transverse_inertia: 0.178, polar_inertia: 0.329}}]
      bearings: [{{node: 0, kxx: 1e6, kyy: 1e6, cxx: 100, cyy: 100}},
                 {{node: {0}, kxx: 1e6, kyy: 1e6, cxx: 100, cyy: 100}}]
      unbalances: [{{node: {2}, magnitude: 1.0e-4, angle: 0.0}}]
)",
      elements, 1.5 / elements, elements / 3);
  return build(readScene(YAML::Load(text), "benchmark"));
}

void analyzes(benchmark::State& state) {
  const BuiltScene scene = shaft(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const SystemAnalysis analysis = analyze(scene, 0);
    const MethodAnalysis methods = analyzeMethods(*scene.systems[0], analysis);
    benchmark::DoNotOptimize(text(analysis) + text(methods, analysis));
  }
}

void draws200SpeedsOfACampbellDiagram(benchmark::State& state) {
  const BuiltScene scene = shaft(static_cast<int>(state.range(0)));
  const RotorSystem rotor = rotorSystems(scene, std::nullopt).front();
  for (auto _ : state) {
    benchmark::DoNotOptimize(campbellReport(rotor, {0.0, 1000.0, 200}, {1.0}, 12));
  }
}

void responds(benchmark::State& state) {
  const BuiltScene scene = shaft(static_cast<int>(state.range(0)));
  const RotorSystem rotor = rotorSystems(scene, std::nullopt).front();
  for (auto _ : state) {
    benchmark::DoNotOptimize(responseReport(rotor, {10.0, 1000.0, 200}, std::nullopt));
  }
}

void solvesDensely(benchmark::State& state) {
  const Eigen::Index size = 8 * (state.range(0) + 1);
  const Eigen::MatrixXd full = Eigen::MatrixXd::Random(size, size);
  for (auto _ : state) {
    benchmark::DoNotOptimize(Eigen::EigenSolver<Eigen::MatrixXd>(full).eigenvectors().sum());
  }
}

void sizes(benchmark::internal::Benchmark* of) {
  of->Arg(18)->Arg(24)->Arg(48)->Arg(96)->Unit(benchmark::kMillisecond);
}

BENCHMARK(solvesDensely)->Apply(sizes);
BENCHMARK(analyzes)->Apply(sizes);
BENCHMARK(draws200SpeedsOfACampbellDiagram)->Apply(sizes);
BENCHMARK(responds)->Apply(sizes);

}  // namespace
}  // namespace whirl_twin

BENCHMARK_MAIN();
