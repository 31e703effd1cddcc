// A participant of the comparison: a solver with a ladder of settings, and one run of it with one
// of them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace whirl_twin::comparison {

/// When a scene's coordinates are compared: at k x interval, k = 1 ... samples.
struct Output {
  double interval = 0.0;  ///< [s]
  std::size_t samples = 0;
  std::size_t coordinates = 0;  ///< of the scene

  double horizon() const { return interval * static_cast<double>(samples); }
  double time(std::size_t sample) const { return interval * static_cast<double>(sample + 1); }
  std::size_t size() const { return samples * coordinates; }
};

/// One solver with one setting. What building it costs does not count, unless it is in prepare().
class Run {
 public:
  virtual ~Run() = default;
  /// Computations needed once for any number of runs.
  virtual void prepare() {}
  /// Integrates from the scene's start; writes the coordinates of each sample, one after the other.
  /// False: the solver gave up.
  virtual bool integrate(double* out) = 0;
};

enum class Ladder {
  kTolerances,
  kSteps  ///< of a fixed size, between two samples
};

struct Contender {
  std::string name;
  bool ours = false;
  Ladder ladder = Ladder::kTolerances;
  std::vector<double> settings;  ///< from coarse to fine
  std::function<std::unique_ptr<Run>(double setting)> build;
};

/// 1e-2 ... 1e-13, two a decade.
std::vector<double> tolerances();
/// Numbers of steps between two samples, each about an eighth above the one before.
std::vector<double> stepCounts();

}  // namespace whirl_twin::comparison
