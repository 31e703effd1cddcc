// The study of `twin fit`: which parameters of a scene's system to find, from which measured runs.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "estimation/measured_run.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Upper bound of a fitted delay of a measured input [s].
inline constexpr double kMaxInputDelay = 1.0;

/// A number that is given or fitted.
struct GivenOrFitted {
  double value = 0.0;
  bool fitted = false;
  bool each_run = false;  ///< fitted for each run, also for validation runs
};

/// A column that measures a coordinate or rate of the system: column = scale * state + offset.
struct MeasuredChannel {
  std::string name;       ///< `theta1`, `theta1_rate`
  std::size_t state = 0;  ///< index: coordinates first, then rates
  std::string unit;       ///< "rad", "m", "rad/s", "m/s"
  std::string column;
  GivenOrFitted offset{0.0};
  GivenOrFitted scale{1.0};
  /// Standard deviation [unit] as weight of the residuals; 1 for all if none is given.
  double deviation = 1.0;
  /// Of an angle: whether it is wrapped to one turn; if not specified, found from the rows
  /// (run_units.h).
  std::optional<bool> wrap = std::nullopt;
};

/// A column that measures an input: input(t) = scale * column(t - delay) + offset.
struct MeasuredInput {
  std::string name;       ///< `torque1`
  std::size_t place = 0;  ///< among the inputs of the model
  std::string column;
  GivenOrFitted offset{0.0};
  GivenOrFitted scale{1.0};
  GivenOrFitted delay{0.0};  ///< [s]
  bool hold = false;         ///< zero-order hold from row to row; else linear
};

struct StudyRun {
  std::string file;  ///< path as in the study
  bool train = false;
  std::vector<MeasuredChannel> measured;
  std::vector<MeasuredInput> inputs;
  MeasuredRun data;
};

/// A fitted parameter of the system.
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
  bool start_estimated = true;  ///< of each window; else as measured
  std::vector<FittedParameter> fit;
  bool validate_only = false;   ///< only the starts of windows are fitted
  std::optional<double> huber;  ///< residuals beyond, in standard deviations, count linearly

  const SystemSpec& spec() const { return scene.systems.front(); }
};

}  // namespace whirl_twin
