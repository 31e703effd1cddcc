// What `twin fit` is asked: which numbers of a scene's system to find, from which measured runs.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "estimation/measured_run.h"
#include "scene/scene.h"

namespace whirl_twin {

/// A delay of a measured input that a fit looks for lies within this [s].
inline constexpr double kMaxInputDelay = 1.0;

/// A number that is given, or found.
struct GivenOrFitted {
  double value = 0.0;
  bool fitted = false;
  bool each_run = false;  ///< found for each run by itself, of those that are validated, too
};

/// A column that measures a coordinate or a rate of the system: column = scale * state + offset.
struct MeasuredChannel {
  std::string name;       ///< `theta1`, `theta1_rate`
  std::size_t state = 0;  ///< place among the coordinates, and the rates after them
  std::string unit;       ///< "rad", "m", "rad/s", "m/s"
  std::string column;
  GivenOrFitted offset{0.0};
  GivenOrFitted scale{1.0};
  /// Standard deviation [unit] that residuals are weighed by: all alike where none is given.
  double deviation = 1.0;
  /// Of an angle: whether it counts within a turn; where that is not said the rows show it
  /// (turns.h).
  std::optional<bool> wrap = std::nullopt;
};

/// A column that says what acted on an input: input(t) = scale * column(t - delay) + offset.
struct MeasuredInput {
  std::string name;       ///< `torque1`
  std::size_t place = 0;  ///< among the inputs of the model
  std::string column;
  GivenOrFitted offset{0.0};
  GivenOrFitted scale{1.0};
  GivenOrFitted delay{0.0};  ///< [s]
  bool hold = false;         ///< from each row to the next; else linear
};

struct StudyRun {
  std::string file;  ///< as the study names it
  bool train = false;
  std::vector<MeasuredChannel> measured;
  std::vector<MeasuredInput> inputs;
  MeasuredRun data;
};

/// A parameter of the system that is found.
struct FittedParameter {
  std::string path;  ///< `mass1`, `bearings[0].kxx`
  double start = 0.0;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

struct FitStudy {
  std::string source;  ///< the study's file
  std::string scene_path;
  Scene scene;  ///< of the one system
  std::string system;
  std::vector<StudyRun> runs;
  double window = 1.0;          ///< [s]; infinite: a run is one window
  bool start_estimated = true;  ///< of each window, else as measured
  std::vector<FittedParameter> fit;
  bool validate_only = false;   ///< nothing but the starts of windows is found
  std::optional<double> huber;  ///< residuals beyond, in deviations, count linearly

  const SystemSpec& spec() const { return scene.systems.front(); }
};

}  // namespace whirl_twin
