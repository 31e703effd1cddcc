// A run of a scene from its start, as fast as possible.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/output.h"
#include "reports/sample_writer.h"
#include "requests/run_watches.h"
#include "requests/scene_argument.h"
#include "requests/work_progress.h"
#include "twin/checkpoint.h"
#include "twin/measurements.h"
#include "twin/observer.h"

namespace whirl_twin {

/// The arguments of `twin simulate`.
struct SimulationRequest {
  SceneArgument scene;
  std::optional<std::string> system;
  std::optional<std::string> duration;  ///< [s], as typed
  std::optional<std::string> step;      ///< [s], as typed
  std::optional<std::string> sample;    ///< [s], as typed
  std::optional<std::string> integrator;
  std::optional<std::string> output;
  std::optional<std::string> members;     ///< path of their table
  std::optional<std::string> measure;     ///< one of the scene's sensors, or `sensors`: all of them
  std::optional<std::string> checkpoint;  ///< path for the state of the run
  std::optional<std::string> resume;      ///< path of a checkpoint to resume from
  bool json = false;
  bool insist = false;
};

/// A validated request.
struct SimulationPlan {
  Scene scene;
  std::vector<std::size_t> systems;  ///< those that are shown
  std::vector<SensorSpec> sensors;   ///< those that measure
  std::int64_t steps = 0;
  std::int64_t stride = 1;                ///< steps from one sample to the next
  bool insist = false;                    ///< however long it takes
  YAML::Node tree;                        ///< of the scene's file, with its changes
  std::string source;                     ///< the absolute path of the file, for logs
  std::optional<std::string> checkpoint;  ///< path for the state of the run
  std::optional<std::string> resume;      ///< path of a checkpoint to resume from

  /// The settings that determine its length: "--duration: 100 s, 100000 steps".
  std::string asked() const;
};

/// Reads the scene and checks the options against it. Throws SceneError or InputError.
SimulationPlan planSimulation(const SimulationRequest& request);
/// Of a scene that was read before; the request's path is not used.
SimulationPlan planSimulation(Scene scene, const SimulationRequest& request);

/// Warns that a run without the processes of a scene's external controllers differs.
void warnOfExternalControllers(const Scene& scene);

class Simulation {
 public:
  /// Throws InputError for a checkpoint that cannot be resumed.
  explicit Simulation(const SimulationPlan& plan);

  /// Runs to the end. `writer` may be null. A system that stops is reported on standard error and
  /// the others continue. Throws RunFailure if it is interrupted.
  void run(SampleWriter* writer, WorkProgress& progress);

  const Twin& twin() const { return twin_; }
  /// Are all systems of the plan still running?
  bool sound() const;
  /// The final state of all systems.
  Json json() const;

 private:
  void resumeFrom(const std::string& path);
  void save();
  std::int64_t stepUnseen(std::int64_t due, WorkProgress& progress);
  std::int64_t stepFollowed(std::int64_t due, SampleWriter& writer, std::vector<double>& record,
                            WorkProgress& progress);
  bool stopsNow() const;
  void noteStops(WorkProgress& progress);
  void warn(WorkProgress& progress);
  Json systemJson(std::size_t system) const;
  Json ensembleJson(const Ensemble& ensemble) const;

  SimulationPlan plan_;
  Twin twin_;
  Observer observer_;
  Measurements measurements_;
  ValidityWatch validity_;
  AccuracyWatch accuracy_;
  Checkpoint checkpoint_;
  std::vector<std::optional<std::int64_t>> stopped_;  ///< the step in which each system stopped
};

}  // namespace whirl_twin
