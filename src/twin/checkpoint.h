// A checkpoint: all that a twin needs to go on from where it was, to the bit, in a file.
//
//   whirl_twin checkpoint 2
//   BYTES CHECKSUM                of all that follows: CRC-32C (format 1: FNV-1a, still read)
//   YAML                          version, machine, scene, what was changed live
//   a zero byte, then the states of the twin and of its observer (realtime/state_image.h)
//
// It is for the version, the machine and the scene that it was saved by; a file of others, or one
// that is not whole, is refused before anything is made of it.
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
  YAML::Node live;       ///< what was changed while it ran (LiveParameters::saved())
  std::string twin;      ///< image of it
  std::string observer;  ///< likewise; empty: none was saved
};

/// The bytes of the file.
std::string bytesOf(const Checkpoint& checkpoint);

/// The checkpoint in the bytes of a file, which `source` names in messages. Throws Refusal that
/// says what was expected and what was found.
Checkpoint checkpointOf(const std::string& bytes, const std::string& source);
/// In a file. Throws Refusal likewise.
Checkpoint readCheckpoint(const std::string& path);
/// Replaces the file in one go: whatever happens, it is the old or the new one. Throws RunFailure.
void writeCheckpoint(const std::string& path, const std::string& bytes);

/// Throws Refusal, "SOURCE: was saved of another scene", that tells in what it is another.
void requireScene(const Checkpoint& checkpoint, const SceneLines& scene, const std::string& source);

/// The state of a twin that does not run meanwhile. Throws Refusal where a controller's state
/// cannot be taken.
std::string imageOf(Twin& twin);
std::string imageOf(Observer& observer);
/// Puts a state back; of the twin first. Throws Refusal for that of a twin made otherwise.
void putBack(const Checkpoint& checkpoint, Twin& twin, const std::string& source);
void putBack(const Checkpoint& checkpoint, Observer& observer, const std::string& source);

// Checkpoints of a twin that runs, for the thread that sends it commands.

/// Takes the state between two steps: all of `out` but its scene and its observer, for whom a
/// record stands at its place among the others (RecordLayout::kSaved). wait() as that of
/// LiveParameters. False: not now, as the loop has ended or has a reset to tell of.
bool takeCheckpoint(LiveTwin& twin, const LiveParameters& parameters,
                    const std::function<bool()>& wait, Checkpoint& out);

/// The same of a twin whose loop has ended.
void takeAtRest(LiveTwin& twin, const LiveParameters& parameters, Checkpoint& out);

/// Before the loop runs, and before its state is observed: goes on from there. Throws Refusal, that
/// begins with `source`, for a state of a twin made otherwise.
void resume(const Checkpoint& checkpoint, LiveTwin& twin, LiveParameters& parameters,
            const std::string& source);

}  // namespace whirl_twin
