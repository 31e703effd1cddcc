// Checkpoint: a file with all that a twin needs to continue bit-identically.
//
//   whirl_twin checkpoint 2
//   BYTES CHECKSUM                of all that follows: CRC-32C (format 1: FNV-1a, still read)
//   YAML                          version, machine, scene, what was changed live
//   a zero byte, then the states of the twin and of its observer (realtime/state_image.h)
//
// Valid only for the version, the machine and the scene that saved it; a file of others, or an
// incomplete one, is rejected before anything is restored.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <functional>
#include <string>

#include "twin/live_parameters.h"
#include "twin/live_twin.h"
#include "twin/observer.h"
#include "twin/scene_lines.h"
#include "twin/twin.h"

namespace whirl_twin {

struct Checkpoint {
  SceneLines scene;
  std::int64_t step = 0;
  YAML::Node live;       ///< live changes (LiveParameters::saved())
  std::string twin;      ///< state image
  std::string observer;  ///< likewise; empty: none was saved
};

/// The content of the file.
std::string bytesOf(const Checkpoint& checkpoint);

/// The checkpoint in the content of a file; `source` is its name in messages. Throws InputError
/// with what was expected and what was found.
Checkpoint checkpointOf(const std::string& bytes, const std::string& source);
/// From a file. Throws InputError likewise.
Checkpoint readCheckpoint(const std::string& path);
/// Replaces the file atomically. Throws RunFailure.
void writeCheckpoint(const std::string& path, const std::string& bytes);

/// Throws InputError, "SOURCE: was saved of another scene", with the differences.
void requireScene(const Checkpoint& checkpoint, const SceneLines& scene, const std::string& source);

/// The state of a twin that does not run. Throws InputError if a controller's state cannot be
/// saved.
std::string imageOf(Twin& twin);
std::string imageOf(Observer& observer);
/// Restores a state; the twin's must be restored first. Throws InputError if it is of a twin with a
/// different structure.
void restore(const Checkpoint& checkpoint, Twin& twin, const std::string& source);
void restore(const Checkpoint& checkpoint, Observer& observer, const std::string& source);

// Checkpoints of a running twin, for the thread that sends its commands.

/// Saves the state between two steps: all of `out` but its scene and its observer, for which a
/// record is put in sequence among the others (RecordLayout::kSaved). wait() as in LiveParameters.
/// False: not possible now, since the loop has ended or has an unpublished reset.
bool takeCheckpoint(LiveTwin& twin, const LiveParameters& parameters,
                    const std::function<bool()>& wait, Checkpoint& out);

/// Likewise for a twin whose loop has ended.
void takeAtRest(LiveTwin& twin, const LiveParameters& parameters, Checkpoint& out);

/// Resumes a checkpoint; before the loop runs and before its state is observed. Throws InputError,
/// starting with `source`, for a state of a twin with a different structure.
void resume(const Checkpoint& checkpoint, LiveTwin& twin, LiveParameters& parameters,
            const std::string& source);

}  // namespace whirl_twin
