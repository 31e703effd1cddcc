#include "reports/asked_cost.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <fstream>

#include "accuracy/trajectory.h"
#include "analysis/stability.h"
#include "messages/input_error.h"
#include "reports/output.h"
#include "reports/step_cost.h"
#include "scene/control_parts.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr double kMinute = 60.0;  // s
constexpr double kHour = 3600.0;
constexpr double kDay = 86400.0;
constexpr double kYear = 365.25 * kDay;
constexpr double kLong = 10.0;  // s

// Measured on one core at 2.x GHz, g++ 12, on shafts of 44, 84 and 164 coordinates. [s] for the
// cube of the coordinates, as products and eigenvalues of their matrices go.
constexpr double kTablesOfSpeed = 6.6e-6;  // two tables over speed, of a step and of its halves
constexpr double kOneSpeed = 2.2e-7;       // two maps for one constant speed
constexpr double kAnalysis = 2.5e-7;       // critical speeds and the loss of stability
constexpr double kLowestModesOf = 3.0e-3;  // the same by the lowest modes: s a coordinate
constexpr double kCampbell = 2.7e-7;       // the same, followed,
constexpr double kPoint = 4.0e-10;         // and eigenvalues at a speed
constexpr double kResponse = 2.5e-6;       // peaks,
constexpr double kResponsePoint = 4e-9;    // and a response
constexpr double kTableMemory = 9600.0;    // bytes, for the square
constexpr double kMatrices = 400.0;        // bytes, likewise

constexpr double kRealRoots = 7.0e-7;      // s, for the square of the coefficients
constexpr double kComplexRoots = 8.5e-10;  // s, for their cube

constexpr std::size_t kFewMembers = 4;  // of an ensemble, made to see what they cost
constexpr double kDearMember = 0.2;     // s, of which none is made for that

std::atomic<bool> announced{false};

double square(double n) {
  return n * n;
}
double cube(double n) {
  return n * n * n;
}

AskedCost bySize(const std::string& system, int coordinates, double coefficient) {
  return {coefficient * cube(coordinates), kMatrices * square(coordinates),
          fmt::format("{}: {} coordinates", system, coordinates)};
}

/// [bytes] that may be had without another program going short.
double freeMemory() {
  std::ifstream file("/proc/meminfo");
  for (std::string name, unit; file >> name;) {
    double value = 0.0;
    if (name == "MemAvailable:" && file >> value) {
      return 1024.0 * value;
    }
    std::getline(file, unit);
  }
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

double processorTime() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

AskedCost& AskedCost::operator+=(const AskedCost& other) {
  if (other.seconds > seconds || cause.empty()) {
    cause = other.cause;
  }
  seconds += other.seconds;
  memory += other.memory;
  return *this;
}

AskedCost costOfSteps(const BuiltScene& scene, std::size_t system) {
  const BuiltSystem& built = *scene.systems[system];
  const std::vector<std::string>& methods = built.setup().integrators;
  if (!built.dynamics->isRotor() || methods.size() != 1) {
    return {};
  }
  const auto [low, high] = scene.driveOf(built).speedRange();
  const bool on_motor = !built.dynamics->hasShaft();
  const bool changes = low < high || on_motor;
  const int coordinates = static_cast<int>(built.dynamics->dof());
  AskedCost cost = bySize(built.spec.name, coordinates, changes ? kTablesOfSpeed : kOneSpeed);
  cost.memory = changes ? kTableMemory * square(coordinates) : cost.memory;
  if (on_motor) {  // to three nodes of a step
    cost.seconds *= 3.0;
    cost.memory *= 3.0;
  }
  if (isControlled(scene.scene, system)) {  // a step in parts: half as much again for each length
    const double lengths = 1.0 + 0.5 * static_cast<double>(partLengths(scene.scene).size());
    cost.seconds *= lengths;
    cost.memory *= lengths;
  }
  return cost;
}

AskedCost costOfMembers(const BuiltScene& scene, std::size_t system) {
  const std::size_t count = scene.scene.systems[system].ensemble.count;
  if (count == 0) {
    return {};
  }
  const std::string cause = fmt::format("{}: count: {}", scene.scene.systems[system].name, count);
  AskedCost of_one = costOfSteps(scene, system);
  if (of_one.seconds < kDearMember) {
    Scene few = sceneOfOne(scene.scene, system);
    const std::size_t made = std::min(count, kFewMembers);
    few.systems.front().ensemble.count = made;
    Twin twin(few);
    const std::size_t before = heapInUse();
    const double start = processorTime();
    twin.buildEnsembles();
    const double taken = processorTime() - start;
    const std::size_t after = heapInUse();
    of_one.seconds = taken / static_cast<double>(made);
    of_one.memory =
        static_cast<double>(after - std::min(before, after)) / static_cast<double>(made);
  }
  const auto all = static_cast<double>(count);
  return {all * of_one.seconds, all * of_one.memory, cause};
}

AskedCost costOfRun(const BuiltScene& scene) {
  AskedCost cost;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    cost += costOfSteps(scene, i);
    cost += costOfMembers(scene, i);
  }
  return cost;
}

AskedCost costOfAnalysis(const std::string& system, int coordinates, std::size_t modes) {
  if (coordinates > kMaxCompleteCoordinates && modes < static_cast<std::size_t>(coordinates)) {
    AskedCost cost = bySize(system, coordinates, 0.0);
    cost.seconds = kLowestModesOf * coordinates;
    return cost;
  }
  return bySize(system, coordinates, kAnalysis);
}

AskedCost costOfCampbell(const std::string& system, int coordinates, int points) {
  return bySize(system, coordinates, kCampbell + kPoint * points);
}

AskedCost costOfResponse(const std::string& system, int coordinates, int points) {
  return bySize(system, coordinates, kResponse + kResponsePoint * points);
}

AskedCost costOfRoots(std::size_t coefficients, bool real) {
  const auto n = static_cast<double>(coefficients);
  return {real ? kRealRoots * n * n : kComplexRoots * cube(n), 32.0 * n * n,
          fmt::format("{} coefficients", coefficients)};
}

std::string durationText(double seconds) {
  if (seconds < 2.0 * kMinute) {
    return fmt::format("{:.0f} s", seconds);
  }
  if (seconds < 2.0 * kHour) {
    return fmt::format("{:.0f} min", seconds / kMinute);
  }
  if (seconds < 2.0 * kDay) {
    return fmt::format("{:.0f} h", seconds / kHour);
  }
  return seconds < 2.0 * kYear ? fmt::format("{:.0f} days", seconds / kDay)
                               : fmt::format("{:.3g} years", seconds / kYear);
}

bool isAnnounced() {
  return announced.load();
}

void tell(const AskedCost& cost, bool insist) {
  const double free = freeMemory();
  if (!insist && cost.seconds > kDay) {
    throw InputError(fmt::format(
        "{}: takes about {}, more than the limit of one day: reduce this number, or start "
        "with --insist",
        cost.cause, durationText(cost.seconds)));
  }
  if (!insist && cost.memory > free) {
    throw InputError(fmt::format(
        "{}: takes about {:.0f} GB of memory, and {:.0f} GB are free; reduce it, or run it with "
        "--insist",
        cost.cause, 1.0e-9 * cost.memory, 1.0e-9 * free));
  }
  if (cost.seconds > kLong) {
    announced.store(true);
    complain(
        fmt::format("twin: {}: this takes about {}\n", cost.cause, durationText(cost.seconds)));
  }
}

}  // namespace whirl_twin
