// Cost of whirl_twin at equal accuracy compared with general solvers, on the same equations.
#include <cstdlib>
#include <iostream>
#include <string>

#include "realtime/denormals.h"
#include "report.h"

namespace whirl_twin::comparison {
namespace {

constexpr const char* kUsage =
    "usage: peers_benchmark [--quick] [--json] [--scene TEXT]\n"
    "Measures the CPU time whirl_twin and general solvers take to meet an error, on five scenes.\n"
    "  --quick       one short round with a coarse ladder of settings: does everything run?\n"
    "  --json        every point measured, as JSON; else tables in Markdown\n"
    "  --scene TEXT  only scenes with TEXT in their name\n";

struct NamedScene {
  const char* name;
  ComparedScene (*make)();
};
constexpr NamedScene kScenes[] = {{"Jeffcott rotor, constant speed", &jeffcottScene},
                                  {"Jeffcott rotor, run-up", &runUpScene},
                                  {"Double pendulum", &doublePendulumScene},
                                  {"Spinning pendulum", &spinningPendulumScene},
                                  {"Shaft of 40 coordinates", &shaftScene}};

double load() {
  double mean = 0.0;
  return getloadavg(&mean, 1) == 1 ? mean : -1.0;
}

int run(int argc, char** argv) {
  bool json = false;
  std::string wanted;
  Circumstances circumstances;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--help" || argument == "-h") {
      std::cout << kUsage;
      return 0;
    }
    if (argument == "--json") {
      json = true;
    } else if (argument == "--quick") {
      circumstances.effort = {1, 20.0, 1.0, 3};
    } else if (argument == "--scene" && i + 1 < argc) {
      wanted = argv[++i];
    } else {
      std::cerr << kUsage;
      return 2;
    }
  }
  const DenormalsToZero denormals_to_zero;  // for everyone
  circumstances.peers = peers();
  circumstances.load_before = load();
  std::vector<MeasuredScene> measured;
  for (const NamedScene& named : kScenes) {
    if (std::string(named.name).find(wanted) == std::string::npos) {
      continue;
    }
    std::cerr << "peers_benchmark: " << named.name << " ...\n";
    ComparedScene scene = named.make();
    std::vector<Curve> curves = measure(scene, circumstances.effort);
    measured.push_back({std::move(scene), std::move(curves)});
  }
  circumstances.load_after = load();
  (json ? writeJson : writeMarkdown)(std::cout, measured, circumstances);
  return 0;
}

}  // namespace
}  // namespace whirl_twin::comparison

int main(int argc, char** argv) {
  return whirl_twin::comparison::run(argc, argv);
}
