// Where the samples of a run go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "messages/follow_state.h"
#include "messages/measurement.h"
#include "messages/scene_text.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {

class SampleWriter {
 public:
  virtual ~SampleWriter() = default;
  /// The last state that was observed.
  virtual void write(const Observer& observer) = 0;
  /// Whether follow() is called for every step, and which records its observer has to observe.
  virtual bool followsSteps() const { return false; }
  virtual bool hasToSee(std::int64_t /*step*/) const { return false; }
  virtual void follow(const double* /*record*/, const Observer& /*observer*/) {}
  /// A block of what the scene's sensors have measured; a table has no place for it.
  virtual void write(const state::Measurement& /*measurement*/) {}
  /// What a state estimator publishes; likewise.
  virtual void write(const state::FollowState& /*estimate*/) {}
  /// Completes the file. A writer destroyed without leaves no file behind.
  virtual void finish() = 0;
};

// All throw RunFailure when they cannot write. `systems`: which ones of the
// twin's; the twin outlives the writer.

/// Comma-separated values, 17 significant digits: SampledSignals without energies. A system that
/// has stopped is nan. An empty path means standard output.
std::unique_ptr<SampleWriter> makeTableWriter(const Twin& twin,
                                              const std::vector<std::size_t>& systems,
                                              const std::string& path);

/// The messages the simulation node publishes, of the systems and their drives, after the scene: an
/// LCM event log, or an MCAP file where the path ends in .mcap.
std::unique_ptr<SampleWriter> makeLogWriter(const Twin& twin, std::vector<std::size_t> systems,
                                            state::SceneText scene, const std::string& path);

/// Writes a row for each member of the one ensemble among `systems`: its number, the values drawn,
/// then each quantity now and at its peak; 17 significant digits, nan for one that has stopped.
/// Throws RunFailure.
void writeMembers(const Twin& twin, const std::vector<std::size_t>& systems,
                  const std::string& path);

}  // namespace whirl_twin
