// Cost of long rotors: analysis and run-up of shafts of 18, 24, 48 and 96 elements with all their
// coordinates; compared with dense matrices at one speed after another, as in general programs
// (Eigen), and with ROSS where that was measured. CPU time of one thread, the minimum of several
// interleaved rounds.
#include <fmt/format.h>
#include <sys/resource.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "reports/campbell_report.h"
#include "reports/modes_report.h"
#include "reports/response_report.h"
#include "reports/system_analysis.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr int kSpeeds = 200;
constexpr double kLowest = 10.0, kHighest = 1000.0;  // rad/s, of diagram and response
constexpr double kRunUp = 10.0;                      // s
constexpr double kStep = 1.0e-3;                     // s, of the twin
constexpr double kNewmarkStep = 2.0e-4;              // s

double cpuSeconds() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1.0e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/// 1.5 m between two isotropic, damped bearings, with a disc at a third. It runs up to 400 rad/s,
/// through its first critical speeds, in kRunUp.
BuiltScene shaft(int elements, const std::string& modes, const std::string& drive) {
  const std::string text = fmt::format(
      R"(
step: {3}
drives: {{shaft: {5}}}
systems:
  rotor:
    model: flexible_rotor
    drive: shaft
    parameters:
      elements: [{{count: {0}, length: {1}, outer_diameter: 0.05}}]
      youngs_modulus: 2.11e11
      shear_modulus: 8.12e10
      density: 7810.0
      modes: {4}
      discs: [{{node: {2}, mass: 32.0, transverse_inertia: 0.178, polar_inertia: 0.329}}]
      bearings: [{{node: 0, kxx: 1e6, kyy: 1e6, cxx: 100, cyy: 100}},
                 {{node: {0}, kxx: 1e6, kyy: 1e6, cxx: 100, cyy: 100}}]
      unbalances: [{{node: {2}, magnitude: 1.0e-4, angle: 0.0}}]
)",
      elements, 1.5 / elements, elements / 3, kStep, modes, drive);
  return build(readScene(YAML::Load(text), "benchmark"));
}

BuiltScene wholeShaft(int elements) {
  return shaft(elements, "0", "{speed: 400.0}");
}

BuiltScene runUp(int elements) {
  return shaft(elements, "auto",
               fmt::format("{{speed: 0.0, profile: [{{speed: 400.0, max_acceleration: {}}}]}}",
                           400.0 / kRunUp));
}

/// Of M q'' + (C + G) q' + (K + N) q = 0.
Eigen::MatrixXd stateMatrix(const Linearization& l) {
  const Eigen::Index n = l.mass.rows();
  const Eigen::PartialPivLU<Eigen::MatrixXd> mass(l.mass);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -mass.solve(l.stiffness + l.circulatory);
  a.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  return a;
}

double denseModes(const LinearRotor& rotor) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(stateMatrix(rotor.matrices(kHighest)))
      .eigenvectors()
      .norm();
}

double denseResponse(const LinearRotor& rotor, double speed) {
  const Linearization l = rotor.matrices(speed);
  const Eigen::MatrixXcd d =
      (l.stiffness + l.circulatory - speed * speed * l.mass).cast<std::complex<double>>() +
      std::complex<double>(0.0, speed) * (l.damping + l.gyroscopic);
  return d.partialPivLu().solve(rotor.synchronousForce(speed)).norm();
}

/// Newmark's mean acceleration, the matrix of the step new at each, as the speed is.
double newmarkStep(const LinearRotor& rotor, double speed) {
  const Linearization l = rotor.matrices(speed);
  const double h = kNewmarkStep;
  const Eigen::MatrixXd a =
      l.mass + 0.5 * h * (l.damping + l.gyroscopic) + 0.25 * h * h * (l.stiffness + l.circulatory);
  return a.partialPivLu().solve(rotor.shaftForce(0.1, speed, 40.0)).norm();
}

double sum = 0.0;  // prevents elimination by the compiler

struct Task {
  std::string name;
  std::function<void()> run;
  double times = 1.0;  ///< that it is done in all
  double least = std::numeric_limits<double>::infinity();

  double seconds() const { return times * least; }
};

struct Size {
  int elements;
  double ross_modal;  ///< [s]; 0: not measured
  BuiltScene whole, run_up;
  std::vector<Task> ours, dense;
};

