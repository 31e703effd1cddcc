// Cost of a step of the whole twin as a function of the number of its systems: rotors of a scene,
// rotors of an ensemble, double pendulums of an ensemble.
#include <fmt/format.h>
#include <malloc.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "realtime/denormals.h"
#include "reports/drawings.h"
#include "scene/scene_reader.h"
#include "step_costs.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr double kStepNanoseconds = 1.0e6;
constexpr double kPixelsOfLine = 1.8;

struct Measurement {
  std::size_t number;
  StepCost cost;
  double bytes;
};

/// One kind of twin, of any number of systems.
struct Kind {
  std::string name;
  Scene (*scene)(std::size_t number);
  std::size_t largest;
  Ink ink;
  std::vector<Measurement> measured = {};
};

Scene read(const std::string& systems) {
  return readScene(
      YAML::Load(
          "step: 0.001\n"
          "drives: {shaft: {speed: 0.0, profile: [{speed: 300.0, max_acceleration: 20.0}]}}\n"
          "systems:\n" +
          systems),
      "benchmark");
}

const char* const kRotor =
    "  rotor:\n    model: jeffcott_rotor\n    drive: shaft\n    integrator: exponential\n"
    "    parameters: {mass: 1.0, stiffness: 1.0e+4, damping: 10.0, eccentricity: 1.0e-4}\n";

/// Stiffnesses as far apart as in the ensemble.
Scene systems(std::size_t number) {
  Scene scene = read(kRotor);
  const SystemSpec first = scene.systems.front();
  scene.systems.assign(number, first);
  for (std::size_t i = 0; i < number; ++i) {
    SystemSpec& system = scene.systems[i];
    system.name = fmt::format("rotor_{}", i);
    const double share = static_cast<double>(i) / static_cast<double>(number);
    system.parameters["stiffness"] *= 0.9 + 0.2 * share;
    system.parameters["stiffness_y"] = system.parameters["stiffness"];
  }
  return scene;
}

Scene rotorEnsemble(std::size_t number) {
  return read(kRotor + fmt::format("    count: {}\n    spread: {{stiffness: "
                                   "{{relative_half_width: 0.1}}}}\n",
                                   number));
}

Scene pendulumEnsemble(std::size_t number) {
  return read(
      fmt::format("  pendulum:\n    model: double_pendulum\n    integrator: runge_kutta_4\n"
                  "    parameters: {{mass1: 1.0, mass2: 1.0, length1: 1.0, length2: 1.0}}\n"
                  "    initial: {{theta1: 0.2, theta2: 0.3}}\n"
                  "    count: {}\n    spread: {{initial.theta1: {{half_width: 0.1}}}}\n",
                  number));
}

/// What the program has allocated.
double allocatedBytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

Measurement measure(const Scene& scene, std::size_t number, const Effort& effort) {
  const double before = allocatedBytes();
  Twin twin(scene);
  twin.buildEnsembles();
  const double bytes = allocatedBytes() - before;
  const Stepped stepped{scene.name, [&](int steps) { advance(twin, steps); }};
  return {number, stepCosts({stepped}, effort).front(), bytes};
}

/// With the largest of three units, each a thousand of the one before, that leaves 1 or more.
std::string withUnit(double value, const std::array<const char*, 3>& units) {
  std::size_t unit = 0;
  for (; unit + 1 < units.size() && value >= 1000.0; ++unit) {
    value *= 1.0e-3;
  }
  return fmt::format("{:.3g} {}", value, units[unit]);
}

std::string duration(double nanoseconds) {
  return withUnit(nanoseconds, {"ns", "µs", "ms"});
}

/// Three digits, or all before the point.
std::string plain(double x) {
  return x < 100.0 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x);
}

void writeTable(const std::vector<Kind>& kinds) {
  std::cout << "The CPU time of a step of the whole twin, on one processor. Rotors of a scene are "
               "separate systems, each\nwith its energy audit; those of an ensemble are samples of "
               "one system, "
               "which runs beside them. All rotors share a\ndrive and run up. The time is "
               "proportional to the "
               "number of systems, and longer if they do not\nfit in the processor's caches. "
               "Memory is that of "
               "the twin after its construction.\n\n"
               "| twin | number | per step | interquartile range | per system | times real time at "
               "1 ms | memory |\n|---|---|---|---|---|---|---|\n";
  for (const Kind& kind : kinds) {
    for (const Measurement& m : kind.measured) {
      std::cout << fmt::format(
          "| {} | {} | {} | {} to {} | {:.3g} ns | {} | {} |\n", kind.name, m.number,
          duration(m.cost.median), duration(m.cost.lower_quartile), duration(m.cost.upper_quartile),
          m.cost.median / static_cast<double>(m.number), plain(kStepNanoseconds / m.cost.median),
          withUnit(1.0e-3 * m.bytes, {"kB", "MB", "GB"}));
    }
  }
}

Figure figure(const std::vector<Kind>& kinds) {
  Chart chart;
  chart.x = {"number of systems", true, false};
  chart.y = {"CPU time of a step (ns)", true, false};
  for (const Kind& kind : kinds) {
    Series series;
    series.name = kind.name;
    series.pen = Pen{kind.ink, kPixelsOfLine};
    series.marks = Marks::kDots;
    for (const Measurement& m : kind.measured) {
      series.x.push_back(static_cast<double>(m.number));
      series.y.push_back(m.cost.median);
    }
    chart.series.push_back(std::move(series));
  }
  chart.horizontal = {{kStepNanoseconds, "real time at 1 ms"}};
  return {"A step of the whole twin", {chart}};
}

void writeFigure(const std::vector<Kind>& kinds, const std::string& path) {
  Drawings drawings;
  drawings.add(path, figureJson(figure(kinds)));
  drawings.write();
}

int run(int argc, char** argv) {
  Effort effort{15, 20.0};
  std::size_t most = 100000;
  std::string plot;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      effort = {3, 0.5};
      most = 1000;
    } else if (argument == "--plot" && i + 1 < argc) {
      plot = argv[++i];
    } else {
      std::cerr << "usage: many_rotors_benchmark [--quick] [--plot FILE.svg|FILE.png]\n";
      return 2;
    }
  }
  const DenormalsToZero denormals_to_zero;
  std::vector<Kind> kinds{
      {"rotors of a scene", systems, 100000, ink::kBlue},
      {"rotors of an ensemble", rotorEnsemble, 100000, ink::kVermilion},
      {"double pendulums of an ensemble", pendulumEnsemble, 10000, ink::kGreen}};
  for (Kind& kind : kinds) {
    for (std::size_t number = 1; number <= kind.largest && number <= most; number *= 10) {
      std::cerr << fmt::format("many_rotors_benchmark: {} {} ...\n", number, kind.name);
      kind.measured.push_back(measure(kind.scene(number), number, effort));
    }
  }
  writeTable(kinds);
  if (!plot.empty()) {
    writeFigure(kinds, plot);
  }
  return 0;
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  try {
    return whirl_twin::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "many_rotors_benchmark: " << error.what() << "\n";
    return 1;
  }
}