void addTasks(Size& size, bool dense) {
  const BuiltScene& whole = size.whole;
  const BuiltScene& run_up = size.run_up;
  const auto rotor = [&whole] { return rotorSystems(whole, std::nullopt).front(); };
  size.ours = {
      {"`twin analyze`",
       [&whole] {
         const SystemAnalysis analysis = analyze(whole, 0);
         const MethodAnalysis methods = analyzeMethods(*whole.systems[0], analysis);
         sum += static_cast<double>((text(analysis) + text(methods, analysis)).size());
       }},
      {"modes at one speed",
       [rotor] {
         const RotorSystem system = rotor();
         sum += static_cast<double>(modesReport(system, kHighest).model.size());
       }},
      {"Campbell diagram",
       [rotor] {
         const RotorSystem system = rotor();
         sum += static_cast<double>(
             campbellReport(system, {0.0, kHighest, kSpeeds}, {1.0}, 12).diagram.speeds.size());
       }},
      {"unbalance response",
       [rotor] {
         const RotorSystem system = rotor();
         sum += responseReport(system, {kLowest, kHighest, kSpeeds}, std::nullopt).sweep[0].speed;
       }},
      {"run-up", [&run_up] {
         Twin twin(run_up);
         for (int i = 0; i < static_cast<int>(kRunUp / kStep); ++i) {
           twin.step();
         }
         sum += static_cast<double>(twin.stepCount());
       }}};
  if (!dense) {
    return;
  }
  const LinearRotor linear = whole.systems[0]->dynamics->linearRotor();
  const auto modal = [linear] { sum += denseModes(linear); };
  size.dense = {{"dense solution", modal},
                {"", modal},
                {"", modal, kSpeeds},
                {"", [linear] { sum += denseResponse(linear, 500.0); }, kSpeeds},
                {"", [linear] { sum += newmarkStep(linear, 200.0); }, kRunUp / kNewmarkStep}};
}

void take(Task& task) {
  const double start = cpuSeconds();
  int done = 0;
  do {  // until the clock's resolution is negligible
    task.run();
    ++done;
  } while (cpuSeconds() - start < 0.02);
  task.least = std::min(task.least, (cpuSeconds() - start) / done);
}

void print(const std::vector<Size>& sizes) {
  fmt::print(
      "| elements | | whirl_twin, s | dense, one speed at a time, s | ratio | ROSS, s |\n"
      "|---|---|---|---|---|---|\n");
  for (const Size& size : sizes) {
    for (std::size_t i = 0; i < size.ours.size(); ++i) {
      const Task& ours = size.ours[i];
      std::string dense;
      std::string ratio;
      if (!size.dense.empty()) {
        dense = fmt::format("{:.3g}", size.dense[i].seconds());
        if (i > 0) {  // the first is one dense solution, to compare with
          ratio = fmt::format("{:.3g}", size.dense[i].seconds() / ours.seconds());
        }
      }
      const std::string ross =
          i == 1 && size.ross_modal > 0.0 ? fmt::format("{:g}", size.ross_modal) : "";
      fmt::print("| {} | {} | {:.3g} | {} | {} | {} |\n", size.elements, ours.name, ours.seconds(),
                 dense, ratio, ross);
    }
  }
  const auto of = [&](int elements) -> const Size& {
    return *std::find_if(sizes.begin(), sizes.end(),
                         [elements](const Size& s) { return s.elements == elements; });
  };
  const double solution = of(48).dense[0].seconds();
  fmt::print(
      "\nWith 48 elements, 196 coordinates, `twin analyze` takes as long as {:.2g} dense solutions "
      "of the "
      "same run and a Campbell diagram of {} speeds as long as {:.2g}. From 24 to 96 elements the "
      "time of "
      "`twin analyze` grows by a factor of {:.2g}, that of the diagram by {:.2g}.\n",
      of(48).ours[0].seconds() / solution, kSpeeds, of(48).ours[2].seconds() / solution,
      of(96).ours[0].seconds() / of(24).ours[0].seconds(),
      of(96).ours[2].seconds() / of(24).ours[2].seconds());
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  using whirl_twin::Size;
  const int rounds = argc > 1 && std::string(argv[1]) == "--quick" ? 1 : 5;
  std::vector<Size> sizes;
  // ROSS 2.3.0 on a machine of this kind, Debian's NumPy with its reference BLAS: run_modal,
  // including the construction of the rotor.
  for (const auto& [elements, ross] :
       {std::pair{18, 0.29}, std::pair{24, 0.0}, std::pair{48, 16.0}, std::pair{96, 0.0}}) {
    sizes.push_back(
        {elements, ross, whirl_twin::wholeShaft(elements), whirl_twin::runUp(elements), {}, {}});
  }
  for (Size& size : sizes) {
    whirl_twin::addTasks(size, size.elements == 18 || size.elements == 48);
  }
  for (int round = 0; round < rounds; ++round) {
    for (Size& size : sizes) {
      for (std::size_t i = 0; i < size.ours.size(); ++i) {
        whirl_twin::take(size.ours[i]);
        if (!size.dense.empty()) {
          whirl_twin::take(size.dense[i]);
        }
      }
    }
  }
  whirl_twin::print(sizes);
  return whirl_twin::sum == 0.0 ? 1 : 0;
}
